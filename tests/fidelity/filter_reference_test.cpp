// SPDX-License-Identifier: Apache-2.0
// The disparity filters, one after the other, against their naive references on a real disparity map.
#include <gtest/gtest.h>

#include "tests/fidelity/stereo_chain.hpp"
#include "tests/fidelity/stereo_scene.hpp"
#include "tests/modules/naive_gap_interpolation.hpp"
#include "tests/modules/naive_noise_reduction.hpp"
#include "tests/modules/naive_speckle.hpp"
#include "tests/modules/naive_texture.hpp"

namespace parallax::test {
namespace filter_reference_test {

TEST(FilterReference, RealDisparities) {
  const auto scene = aloe_scene();
  if (!scene) GTEST_SKIP() << "opencv-doc is not installed";
  const int width = scene->left.cols;
  const int height = scene->left.rows;
  MachineConfig config = shipped_config();
  config.texture.threshold = 40;  // enough to take part in this well-textured scene
  const std::vector<Disparity> filtered_by_kernels = run_chain(config, scene->left, scene->right);

  MachineConfig unfiltered = config;
  unfiltered.texture.enabled = unfiltered.gap_interpolation.enabled = unfiltered.noise_reduction.enabled =
      false;
  unfiltered.speckle.iterations = 0;
  DisparityImage disparities(width, height);
  disparities.pixels = run_chain(unfiltered, scene->left, scene->right);
  Image<Gray> gray(width, height);
  std::copy(scene->left.begin<Gray>(), scene->left.end<Gray>(), gray.pixels.begin());

  const DisparityImage textured = naive_texture(config.texture, gray, disparities);
  const DisparityImage without_speckles = naive_speckle(config.speckle, textured);
  const DisparityImage filled = naive_gap_interpolation(config.gap_interpolation, without_speckles);
  const DisparityImage expected = naive_noise_reduction(config.noise_reduction, filled);
  EXPECT_NE(textured.pixels, disparities.pixels);
  EXPECT_NE(without_speckles.pixels, textured.pixels);
  EXPECT_NE(filled.pixels, without_speckles.pixels);
  EXPECT_NE(expected.pixels, filled.pixels);
  DisparityImage actual(width, height);
  actual.pixels = filtered_by_kernels;
  expect_equal(actual, expected);
}

}  // namespace filter_reference_test
}  // namespace parallax::test
