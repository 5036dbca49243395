// SPDX-License-Identifier: Apache-2.0
// Files of camodocal's camera models and of an estimator that uses them. The numbers are made up.
#include "platform/input/vins_calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "platform/input/read_calibration.hpp"
#include "tests/platform/test_calibrations.hpp"

namespace parallax {
namespace vins_calibration_test {

using test::message;

std::string pinhole(const std::string& model = "PINHOLE") {
  return "%YAML:1.0\n---\nmodel_type: " + model +
         "\ncamera_name: camera\nimage_width: 640\nimage_height: 480\ndistortion_parameters:\n   k1: -0.28\n"
         "   k2: 0.07\n   p1: 2.0e-04\n   p2: 1.76e-05\nprojection_parameters:\n   fx: 450.5\n   fy: 451\n"
         "   cx: 330.\n   cy: 235\n";
}

std::string kannala_brandt() {
  return "%YAML:1.0\n---\nmodel_type: KANNALA_BRANDT\ncamera_name: camera\nimage_width: 640\n"
         "image_height: 480\nprojection_parameters:\n   k2: -0.01\n   k3: 0.02\n   k4: -0.03\n   k5: 0.004\n"
         "   mu: 286.5\n   mv: 286.25\n   u0: 321\n   v0: 241\n# model_type: MEI\n";
}

// Axes of the cameras in the body: x along +y, y along -x, z along z. The left one is at (0.01, 0.2, 0.3).
std::string pose(const std::string& name, const std::string& y) {
  return name + ": !!opencv-matrix\n   rows: 4\n   cols: 4\n   dt: d\n   data: [0., -1., 0., 0.01,\n" +
         "           1, 0, 0, " + y + ",\n           0, 0, 1, 0.3,\n           0., 0., 0., 1.]\n\n";
}

std::string estimator(const std::string& right_y = "0.32") {
  return "%YAML:1.0\n\n#common parameters\nimu: 1         \nnum_of_cam: 2  \n\nimu_topic: \"/imu0\"\n"
         "cam0_calib: \"left.yaml\"\ncam1_calib: \"cameras/right.yaml\"\nimage_width: 640\nimage_height: "
         "480\n\n"
         "estimate_extrinsic: 0   # 0  Have an accurate extrinsic parameters.\n\n" +
         pose("body_T_cam0", "0.2") + pose("body_T_cam1", right_y) + "multiple_thread: 1\n";
}

class VinsCalibration : public test::FolderTest {
 protected:
  // The line for the files of a rig, without the folder's name.
  std::string line(const std::string& left, const std::string& right, const std::string& rig) const {
    write("left.yaml", left);
    write("cameras/right.yaml", right);
    std::string text = message([&] { read_calibration({write("rig.yaml", rig)}); });
    const std::string folder = path("");
    for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder))
      text.erase(at, folder.size());
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    return text;
  }
};

TEST_F(VinsCalibration, TheEstimatorsFileNamesTheCameras) {
  write("left.yaml", pinhole());
  write("cameras/right.yaml", pinhole());
  // The right camera is 0.12 further along +y of the body, which is +x of both: x_right = x_left - (0.12, 0,
  // 0).
  const Calibration c = read_calibration({write("rig.yaml", estimator())});
  EXPECT_EQ(c.model, LensModel::kPinhole);
  EXPECT_EQ(c.unit, "m");
  EXPECT_EQ(c.size.width, 640);
  EXPECT_EQ(c.size.height, 480);
  EXPECT_EQ(c.left.camera, cv::Matx33d(450.5, 0, 330, 0, 451, 235, 0, 0, 1));
  EXPECT_EQ(c.left.distortion, (std::vector<double>{-0.28, 0.07, 0.0002, 1.76e-05}));
  EXPECT_NEAR(c.geometry->baseline, 0.12, 1e-9);
  EXPECT_LT(cv::norm(c.R1 - cv::Matx33d::eye()), 1e-9) << "the axes are parallel";
}

TEST_F(VinsCalibration, GivenOneByOne) {
  const std::string left = write("a.yaml", pinhole()), rig = write("rig.yaml", estimator());
  std::string other = pinhole();
  other.replace(other.find("450.5"), 5, "470.5");
  const std::string right = write("b.yaml", other);
  for (const std::vector<std::string>& files :
       {std::vector<std::string>{left, right, rig}, {rig, left, right}}) {
    const Calibration c = read_calibration(files);
    EXPECT_EQ(c.left.camera(0, 0), 450.5);
    EXPECT_EQ(c.right.camera(0, 0), 470.5);
    EXPECT_NEAR(c.geometry->baseline, 0.12, 1e-9);
  }
}

TEST_F(VinsCalibration, KannalaBrandtIsFisheye) {
  write("left.yaml", kannala_brandt());
  write("cameras/right.yaml", kannala_brandt());
  const Calibration c = read_calibration({write("rig.yaml", estimator())});
  EXPECT_EQ(c.model, LensModel::kFisheye);
  EXPECT_EQ(c.left.camera, cv::Matx33d(286.5, 0, 321, 0, 286.25, 241, 0, 0, 1));
  EXPECT_EQ(c.left.distortion, (std::vector<double>{-0.01, 0.02, -0.03, 0.004}));
  EXPECT_NEAR(c.geometry->baseline, 0.12, 1e-9);
}

TEST_F(VinsCalibration, TheFullModelIsInAnotherOrder) {
  std::string full = pinhole("PINHOLE_FULL");
  full.replace(full.find("   p1"), 0, "   k3: 3.0\n   k4: 4.\n   k5: 5\n   k6: 6e-1\n");
  write("left.yaml", full);
  write("cameras/right.yaml", full);
  EXPECT_EQ(read_calibration({write("rig.yaml", estimator())}).left.distortion,
            (std::vector<double>{-0.28, 0.07, 0.0002, 1.76e-05, 3, 4, 5, 0.6}));
}

TEST_F(VinsCalibration, FaultsAreNamed) {
  EXPECT_EQ(line(pinhole("MEI"), pinhole(), estimator()),
            "left.yaml: model_type: \"MEI\" is not supported, only PINHOLE, PINHOLE_FULL and KANNALA_BRANDT");
  EXPECT_EQ(
      line(pinhole(), kannala_brandt(), estimator()),
      "cameras/right.yaml: model_type: KANNALA_BRANDT, but the left camera has PINHOLE; both lenses of a "
      "pair are of one model");
  EXPECT_EQ(line(pinhole(), pinhole("PINHOLE_FULL"), estimator()),
            "cameras/right.yaml: distortion_parameters: k3 is missing");
  EXPECT_EQ(
      line(pinhole(), pinhole(), estimator("0.1")),
      "rig.yaml + left.yaml + cameras/right.yaml: the rectification of R and T: the right camera lies 0.1 "
      "to the left of the left one; are the images exchanged?");
  std::string small = pinhole();
  small.replace(small.find("640"), 3, "320");
  EXPECT_EQ(
      line(pinhole(), small, estimator()),
      "cameras/right.yaml: image_width, image_height: 320x480, but the left camera has 640x480; those of "
      "a pair have one size");
  std::string rig = estimator();
  EXPECT_EQ(line(pinhole(), pinhole(), rig.substr(0, rig.find("body_T_cam1"))),
            "rig.yaml: body_T_cam1 is missing");
  rig.replace(rig.find("cam1_calib"), 4, "camX");
  EXPECT_EQ(line(pinhole(), pinhole(), rig), "rig.yaml: cam1_calib is missing");
  const std::string left = path("left.yaml");
  EXPECT_EQ(
      message([&] {
        read_calibration({left, left});
      }),
      left + " + " + left +
          ": 2 with model_type and 0 with body_T_cam0; a pair is two files of cameras, left and right, and "
          "the estimator's, which says where they are");
  EXPECT_EQ(line(pinhole(), pinhole(), estimator() + "imu: 2\n"), "rig.yaml: imu occurs twice");
}

}  // namespace vins_calibration_test
}  // namespace parallax
