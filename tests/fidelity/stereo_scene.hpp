// SPDX-License-Identifier: Apache-2.0
// Real stereo pairs with ground truth, for fidelity tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <vector>

#include "platform/images/image_codecs.hpp"
#include "platform/results/truth_file.hpp"
#include "tests/paths.hpp"

namespace parallax::test {

struct StereoScene {
  std::string name;
  int disparities = 128;
  cv::Mat left;   ///< 8-bit gray
  cv::Mat right;  ///< 8-bit gray
  GroundTruth truth;
};

/// A scene of the development data set beside the sources, if it is there: left.png, right.png, disp_gt.png,
/// mask_nocc.png.
inline std::optional<StereoScene> shared_scene(const std::string& name, int disparities) {
  const std::string folder = shared_data(name + "/");
  if (!std::filesystem::exists(folder + "disp_gt.png")) return std::nullopt;
  StereoScene scene;
  scene.name = name;
  scene.disparities = disparities;
  scene.left = read_image(folder + "left.png", cv::IMREAD_GRAYSCALE);
  scene.right = read_image(folder + "right.png", cv::IMREAD_GRAYSCALE);
  scene.truth = read_ground_truth({folder + "disp_gt.png", folder + "mask_nocc.png", std::nullopt},
                                  scene.left.cols, scene.left.rows, {});
  return scene;
}

/// Selects the pixels that the right image shows: no nearer pixel of the row falls on the same place.
inline std::vector<std::uint8_t> visible_in_both(const GroundTruth& truth) {
  constexpr double kSameSurface = 1.0;  // px
  std::vector<std::uint8_t> mask(truth.disparity.size(), 0);
  for (int y = 0; y < truth.height; ++y) {
    const std::size_t begin = static_cast<std::size_t>(y) * static_cast<std::size_t>(truth.width);
    std::vector<double> nearest(static_cast<std::size_t>(truth.width), 0.0);
    const auto for_each_known = [&](const auto& visit) {
      for (int x = 0; x < truth.width; ++x) {
        const std::size_t i = begin + static_cast<std::size_t>(x);
        const double d = truth.disparity[i];
        const auto u = static_cast<int>(std::lround(x - d));
        if (truth.disparity[i] != 0 && u >= 0) visit(i, static_cast<std::size_t>(u), d);
      }
    };
    for_each_known([&](std::size_t, std::size_t u, double d) { nearest[u] = std::max(nearest[u], d); });
    for_each_known([&](std::size_t i, std::size_t u, double d) {
      mask[i] = d >= nearest[u] - kSameSurface ? 255 : 128;
    });
  }
  return mask;
}

/// The Aloe pair of opencv-doc (8-bit ground truth in px at full size), reduced to a third so that 128
/// disparities do.
inline std::optional<StereoScene> aloe_scene() {
  const std::string folder = "/usr/share/doc/opencv-doc/examples/data/";
  if (!std::filesystem::exists(folder + "aloeGT.png")) return std::nullopt;
  constexpr int kReduction = 3;
  const cv::Mat left = read_image(folder + "aloeL.jpg", cv::IMREAD_GRAYSCALE);
  const cv::Mat right = read_image(folder + "aloeR.jpg", cv::IMREAD_GRAYSCALE);
  const cv::Mat truth = read_image(folder + "aloeGT.png", cv::IMREAD_GRAYSCALE);
  StereoScene scene;
  scene.name = "aloe/3";
  const cv::Size size(left.cols / kReduction, left.rows / kReduction);
  cv::resize(left, scene.left, size, 0, 0, cv::INTER_AREA);
  cv::resize(right, scene.right, size, 0, 0, cv::INTER_AREA);
  scene.truth = {size.width, size.height, {}, {}, 1};
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const int d = truth.at<std::uint8_t>(kReduction * y + kReduction / 2, kReduction * x + kReduction / 2);
      scene.truth.disparity.push_back(static_cast<float>(d) / kReduction);
    }
  }
  scene.truth.mask = visible_in_both(scene.truth);
  return scene;
}

}  // namespace parallax::test
