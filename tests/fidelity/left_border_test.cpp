// SPDX-License-Identifier: Apache-2.0
// What a disparity near the left border is: at column x only matches up to x lie in the right image.
#include <gtest/gtest.h>

#include "tests/fidelity/stereo_chain.hpp"
#include "tests/fidelity/stereo_scene.hpp"

namespace parallax::test {
namespace left_border_test {

TEST(LeftBorder, OnlyMatchesInTheRightImageRemain) {
  const auto scene = shared_scene("cloth3", 128);
  if (!scene) GTEST_SKIP() << "no stereo pairs with ground truth here";
  MachineConfig config = shipped_config();
  config.gap_interpolation.enabled = config.noise_reduction.enabled = false;
  const std::vector<Disparity> output = run_chain(config, scene->left, scene->right);
  const int width = scene->truth.width;
  int in_view = 0;
  int found = 0;
  int right = 0;
  int out_of_view = 0;
  int guessed = 0;
  for (std::size_t i = 0; i < output.size(); ++i) {
    const int x = static_cast<int>(i % static_cast<std::size_t>(width));
    const bool valid = output[i].valid();
    ASSERT_TRUE(!valid || integer_disparity(output[i]) <= x);
    const double truth = scene->truth.disparity[i];
    if (truth == 0 || x >= config.matching.range().last()) continue;
    if (scene->truth.mask[i] == 255) {
      ++in_view;
      found += valid;
      right += valid && scene->truth.error(i, output[i]) <= 2;
    } else if (truth > x) {
      ++out_of_view;
      guessed += valid;
    }
  }
  // StereoSGBM gives nothing in these columns.
  EXPECT_GT(found, 0.85 * in_view);
  EXPECT_GT(right, 0.95 * found);
  EXPECT_LT(guessed, 0.05 * out_of_view);
}

}  // namespace left_border_test
}  // namespace parallax::test
