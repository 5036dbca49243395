// SPDX-License-Identifier: Apache-2.0
#include "platform/input/ros_calibration.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "platform/input/raw_maps.hpp"
#include "platform/input/read_calibration.hpp"
#include "tests/platform/test_calibrations.hpp"

namespace parallax {
namespace ros_calibration_test {

using test::message;

// As ROS's camera_calibration writes it.
std::string camera_info(const std::string& model = "plumb_bob",
                        const std::string& d = "-0.2, 0.05, 0.001, -0.002, 0.",
                        const std::string& tx = "0.") {
  const auto block = [](const std::string& name, int rows, int columns, const std::string& data) {
    return name + ":\n  rows: " + std::to_string(rows) + "\n  cols: " + std::to_string(columns) +
           "\n  data: [" + data + "]\n";
  };
  const int count = d.empty() ? 0 : static_cast<int>(std::count(d.begin(), d.end(), ',')) + 1;
  return "image_width: 640\nimage_height: 480\ncamera_name: narrow_stereo/left\n" +
         block("camera_matrix", 3, 3, "500., 0., 322., 0., 501., 238., 0., 0., 1.") +
         "distortion_model: " + model + "\n" + block("distortion_coefficients", 1, count, d) +
         block("rectification_matrix", 3, 3, "1., 0., 0., 0., 1., 0., 0., 0., 1.") +
         block("projection_matrix", 3, 4, "450., 0., 320., " + tx + ", 0., 450., 240., 0., 0., 0., 1., 0.");
}

// As `rostopic echo` prints the message, of a RealSense: rectified in the camera, 50 mm apart.
std::string message_text(const std::string& tx, const std::string& names = "DKRP") {
  return "header: \n  seq: 1\n  stamp: \n    secs: 1579\n    nsecs: 20\n  frame_id: "
         "\"camera_infra1_optical_frame\"\n"
         "height: 480\nwidth: 640\ndistortion_model: \"plumb_bob\"\n" +
         names.substr(0, 1) + ": [0.0, 0.0, 0.0, 0.0, 0.0]\n" + names.substr(1, 1) +
         ": [380.0, 0.0, 320.5, 0.0, 380.0, 240.5, 0.0, 0.0, 1.0]\n" + names.substr(2, 1) +
         ": [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]\n" + names.substr(3, 1) + ": [380.0, 0.0, 320.5, " +
         tx +
         ", 0.0, 380.0, 240.5, 0.0, 0.0, 0.0, 1.0, 0.0]\n"
         "binning_x: 0\nbinning_y: 0\nroi: \n  x_offset: 0\n  y_offset: 0\n  height: 0\n  width: 0\n  "
         "do_rectify: "
         "False\n---\n";
}

class RosCalibration : public test::FolderTest {
 protected:
  Calibration read(const std::string& left, const std::string& right) const {
    return read_calibration({write("left.yaml", left), write("right.yaml", right)});
  }
  // The line for a pair, without the folder.
  std::string line(const std::string& left, const std::string& right) const {
    std::string text = message([&] { read(left, right); });
    const std::string folder = path("");
    for (std::size_t at = 0; (at = text.find(folder)) != std::string::npos;) text.erase(at, folder.size());
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    return text;
  }
};

const std::string kRight = camera_info("plumb_bob", "-0.2, 0.05, 0.001, -0.002, 0.", "-54.");

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

TEST_F(RosCalibration, TxIsMinusFocalLengthTimesBaseline) {
  const Calibration c = read(camera_info(), kRight);
  EXPECT_EQ(c.model, LensModel::kPinhole);
  EXPECT_EQ(c.size.width, 640);
  EXPECT_EQ(c.size.height, 480);
  EXPECT_EQ(c.unit, "m");
  EXPECT_EQ(c.left.camera, cv::Matx33d(500, 0, 322, 0, 501, 238, 0, 0, 1));
  EXPECT_EQ(c.left.distortion, (std::vector<double>{-0.2, 0.05, 0.001, -0.002, 0}));
  EXPECT_EQ(c.P1(0, 0), 450);
  // P(0,3) = -54 = -450 * 0.12 m; a disparity of 27 px is 54 / 27 = 2 m away.
  ASSERT_TRUE(c.geometry);
  EXPECT_DOUBLE_EQ(c.geometry->baseline, 0.12);
  EXPECT_DOUBLE_EQ(c.geometry->focal_x * c.geometry->baseline / 27, 2);
}

TEST_F(RosCalibration, TheMessageAsPrintedIsReadToo) {
  for (const char* names : {"DKRP", "dkrp"}) {
    // 380 * 0.05 = 19.
    const Calibration c = read(message_text("0.0", names), message_text("-19.0", names));
    EXPECT_DOUBLE_EQ(c.geometry->baseline, 0.05);
    EXPECT_EQ(c.left.distortion, std::vector<double>(5, 0));
    // Rectified in the camera: nothing moves.
    const RawMaps maps = raw_maps(c);
    EXPECT_NEAR(maps.left_x.at<float>(100, 639), 639, 1e-3);
    EXPECT_NEAR(maps.right_y.at<float>(479, 0), 479, 1e-3);
  }
}

TEST_F(RosCalibration, EveryDistortionModelOfRos) {
  const auto pair = [&](const std::string& model, const std::string& d) {
    return read(camera_info(model, d), camera_info(model, d, "-54."));
  };
  EXPECT_EQ(pair("rational_polynomial", "1., .2, 0., 0., .1, 1.0e+00, .3, .02").left.distortion.size(), 8U);
  EXPECT_EQ(pair("\"plumb_bob\"", "-.2, .05, 0., 0.").left.distortion.size(), 4U);
  EXPECT_EQ(pair("''", "").left.distortion, std::vector<double>(5, 0)) << "a driver of a rectified camera";
  for (const char* name : {"equidistant", "fisheye"}) {
    const Calibration c = pair(name, "-0.01, 0.02, -0.01, 0.002");
    EXPECT_EQ(c.model, LensModel::kFisheye);
    EXPECT_EQ(c.left.distortion, (std::vector<double>{-0.01, 0.02, -0.01, 0.002}));
  }
  EXPECT_EQ(pair("equidistant", "-0.01, 0.02, -0.01, 0.002, 0.").left.distortion.size(), 4U)
      << "RealSense pads to five";
  const auto refused = [&](const std::string& model, const std::string& d) {
    return line(camera_info(model, d), camera_info(model, d, "-54."));
  };
  EXPECT_EQ(refused("thin_prism_fisheye", "1., 2., 3., 4."),
            "left.yaml: distortion_model: \"thin_prism_fisheye\" is not plumb_bob, rational_polynomial or "
            "equidistant");
  EXPECT_EQ(refused("''", "0.1, 0., 0., 0., 0."),
            "left.yaml: distortion_model: \"\" is not plumb_bob, rational_polynomial or equidistant");
  EXPECT_EQ(refused("equidistant", "-0.01, 0.02, -0.01, 0.002, 0.1"),
            "left.yaml: distortion_coefficients: 5 coefficients, 4 expected for this camera model");
  EXPECT_EQ(line(camera_info(), camera_info("equidistant", "0., 0., 0., 0.", "-54.")),
            "left.yaml + right.yaml: one lens is radial-tangential, the other equidistant; both lenses of a "
            "pair are of "
            "one model");
}

TEST_F(RosCalibration, FilesOfAPairMustFit) {
  EXPECT_EQ(line(kRight, camera_info()),
            "left.yaml + right.yaml: projection_matrix: the right camera lies 0.12 to the left of the left "
            "one; are the "
            "images exchanged?");
  EXPECT_EQ(line(camera_info(), camera_info()),
            "left.yaml + right.yaml: projection_matrix: no baseline: element (0,3) is 0 left and 0 right; it "
            "is smaller "
            "on the right by focal length * baseline");
  EXPECT_EQ(
      line(camera_info(), replaced(kRight, "image_width: 640", "image_width: 752")),
      "left.yaml + right.yaml: images of 640x480 left and 752x480 right; those of a pair have one size");
  const std::string file = write("left.yaml", camera_info());
  EXPECT_EQ(message([&] { read_calibration({file}); }),
            file + ": ROS camera_info is of one camera each: a pair is two files, left and right");
  EXPECT_EQ(
      message([&] {
        read_calibration({file, file}, {}, CameraPair{2, 3});
      }),
      file + " + " + file + ": ROS camera_info has no numbered cameras that --cameras could choose from");
}

TEST_F(RosCalibration, DamageIsNamed) {
  const auto with = [&](const std::string& what, const std::string& replacement) {
    return line(camera_info(), replaced(kRight, what, replacement));
  };
  EXPECT_EQ(with("image_width: 640", "image_width: many"),
            "right.yaml: image_width: \"many\" is not a number");
  EXPECT_EQ(with("image_width: 640\n", ""), "right.yaml: image_width is missing");
  EXPECT_EQ(with("image_height: 480", "image_height: 0"),
            "right.yaml: image_width, image_height: 640x0 is not an image size");
  EXPECT_EQ(with("500.", "nan"), "right.yaml: camera_matrix: data holds a value that is not a finite number");
  EXPECT_EQ(with("500.", "-500"),
            "right.yaml: camera_matrix: not a camera matrix: focal lengths -500 and 501 px, last element 1");
  EXPECT_EQ(with("500., 0.", "500., 5."),
            "right.yaml: camera_matrix: not a camera matrix without skew: f 0 cx; 0 f cy; 0 0 1 expected, "
            "elements (0,1), "
            "(1,0), (2,0) and (2,1) are 5, 0, 0 and 0");
  EXPECT_EQ(with("500., 0.,", "500.,"), "right.yaml: camera_matrix has rows: 3 and cols: 3, but 8 numbers");
  EXPECT_EQ(with("  rows: 3\n  cols: 3\n  data: [500., 0.,", "  data: [500.,"),
            "right.yaml: camera_matrix has 8 numbers, 3x3 expected");
  EXPECT_EQ(with("500., 0., 322., 0., 501., 238., 0., 0., 1.", "0, 0, 0, 0, 0, 0, 0, 0, 0"),
            "right.yaml: camera_matrix is zero: ROS writes that of a camera that is not calibrated");
  EXPECT_EQ(with("rectification_matrix", "rectification"), "right.yaml: rectification_matrix is missing");
  const std::string alone = kRight.substr(0, kRight.find("rectification_matrix"));
  EXPECT_EQ(
      line(camera_info(), alone),
      "right.yaml: rectification_matrix and projection_matrix are missing: they say how the cameras of a "
      "pair lie, which the calibration of one camera does not");
  EXPECT_EQ(with("[1., 0., 0., 0., 1.", "[1., 0., 9., 0., 1."),
            "right.yaml: rectification_matrix: not a rotation matrix");
  EXPECT_EQ(with("camera_matrix:\n  rows: 3\n  cols: 3\n  data:", "camera_matrix: 7\nx:"),
            "right.yaml: camera_matrix is not a list of numbers");
  EXPECT_EQ(with("data: [450.", "data: [450., [1], {a: 2}"),
            "right.yaml: projection_matrix: data is not a number");
  EXPECT_EQ(with("distortion_model: plumb_bob", "distortion_model: [1]"),
            "right.yaml: distortion_model is not a text");
  EXPECT_EQ(with("camera_name:", "image_width: 640\ncamera_name:"), "right.yaml: image_width occurs twice");
  EXPECT_EQ(with("data: [450.", "data: [[450."),
            "right.yaml: not YAML: line 21: end of sequence flow not found");
  EXPECT_EQ(with("  data: [450.", "\tdata: [450."),
            "right.yaml: not YAML: line 20: illegal tab when looking for indentation");
}

TEST_F(RosCalibration, PartsOfTheSensorAreRefused) {
  const std::string right = message_text("-19.0");
  EXPECT_EQ(line(message_text("0.0"), replaced(right, "binning_x: 0", "binning_x: 2")),
            "right.yaml: binning_x: 2: only images of all pixels are supported, 0 or 1");
  EXPECT_EQ(line(message_text("0.0"), replaced(right, "x_offset: 0", "x_offset: 8")),
            "right.yaml: roi: x_offset: 8: only images of the whole sensor are supported, 0 or 0");
  EXPECT_EQ(line(message_text("0.0"), replaced(right, "  width: 0", "  width: 640")), "");
  EXPECT_EQ(line(message_text("0.0"), replaced(right, "  width: 0", "  width: 320")),
            "right.yaml: roi: width: 320: only images of the whole sensor are supported, 0 or 640");
}

}  // namespace ros_calibration_test
}  // namespace parallax
