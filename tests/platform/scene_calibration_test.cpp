// SPDX-License-Identifier: Apache-2.0
#include "platform/scene/scene_calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "error_line.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace scene_calibration_test {

TEST(SceneCalibration, CalibrationIsConsistentInOpenCvConventions) {
  const SceneCalibration c = scene_calibration(SceneConfig{});
  const cv::Matx33d r1 = c.left.rectifying_rotation;
  const cv::Matx33d r2 = c.right.rectifying_rotation;
  EXPECT_LT(cv::norm(r1 * r1.t() - cv::Matx33d::eye()), 1e-14);
  EXPECT_LT(cv::norm(r2 * r2.t() - cv::Matx33d::eye()), 1e-14);
  EXPECT_LT(cv::norm(r2 * c.r * r1.t() - cv::Matx33d::eye()), 1e-14);
  EXPECT_LT(cv::norm(r2 * c.t - cv::Vec3d(c.p2(0, 3) / c.p2(0, 0), 0, 0)), 1e-14);
  // A point of disparity d: Q must give the depth f B / d.
  const cv::Vec4d point = c.q * cv::Vec4d(100, 50, 32, 1);
  EXPECT_NEAR(point[2] / point[3], -c.p2(0, 3) / 32, 1e-12);

  // OpenCV's own rectification of these cameras is another rotation about the same baseline.
  cv::Mat cv_r1, cv_r2, cv_p1, cv_p2, cv_q;
  cv::stereoRectify(c.left.camera_matrix, c.left.distortion, c.right.camera_matrix, c.right.distortion,
                    {c.width, c.height}, c.r, c.t, cv_r1, cv_r2, cv_p1, cv_p2, cv_q, cv::CALIB_ZERO_DISPARITY,
                    0);
  EXPECT_LT(cv::norm(cv_r1.row(0), cv::Mat(r1).row(0)), 1e-12);
  EXPECT_NEAR(cv_p2.at<double>(0, 3) / cv_p2.at<double>(0, 0), c.p2(0, 3) / c.p2(0, 0), 1e-12);
}

TEST(SceneCalibration, LensProjectsAsOpenCvAndInverts) {
  const SceneCalibration c = scene_calibration(SceneConfig{});
  for (const SceneLens* lens : {&c.left, &c.right}) {
    for (const cv::Vec2d& ray :
         {cv::Vec2d(0, 0), cv::Vec2d(0.5, 0.3), cv::Vec2d(-0.55, 0.41), cv::Vec2d(0.2, -0.4)}) {
      std::vector<cv::Point2d> expected;
      cv::Mat rodrigues;
      cv::Rodrigues(lens->rectifying_rotation.t(), rodrigues);
      cv::projectPoints(std::vector<cv::Point3d>{{ray[0], ray[1], 1}}, rodrigues, cv::Vec3d(0, 0, 0),
                        lens->camera_matrix, lens->distortion, expected);
      const cv::Vec2d pixel = lens->project(ray);
      EXPECT_NEAR(pixel[0], expected[0].x, 1e-9);
      EXPECT_NEAR(pixel[1], expected[0].y, 1e-9);
      EXPECT_LT(cv::norm(lens->unproject(pixel) - ray), 1e-12);
    }
  }
}

TEST(SceneCalibration, YamlHoldsTheCalibration) {
  for (const bool distortion : {true, false}) {
    SceneConfig config;
    config.distortion = distortion;
    const SceneCalibration c = scene_calibration(config);
    cv::FileStorage file(to_yaml(c), cv::FileStorage::READ | cv::FileStorage::MEMORY);
    ASSERT_TRUE(file.isOpened());
    EXPECT_EQ(static_cast<std::string>(file["camera_model"]), distortion ? "pinhole_radtan" : "rectified");
    EXPECT_EQ(static_cast<int>(file["image_width"]), 640);
    EXPECT_EQ(static_cast<int>(file["image_height"]), 480);
    EXPECT_EQ(static_cast<int>(file["num_disparities"]), 128);
    const auto read = [&](const char* name) {
      cv::Mat m;
      file[name] >> m;
      return m;
    };
    EXPECT_EQ(cv::norm(read("K1"), cv::Mat(c.left.camera_matrix)), 0);
    EXPECT_EQ(cv::norm(read("D1").t(), cv::Mat(c.left.distortion)), 0);
    EXPECT_EQ(cv::norm(read("K2"), cv::Mat(c.right.camera_matrix)), 0);
    EXPECT_EQ(cv::norm(read("D2").t(), cv::Mat(c.right.distortion)), 0);
    EXPECT_EQ(cv::norm(read("R"), cv::Mat(c.r)), 0);
    EXPECT_EQ(cv::norm(read("T"), cv::Mat(c.t)), 0);
    EXPECT_EQ(cv::norm(read("R1"), cv::Mat(c.left.rectifying_rotation)), 0);
    EXPECT_EQ(cv::norm(read("R2"), cv::Mat(c.right.rectifying_rotation)), 0);
    EXPECT_EQ(cv::norm(read("P1"), cv::Mat(c.p1)), 0);
    EXPECT_EQ(cv::norm(read("P2"), cv::Mat(c.p2)), 0);
    EXPECT_EQ(cv::norm(read("Q"), cv::Mat(c.q)), 0);
  }
}

TEST(SceneConfig, RejectsWhatIsOutOfRange) {
  const auto message = [](auto change) {
    SceneConfig config;
    change(config);
    return error_line<UserError>([&] { config.validate(); });
  };
  EXPECT_EQ(message([](SceneConfig&) {}), "no error");
  EXPECT_EQ(message([](SceneConfig& c) { c.width = 0; }), "scene.width is 0, allowed is 1 to 65536");
  EXPECT_EQ(message([](SceneConfig& c) { c.height = 65537; }),
            "scene.height is 65537, allowed is 1 to 65536");
  EXPECT_EQ(message([](SceneConfig& c) { c.disparities = 257; }),
            "scene.disparities is 257, allowed is 1 to 256");
  EXPECT_EQ(message([](SceneConfig& c) { c.disparity_offset = -1; }),
            "scene.disparity_offset is -1, allowed is 0 to 255");
  EXPECT_EQ(message([](SceneConfig& c) { c.disparity_offset = 129; }),
            "scene.disparity_offset + scene.disparities is 129 + 128 = 257, allowed is at most 256");
  EXPECT_EQ(message([](SceneConfig& c) { c.read_noise = 51; }), "scene.read_noise is 51, allowed is 0 to 50");
  EXPECT_EQ(message([](SceneConfig& c) { c.shot_noise = std::nan(""); }),
            "scene.shot_noise is nan, allowed is 0 to 1");
  EXPECT_EQ(message([](SceneConfig& c) { c.vignetting = 1; }), "scene.vignetting is 1, allowed is 0 to 0.9");
  EXPECT_EQ(message([](SceneConfig& c) { c.motion = 3; }), "scene.motion is 3, allowed is 0 to 2");
}

}  // namespace scene_calibration_test
}  // namespace parallax
