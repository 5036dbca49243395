// SPDX-License-Identifier: Apache-2.0
#include "platform/input/euroc_calibration.hpp"

#include <gtest/gtest.h>

#include "platform/input/read_calibration.hpp"
#include "tests/platform/test_calibrations.hpp"

namespace parallax {
namespace euroc_calibration_test {

using test::message;

std::string sensor(const std::string& x, const std::string& model = "radial-tangential") {
  return "#Default names\nsensor_type: camera\ncomment: a camera\nT_BS:\n  cols: 4\n  rows: 4\n  data: [0.0, "
         "-1.0, 0.0, " +
         x +
         ",\n         1.0, 0.0, 0.0, 0.2,\n         0.0, 0.0, 1.0, 0.3,\n         0.0, 0.0, 0.0, "
         "1.0]\nrate_hz: 20\n"
         "resolution: [640, 480]\ncamera_model: pinhole\nintrinsics: [450.5, 451.0, 330.0, 235.0] #fu, fv, "
         "cu, cv\n"
         "distortion_model: " +
         model + "\ndistortion_coefficients: [-0.28, 0.07, 0.0002, 1.76e-05]\n";
}

class EurocCalibration : public test::FolderTest {};

TEST_F(EurocCalibration, BothCamerasAreRelativeToTheBody) {
  // Camera axes in the body: x along +y, y along -x. The right camera is 0.12 further along +y of the body,
  // so along its own +x; both have the same axes: x_right = x_left - (0.12, 0, 0).
  std::string right = sensor("0.1");
  right.replace(right.find("0.2,"), 4, "0.32,");
  const Calibration c = read_calibration({write("cam0.yaml", sensor("0.1")), write("cam1.yaml", right)});
  EXPECT_EQ(c.model, LensModel::kPinhole);
  EXPECT_EQ(c.unit, "m");
  EXPECT_EQ(c.left.camera, cv::Matx33d(450.5, 0, 330, 0, 451, 235, 0, 0, 1));
  EXPECT_EQ(c.left.distortion, (std::vector<double>{-0.28, 0.07, 0.0002, 1.76e-05}));
  EXPECT_NEAR(c.geometry->baseline, 0.12, 1e-9);
}

TEST_F(EurocCalibration, FaultsAreNamed) {
  const std::string left = write("cam0.yaml", sensor("0.1"));
  EXPECT_EQ(message([&] { read_calibration({left}); }),
            left + ": a sensor.yaml of EuRoC is of one camera: a pair is two files, left and right");
  const std::string same = write("cam1.yaml", sensor("0.1"));
  EXPECT_EQ(message([&] { read_calibration({left, same}); }), same + ": T_BS: the baseline is zero");
  const std::string other = write("cam2.yaml", sensor("0.1", "equidistant"));
  EXPECT_EQ(message([&] {
              read_calibration({left, other});
            }),
            other +
                ": distortion_model: equidistant, but the left camera has radial-tangential; both lenses of "
                "a pair are "
                "of one model");
}

}  // namespace euroc_calibration_test
}  // namespace parallax
