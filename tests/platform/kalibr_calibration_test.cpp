// SPDX-License-Identifier: Apache-2.0
#include "platform/input/kalibr_calibration.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>

#include "platform/input/read_calibration.hpp"
#include "tests/paths.hpp"
#include "tests/platform/test_calibrations.hpp"

namespace parallax {
namespace kalibr_calibration_test {

using test::message;

std::string camera(int number, const std::string& more, const std::string& model = "radtan",
                   const std::string& coefficients = "-0.2, 0.05, 1.0e-04, -.0003") {
  return "cam" + std::to_string(number) + ":\n  camera_model: pinhole\n  distortion_coeffs: [" +
         coefficients + "]\n  distortion_model: " + model +
         "\n  intrinsics: [461.5, 460.25, 330.0, 235.0]\n  resolution: [640, 480]\n" + "  rostopic: /cam" +
         std::to_string(number) + "/image_raw\n" + more;
}

std::string transform(const std::string& name, const std::string& x, const std::string& y,
                      const std::string& z) {
  return "  " + name + ":\n  - [" + x + "]\n  - [" + y + "]\n  - [" + z + "]\n  - [0.0, 0.0, 0.0, 1.0]\n";
}

// A camera `right` metres to the right of the one before, with parallel axes.
std::string moved(const std::string& minus_right) {
  return transform("T_cn_cnm1", "1.0, 0.0, 0.0, " + minus_right, "0.0, 1.0, 0.0, 0.0", "0.0, 0.0, 1.0, 0.0");
}

std::string chain() { return camera(0, "") + camera(1, moved("-0.1")) + camera(2, moved("-0.2")); }

class KalibrCalibration : public test::FolderTest {
 protected:
  Calibration read(const std::string& text, const std::optional<CameraPair>& cameras = std::nullopt) const {
    return read_calibration({write("camchain.yaml", text)}, {}, cameras);
  }
  // The line for a file, without its name.
  std::string line(const std::string& text, const std::optional<CameraPair>& cameras = std::nullopt) const {
    const std::string whole = message([&] { read(text, cameras); });
    const std::string prefix = path("camchain.yaml") + ": ";
    EXPECT_TRUE(whole.empty() || whole.find(prefix) == 0) << whole;
    EXPECT_EQ(whole.find('\n'), std::string::npos) << whole;
    return whole.empty() ? whole : whole.substr(prefix.size());
  }
  std::string changed(const std::string& what, const std::string& with) const {
    std::string text = camera(0, "") + camera(1, moved("-0.1"));
    const std::size_t at = text.rfind(what);
    EXPECT_NE(at, std::string::npos) << what;
    return line(text.replace(at, what.size(), with));
  }
};

TEST_F(KalibrCalibration, TIsOfTheRightCameraInMetres) {
  // The right camera stands at C = (0.11, 0.002, -0.001) from the left one, with parallel axes: x1 = x0 - C.
  // The rectified pair is |C| = sqrt(0.0121 + 4e-6 + 1e-6) = 0.1100227 apart, along its x axis.
  const Calibration c = read(camera(0, "") + camera(1, transform("T_cn_cnm1", "1, 0, 0, -0.11",
                                                                 "0, 1, 0, -0.002", "0, 0, 1, 0.001")));
  EXPECT_EQ(c.model, LensModel::kPinhole);
  EXPECT_EQ(c.unit, "m");
  EXPECT_EQ(c.size.width, 640);
  EXPECT_EQ(c.left.camera, cv::Matx33d(461.5, 0, 330, 0, 460.25, 235, 0, 0, 1));
  EXPECT_EQ(c.right.distortion, (std::vector<double>{-0.2, 0.05, 1e-4, -0.0003}));
  EXPECT_NEAR(c.geometry->baseline, 0.1100227, 1e-7);
  const cv::Vec3d axis = c.R1 * cv::Vec3d(0.11, 0.002, -0.001);
  EXPECT_NEAR(axis[0], 0.1100227, 1e-7);
  EXPECT_NEAR(axis[1], 0, 1e-9);
  EXPECT_NEAR(axis[2], 0, 1e-9);
}

TEST_F(KalibrCalibration, APinholeWithEquidistantDistortionIsOpenCvsFisheye) {
  const std::string d = "-0.01, 0.02, -0.01, 0.002";
  const Calibration c = read(camera(0, "", "equidistant", d) + camera(1, moved("-0.1"), "equidistant", d));
  EXPECT_EQ(c.model, LensModel::kFisheye);
  EXPECT_EQ(c.left.distortion, (std::vector<double>{-0.01, 0.02, -0.01, 0.002}));
  EXPECT_NEAR(c.geometry->baseline, 0.1, 1e-9);
  EXPECT_EQ(read(camera(0, "", "none", "") + camera(1, moved("-0.1"), "none", "")).left.distortion,
            std::vector<double>(4, 0));
}

TEST_F(KalibrCalibration, AnyTwoCamerasOfTheChain) {
  // 0.1 m from camera 0 to 1, 0.2 from 1 to 2.
  EXPECT_NEAR(read(chain()).geometry->baseline, 0.1, 1e-9);
  EXPECT_NEAR(read(chain(), CameraPair{1, 2}).geometry->baseline, 0.2, 1e-9);
  EXPECT_NEAR(read(chain(), CameraPair{0, 2}).geometry->baseline, 0.3, 1e-9);
  EXPECT_EQ(
      line(chain(), CameraPair{2, 0}),
      "the rectification of R and T: the right camera lies 0.3 to the left of the left one; are the images "
      "exchanged?");
  // Camera 1 stands to the left of 0.
  EXPECT_NEAR(read(camera(0, "") + camera(1, moved("0.1")), CameraPair{1, 0}).geometry->baseline, 0.1, 1e-9);
  EXPECT_EQ(line(chain(), CameraPair{2, 3}), "holds no camera 3, but 0, 1 and 2");
}

TEST_F(KalibrCalibration, ARealRigRectifiesAsFromOpenCvsFile) {
  const std::string file = test::shared_data("euroc_v101/calib.yml");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no shared data";
  const Calibration stated = read_calibration({file});
  cv::Mat r;
  cv::Mat t;
  const cv::FileStorage storage(file, cv::FileStorage::READ);
  storage["R"] >> r;
  storage["T"] >> t;
  const auto row = [&](int i) {
    return fmt::format("{}, {}, {}, {}", r.at<double>(i, 0), r.at<double>(i, 1), r.at<double>(i, 2),
                       t.at<double>(i));
  };
  const auto entry = [](int number, const Lens& lens) {
    const cv::Matx33d& k = lens.camera;
    return fmt::format(
        "cam{}:\n  camera_model: pinhole\n  distortion_model: radtan\n  resolution: [752, 480]\n"
        "  intrinsics: [{}, {}, {}, {}]\n  distortion_coeffs: [{}]\n",
        number, k(0, 0), k(1, 1), k(0, 2), k(1, 2), fmt::join(lens.distortion, ", "));
  };
  const Calibration chain =
      read(entry(0, stated.left) + entry(1, stated.right) + transform("T_cn_cnm1", row(0), row(1), row(2)));
  EXPECT_LT(cv::norm(chain.R1 - stated.R1), 1e-9);
  EXPECT_LT(cv::norm(chain.P2 - stated.P2), 1e-3);
  EXPECT_NEAR(chain.geometry->baseline, stated.geometry->baseline, 1e-6);
}

TEST_F(KalibrCalibration, TransformsFromTheImuStandIn) {
  // Both cameras are turned by 90 degrees about z against the IMU; c1 = R i + (0.88, 2, 3), c0 = R i + (1, 2,
  // 3), so c1 = c0 + (-0.12, 0, 0).
  const auto from_imu = [](const std::string& x) {
    return transform("T_cam_imu", "0, -1, 0, " + x, "1, 0, 0, 2", "0, 0, 1, 3");
  };
  const std::string text = camera(0, from_imu("1")) + camera(1, from_imu("0.88"));
  EXPECT_NEAR(read(text).geometry->baseline, 0.12, 1e-9);
  EXPECT_NEAR(read(text + moved("-0.1")).geometry->baseline, 0.1, 1e-9) << "T_cn_cnm1 comes first";
  // OpenVINS: x of the cameras along +y of the IMU, the right one 0.12 further there.
  const auto to_imu = [](const std::string& y) {
    return transform("T_imu_cam", std::string("0, -1, 0, 1"), "1, 0, 0, " + y, "0, 0, 1, 3");
  };
  EXPECT_NEAR(read(camera(0, to_imu("2")) + camera(1, to_imu("2.12"))).geometry->baseline, 0.12, 1e-9);
  EXPECT_EQ(line(camera(0, "") + camera(1, to_imu("2.12"))), "cam1: T_cn_cnm1 is missing");
}

TEST_F(KalibrCalibration, WaysToWriteIt) {
  const double expected = read(chain()).P2(0, 3);
  EXPECT_EQ(read("%YAML:1.0\n---\n# of Monday\n" + chain()).P2(0, 3), expected) << "with OpenCV's head";
  std::string text = chain();
  text.replace(text.find("pinhole"), 7, "\"pinhole\"   # the projection");
  text.replace(text.find("radtan"), 6, "'radtan'");
  for (std::size_t end = 0; (end = text.find('\n', end)) != std::string::npos; end += 2)
    text.insert(end, "\r");
  EXPECT_EQ(read(text).P2(0, 3), expected);
  EXPECT_EQ(
      read(camera(0, "") + camera(1, "  T_cn_cnm1: [1, 0, 0, -0.1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\n"))
          .P2(0, 3),
      expected);
}

TEST_F(KalibrCalibration, OtherModelsAreRefusedByName) {
  for (const char* name : {"omni", "ds", "eucm"}) {
    EXPECT_EQ(changed("camera_model: pinhole", std::string("camera_model: ") + name),
              std::string("cam1: camera_model: \"") + name + "\" is not supported, only pinhole");
  }
  EXPECT_EQ(changed("distortion_model: radtan", "distortion_model: fov"),
            "cam1: distortion_model: \"fov\" is not supported, only radtan, equidistant and none");
  EXPECT_EQ(changed("distortion_model: radtan", "distortion_model: equidistant"),
            "cam1: distortion_model: equidistant, but the left camera has radtan; both lenses of a pair are "
            "of one model");
}

TEST_F(KalibrCalibration, DamageIsNamed) {
  EXPECT_EQ(changed("  camera_model: pinhole\n", ""), "cam1: camera_model is missing");
  EXPECT_EQ(changed("  resolution: [640, 480]\n", ""), "cam1: resolution is missing");
  EXPECT_EQ(changed("[640, 480]", "[480, 640]"),
            "cam1: resolution: 480x640, but the left camera has 640x480; those of a pair have one size");
  EXPECT_EQ(changed("[640, 480]", "[640]"), "cam1: resolution has 1 numbers, 1x2 expected");
  EXPECT_EQ(changed("461.5, 460.25, 330.0, 235.0", "0.8, 461.5, 460.25, 330.0, 235.0"),
            "cam1: intrinsics has 5 numbers, 1x4 expected");
  EXPECT_EQ(changed("461.5", "-461.5"),
            "cam1: intrinsics: not a camera matrix: focal lengths -461.5 and 460.25 px, last element 1");
  EXPECT_EQ(changed("461.5", "1e308"),
            "cam1: intrinsics: not a camera matrix: focal lengths 1e+308 and 460.25 px, last element 1");
  EXPECT_EQ(changed("-0.2, 0.05", ".inf, 0.05"),
            "cam1: distortion_coeffs holds a value that is not a finite number");
  EXPECT_EQ(changed("-0.2, 0.05, ", ""),
            "cam1: distortion_coeffs: 2 coefficients, 4, 5, 8, 12, 14 expected for this camera model");
  EXPECT_EQ(changed("T_cn_cnm1", "T"), "cam1: T_cn_cnm1 is missing");
  EXPECT_EQ(changed("[1.0, 0.0, 0.0, -0.1]", "[1.0, 0.0, -0.1]"),
            "cam1: T_cn_cnm1 has a row of 3 numbers, 4 expected");
  EXPECT_EQ(changed("[1.0, 0.0, 0.0, -0.1]", "[2.0, 0.0, 0.0, -0.1]"),
            "cam1: T_cn_cnm1: not a rotation matrix");
  EXPECT_EQ(changed("[0.0, 0.0, 0.0, 1.0]", "[0.0, 0.0, 0.0, 2.0]"),
            "cam1: T_cn_cnm1: the last row is 0, 0, 0, 2; that of a transform is 0, 0, 0, 1");
  EXPECT_EQ(changed("-0.1]", "0]"), "cam1: T_cn_cnm1: the baseline is zero");
  EXPECT_EQ(changed("camera_model: pinhole", "camera_model: \"pin\\nhole\""),
            "cam1: camera_model: \"pin hole\" is not supported, only pinhole");
  EXPECT_EQ(changed("cam1:", "cam1: 5\nx:"), "cam1: no named entries");
  EXPECT_EQ(line(camera(0, "")), "cam1 is missing");
  EXPECT_EQ(changed("  camera_model: pinhole", " camera_model: pinhole").find("not YAML: line "), 0U);
}

}  // namespace kalibr_calibration_test
}  // namespace parallax
