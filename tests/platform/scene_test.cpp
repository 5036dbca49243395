// SPDX-License-Identifier: Apache-2.0
#include "platform/scene/scene.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "platform/scene/scene_geometry.hpp"
#include "platform/scene/scene_hash.hpp"

namespace parallax {
namespace scene_test {

SceneConfig quiet(int width, int height) {
  SceneConfig config;
  config.width = width;
  config.height = height;
  config.read_noise = 0;
  config.shot_noise = 0;
  config.vignetting = 0;
  return config;
}

struct Maps {
  cv::Mat x, y;
};

Maps exact_maps(const SceneCalibration& c, bool left) {
  const SceneLens& lens = left ? c.left : c.right;
  Maps maps;
  cv::initUndistortRectifyMap(lens.camera_matrix, lens.distortion, lens.rectifying_rotation,
                              (left ? c.p1 : c.p2).get_minor<3, 3>(0, 0), {c.width, c.height}, CV_32FC1,
                              maps.x, maps.y);
  return maps;
}

StereoImages rectify(const Scene& scene, const StereoImages& raw) {
  StereoImages result;
  const Maps left = exact_maps(scene.calibration(), true);
  const Maps right = exact_maps(scene.calibration(), false);
  cv::remap(raw.left, result.left, left.x, left.y, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::remap(raw.right, result.right, right.x, right.y, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return result;
}

/// Absolute differences between the left image and the right one at the ground truth's place, sorted.
std::vector<double> match_errors(const StereoImages& rectified, const SceneTruth& truth) {
  std::vector<double> errors;
  for (int y = 0; y < truth.mask.rows; ++y) {
    for (int x = 0; x < truth.mask.cols; ++x) {
      if (truth.mask.at<std::uint8_t>(y, x) != 255) {
        continue;
      }
      const double xr = x - truth.disparity.at<std::uint16_t>(y, x) / 256.0;
      const int x0 = std::clamp(static_cast<int>(std::floor(xr)), 0, truth.mask.cols - 1);
      const int x1 = std::min(x0 + 1, truth.mask.cols - 1);
      const double value = rectified.right.at<std::uint8_t>(y, x0) * (1 - (xr - x0)) +
                           rectified.right.at<std::uint8_t>(y, x1) * (xr - x0);
      errors.push_back(std::abs(value - rectified.left.at<std::uint8_t>(y, x)));
    }
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

std::uint64_t checksum(const cv::Mat& image) {
  std::uint64_t sum = 0;
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      sum = scene_hash(sum, image.at<std::uint8_t>(y, x));
    }
  }
  return sum;
}

double share(const cv::Mat& mask, int value) {
  return cv::countNonZero(mask == value) / static_cast<double>(mask.total());
}

TEST(Scene, SameConfigurationGivesTheSameBytes) {
  SceneConfig config;
  config.width = 160;
  config.height = 120;
  config.disparities = 32;
  const StereoImages a = Scene(config).render(3);
  const StereoImages b = Scene(config).render(3);
  EXPECT_TRUE(same(a.left, b.left));
  EXPECT_TRUE(same(a.right, b.right));
  EXPECT_EQ(checksum(a.left), 12936069081736555105u) << "the picture of seed 1 has changed";
  config.seed = 2;
  EXPECT_FALSE(same(Scene(config).render(3).left, a.left));
}

TEST(Scene, EverySizeRendersAndItsRectificationFitsTheWindow) {
  const cv::Size sizes[] = {{1, 1},     {1, 64},      {64, 1},      {7, 5},     {33, 16},  {320, 240},
                            {640, 480}, {1600, 1200}, {1856, 1856}, {1856, 16}, {16, 1856}};
  for (const cv::Size size : sizes) {
    SCOPED_TRACE(fmt::format("{}x{}", size.width, size.height));
    SceneConfig config;
    config.width = size.width;
    config.height = size.height;
    const Scene scene(config);
    const StereoImages raw = scene.render(0);
    EXPECT_EQ(raw.left.size(), size);
    EXPECT_EQ(raw.right.size(), size);
    EXPECT_EQ(raw.left.type(), CV_8UC1);
    const SceneTruth truth = scene.truth(0);
    EXPECT_EQ(truth.disparity.size(), size);
    EXPECT_EQ(truth.disparity.type(), CV_16UC1);
    EXPECT_EQ(truth.mask.size(), size);
    double largest = 0;
    for (const bool left : {true, false}) {
      const Maps maps = exact_maps(scene.calibration(), left);
      for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
          largest = std::max({largest, std::abs(double{maps.x.at<float>(y, x)} - x),
                              std::abs(double{maps.y.at<float>(y, x)} - y)});
        }
      }
    }
    EXPECT_LE(largest, 39);
    EXPECT_GE(largest, std::min(30.0, 0.01 * std::max(size.width, size.height) - 0.5));
    EXPECT_NEAR(largest, scene.calibration().largest_offset(), 0.5);
  }
}

// The depth of a ray on a plane from three points of the plane and Cramer's rule, not from the scene's linear
// forms.
TEST(Scene, TruthIsTheAnalyticDepthOfThePlanes) {
  SceneConfig config = quiet(320, 240);
  config.disparities = 64;
  const SceneFrame view = scene_frame(config);
  for (const int frame : {0, 17}) {
    const std::vector<SceneSurface> surfaces = place_surfaces(config, frame);
    const SceneTruth truth = Scene(config).truth(frame);
    for (int y = 0; y < config.height; ++y) {
      for (int x = 0; x < config.width; ++x) {
        const cv::Vec3d ray((x - view.cx) / view.focal, (y - view.cy) / view.focal, 1);
        double nearest = 1e9;
        for (const SceneSurface& s : surfaces) {
          const cv::Vec3d normal = s.inverse_plane / cv::norm(s.inverse_plane);
          const cv::Vec3d e1 =
              normal.cross(std::abs(normal[0]) < 0.9 ? cv::Vec3d(1, 0, 0) : cv::Vec3d(0, 1, 0));
          const cv::Vec3d e2 = normal.cross(e1);
          // anchor + a e1 + b e2 = z ray
          const cv::Matx33d system(e1[0], e2[0], -ray[0], e1[1], e2[1], -ray[1], e1[2], e2[2], -ray[2]);
          const cv::Vec3d solution = system.solve(-s.anchor, cv::DECOMP_LU);
          const double z = solution[2];
          const cv::Vec3d local = ray * z - s.anchor;
          const double u = local.dot(s.axis_u);
          const double v = local.dot(s.axis_v);
          const bool hit =
              s.outline == SceneSurface::Outline::kUnbounded ||
              (s.outline == SceneSurface::Outline::kRectangle && std::abs(u) <= s.half_u &&
               std::abs(v) <= s.half_v) ||
              (s.outline == SceneSurface::Outline::kEllipse && std::hypot(u / s.half_u, v / s.half_v) <= 1);
          if (hit && z > 0) {
            nearest = std::min(nearest, z);
          }
        }
        const double expected = view.focal * view.baseline / nearest * 256;
        if (truth.mask.at<std::uint8_t>(y, x) != 0) {
          ASSERT_NEAR(truth.disparity.at<std::uint16_t>(y, x), expected, 0.5001) << x << "," << y;
        }
      }
    }
  }
}

TEST(Scene, RectifiedLeftMatchesRightAtTheTruth) {
  for (const int frame : {0, 40}) {
    SceneConfig config = quiet(640, 480);
    Scene scene(config);
    std::vector<double> errors = match_errors(rectify(scene, scene.render(frame)), scene.truth(frame));
    ASSERT_GT(errors.size(), 640u * 480u * 7 / 10);
    EXPECT_LE(errors[errors.size() / 2], 1.5);
    EXPECT_LE(errors[errors.size() * 95 / 100], 8);

    config.distortion = false;
    scene = Scene(config);
    errors = match_errors(scene.render(frame), scene.truth(frame));
    EXPECT_LE(errors[errors.size() / 2], 1.5);
    EXPECT_LE(errors[errors.size() * 95 / 100], 8);
  }
}

TEST(Scene, RectificationUndoesTheLens) {
  SceneConfig config = quiet(640, 480);
  const Scene lens(config);
  const cv::Mat rectified = rectify(lens, lens.render(0)).left;
  config.distortion = false;
  const cv::Mat ideal = Scene(config).render(0).left;
  const cv::Mat raw = lens.render(0).left;
  const cv::Rect centre(20, 20, 600, 440);
  EXPECT_LT(cv::norm(rectified(centre), ideal(centre), cv::NORM_L1) / centre.area(), 3);
  EXPECT_GT(cv::norm(raw(centre), ideal(centre), cv::NORM_L1) / centre.area(), 10);
}

TEST(Scene, StereoSgbmFindsTheTruth) {
  SceneConfig config;
  const Scene scene(config);
  const StereoImages images = rectify(scene, scene.render(0));
  const SceneTruth truth = scene.truth(0);
  const auto matcher = cv::StereoSGBM::create(0, config.disparities, 5, 8 * 25, 32 * 25, 1, 31, 5, 0, 0,
                                              cv::StereoSGBM::MODE_SGBM);
  cv::Mat found;
  matcher->compute(images.left, images.right, found);
  int known = 0, valid = 0, bad = 0;
  for (int y = 0; y < config.height; ++y) {
    for (int x = config.disparities; x < config.width; ++x) {
      if (truth.mask.at<std::uint8_t>(y, x) != 255) {
        continue;
      }
      ++known;
      const double d = found.at<std::int16_t>(y, x) / 16.0;
      if (d < 0) {
        continue;
      }
      ++valid;
      bad += std::abs(d - truth.disparity.at<std::uint16_t>(y, x) / 256.0) > 2 ? 1 : 0;
    }
  }
  RecordProperty("bad2_percent", fmt::format("{:.2f}", 100.0 * bad / valid));
  EXPECT_GT(valid, known * 9 / 10);
  EXPECT_LT(bad, valid * 3 / 100);
}

TEST(Scene, MaskTellsWhatBothCamerasSee) {
  const SceneConfig config;
  const SceneTruth truth = Scene(config).truth(0);
  EXPECT_GT(share(truth.mask, 255), 0.75);
  EXPECT_GT(share(truth.mask, 128), 0.08);
  EXPECT_LT(share(truth.mask, 0), 0.02);
  EXPECT_DOUBLE_EQ(share(truth.mask, 255) + share(truth.mask, 128) + share(truth.mask, 0), 1);
  for (int y = 0; y < config.height; ++y) {
    for (int x = 0; x < config.width; ++x) {
      const int d = truth.disparity.at<std::uint16_t>(y, x);
      const int mask = truth.mask.at<std::uint8_t>(y, x);
      ASSERT_EQ(d == 0, mask == 0);
      if (d > 256 * x + 1) {
        ASSERT_NE(mask, 255) << "the match is left of the right image at " << x << "," << y;
      }
    }
  }
}

// Independent of the ray-cast mask: the nearest left pixel to each right pixel wins, as in a z-buffer.
TEST(Scene, MaskAgreesWithAZBuffer) {
  SceneConfig config;
  config.distortion = false;
  const SceneTruth truth = Scene(config).truth(0);
  int differing = 0;
  for (int y = 0; y < config.height; ++y) {
    std::vector<double> front(static_cast<std::size_t>(config.width) + 1, 0);
    const auto place = [&](int x) { return x - truth.disparity.at<std::uint16_t>(y, x) / 256.0; };
    for (int x = 0; x < config.width; ++x) {
      const int xr = static_cast<int>(std::lround(place(x)));
      if (xr >= 0) {
        auto& slot = front[static_cast<std::size_t>(xr)];
        slot = std::max(slot, truth.disparity.at<std::uint16_t>(y, x) / 256.0);
      }
    }
    for (int x = 0; x < config.width; ++x) {
      const int xr = static_cast<int>(std::lround(place(x)));
      const double d = truth.disparity.at<std::uint16_t>(y, x) / 256.0;
      const bool visible = place(x) >= 0 && front[static_cast<std::size_t>(xr)] < d + 1;
      differing += visible != (truth.mask.at<std::uint8_t>(y, x) == 255) ? 1 : 0;
    }
  }
  EXPECT_LT(differing, config.width * config.height / 50);
}

TEST(Scene, DepthsStayInTheRangeThroughTheMotion) {
  struct Row {
    int width, height, disparities, offset;
  };
  const Row rows[] = {{640, 480, 128, 0}, {640, 480, 256, 0}, {320, 240, 64, 192}, {190, 100, 64, 192},
                      {96, 96, 256, 0},   {400, 20, 128, 64}, {64, 400, 128, 128}, {1856, 3, 256, 0}};
  for (const Row& row : rows) {
    SCOPED_TRACE(fmt::format("{}x{} d {} o {}", row.width, row.height, row.disparities, row.offset));
    SceneConfig config = quiet(row.width, row.height);
    config.disparities = row.disparities;
    config.disparity_offset = row.offset;
    config.motion = 2;
    config.distortion = false;
    const Scene scene(config);
    for (int frame = 0; frame < 128; frame += 7) {
      double low = 0, high = 0;
      cv::minMaxLoc(scene.truth(frame).disparity, &low, &high);
      ASSERT_GE(low, 256.0 * row.offset) << frame;
      ASSERT_LE(high, 256.0 * (row.offset + row.disparities - 1)) << frame;
    }
  }
}

TEST(Scene, WideRangeIsUsed) {
  SceneConfig config = quiet(1024, 768);
  config.disparities = 256;
  double low = 0, high = 0;
  cv::minMaxLoc(Scene(config).truth(0).disparity, &low, &high);
  EXPECT_LT(low / 256, 32);
  EXPECT_GT(high / 256, 190);
}

TEST(Scene, FramesMoveUnlessToldNotTo) {
  SceneConfig config = quiet(320, 240);
  const Scene moving(config);
  EXPECT_FALSE(same(moving.truth(0).disparity, moving.truth(5).disparity));
  EXPECT_FALSE(same(moving.render(0).left, moving.render(5).left));
  EXPECT_TRUE(same(moving.render(0).left, moving.render(128).left));
  config.motion = 0;
  const Scene still(config);
  EXPECT_TRUE(same(still.render(0).left, still.render(5).left));
  config.read_noise = 1;
  const Scene noisy(config);
  EXPECT_FALSE(same(noisy.render(0).left, noisy.render(5).left));
}

TEST(Scene, NoiseHasTheVarianceAskedFor) {
  SceneConfig config = quiet(320, 240);
  const StereoImages clean = Scene(config).render(0);
  config.read_noise = 3;
  config.shot_noise = 0.05;
  const StereoImages noisy = Scene(config).render(0);
  double sum = 0, squares = 0, expected = 0;
  int count = 0;
  for (int y = 0; y < config.height; ++y) {
    for (int x = 0; x < config.width; ++x) {
      const int grey = clean.left.at<std::uint8_t>(y, x);
      if (grey < 30 || grey > 225) {
        continue;  // clipping would bias the measurement
      }
      const double error = noisy.left.at<std::uint8_t>(y, x) - grey;
      sum += error;
      squares += error * error;
      expected += 9 + 0.05 * grey + 1.0 / 6;  // both images are rounded: 1/12 each
      ++count;
    }
  }
  ASSERT_GT(count, 50000);
  EXPECT_NEAR(sum / count, 0, 0.05);
  EXPECT_NEAR(squares / expected, 1, 0.03);
}

TEST(Scene, VignettingDarkensTheCorners) {
  SceneConfig config = quiet(320, 240);
  const double before = cv::mean(Scene(config).render(0).left(cv::Rect(0, 0, 40, 30)))[0];
  config.vignetting = 0.5;
  const double after = cv::mean(Scene(config).render(0).left(cv::Rect(0, 0, 40, 30)))[0];
  EXPECT_NEAR(after / before, 0.6, 0.05);
}

}  // namespace scene_test
}  // namespace parallax
