// SPDX-License-Identifier: Apache-2.0
#include "platform/config/nearest_key.hpp"

#include <gtest/gtest.h>

#include "platform/config/machine_config.hpp"
#include "platform/config/schema.hpp"

namespace parallax {
namespace nearest_key_test {

std::string nearest(const std::string& path) {
  static const std::vector<std::string> keys = [] {
    MachineConfig config;
    Schema schema;
    describe(schema, config);
    std::vector<std::string> all;
    for (const Key& key : schema.keys()) all.push_back(key.path);
    return all;
  }();
  return nearest_key(path, keys);
}

TEST(NearestKey, HasTheSameWordsInTheSameSection) {
  EXPECT_EQ(nearest("matching.cost_function"), "matching.cost");
  EXPECT_EQ(nearest("matching.outside"), "matching.outside_cost");
  EXPECT_EQ(nearest("matching.shift"), "matching.sum_shift");
  EXPECT_EQ(nearest("matching.overflow"), "matching.path_overflow");
  EXPECT_EQ(nearest("census.window"), "census.window_width");
  EXPECT_EQ(nearest("census.height"), "census.window_height");
  EXPECT_EQ(nearest("link.rate"), "link.line_rate");
  EXPECT_EQ(nearest("gap_interpolation.max_gap"), "gap_interpolation.l_max");
}

TEST(NearestKey, HasAWordThatBeginsLikeIt) {
  EXPECT_EQ(nearest("texture.thresh"), "texture.threshold");
  EXPECT_EQ(nearest("matching.num_paths"), "matching.paths");
  EXPECT_EQ(nearest("dma.left.burst"), "dma.left.burst_bytes");
  EXPECT_EQ(nearest("matching.max_disparity"), "matching.disparity_offset");
}

TEST(NearestKey, HasAWordOfTheSameMeaning) {
  EXPECT_EQ(nearest("matching.directions"), "matching.paths");
  EXPECT_EQ(nearest("matching.disparities"), "matching.iterations");
  EXPECT_EQ(nearest("matching.number_of_disparities"), "matching.iterations");
  EXPECT_EQ(nearest("noise_reduction.median"), "noise_reduction.kind");
  EXPECT_EQ(nearest("census.mask"), "census.border");
  EXPECT_EQ(nearest("matching.penalty1"), "matching.p1");
  EXPECT_EQ(nearest("matching.penalty_2"), "matching.p2");
  EXPECT_EQ(nearest("census.size"), "census.window_width");
  EXPECT_EQ(nearest("clocks.frequency"), "clocks.core_hz");
  EXPECT_EQ(nearest("camera.fps"), "camera.frame_rate");
  EXPECT_EQ(nearest("speckle.passes"), "speckle.iterations");
  EXPECT_EQ(nearest("uniqueness.ratio"), "uniqueness.factor");
  EXPECT_EQ(nearest("subpixel.method"), "subpixel.curve");
}

TEST(NearestKey, IsASlipOfFingersAway) {
  EXPECT_EQ(nearest("matching.pq"), "matching.p1");
  EXPECT_EQ(nearest("matching.1p"), "matching.p1");
  EXPECT_EQ(nearest("matching.P2"), "matching.p2");
  EXPECT_EQ(nearest("matching.cots"), "matching.cost");
  EXPECT_EQ(nearest("streams.winers.depth"), "streams.winners.depth");
}

TEST(NearestKey, TakesTheSectionThatIsLikeTheOneWritten) {
  EXPECT_EQ(nearest("mathcing.p1"), "matching.p1");
  EXPECT_EQ(nearest("sgm.p1"), "matching.p1");
  EXPECT_EQ(nearest("rectify.window"), "rectification.window");
  EXPECT_EQ(nearest("median.window"), "noise_reduction.window");
  EXPECT_EQ(nearest("core.clock"), "clocks.core_hz");  // none: of all keys
  EXPECT_EQ(nearest("line_rate"), "link.line_rate");
}

TEST(NearestKey, NamesOneWhateverIsWritten) {
  for (const char* path : {"", ".", "matching.", "...", "x.y", "matching.zzzzzzzz"}) {
    EXPECT_NE(nearest(path), "") << path;
  }
  EXPECT_EQ(nearest("matching.zzzzzzzz").rfind("matching.", 0), 0U);
  EXPECT_NE(nearest(std::string(100000, 'x')), "");
  EXPECT_EQ(nearest_key("anything", {}), "");
}

}  // namespace nearest_key_test
}  // namespace parallax
