// SPDX-License-Identifier: Apache-2.0
#include "modules/uniqueness.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/modules/images.hpp"
#include "tests/modules/naive_subpixel.hpp"
#include "tests/modules/naive_uniqueness.hpp"
#include "tests/modules/user_error.hpp"

namespace parallax {
namespace uniqueness_test {

using test::complaint;
using test::Grid;

Grid<Disparity> run(Uniqueness& uniqueness, const Grid<Cost>& costs, const Grid<Disparity>& map) {
  return test::collect<Disparity>(costs.width, costs.height, 1, [&](int y, const auto& emit) {
    uniqueness.push(costs.row(y), map.row(y), emit);
  });
}

RC_GTEST_PROP(uniqueness, equals_its_definition, ()) {
  UniquenessConfig config;
  config.enabled = *rc::gen::inRange(0, 8) != 0;
  config.factor = *rc::gen::element(256, 257, 300, 512, 4096);
  config.neighbours_are_rivals = *rc::gen::arbitrary<bool>();
  SubpixelConfig subpixel;
  subpixel.winner = *rc::gen::element(TieRule::kLowest, TieRule::kHighest);
  subpixel.border_width = 1;
  const DisparityRange range{*rc::gen::inRange(0, 100), *rc::gen::inRange(1, 100)};
  const int width = *rc::gen::inRange(1, 20);
  const int height = *rc::gen::inRange(1, 10);
  const auto top = *rc::gen::element<std::uint64_t>(0, 2, 30, 2544, 0xFFFF);
  Uniqueness uniqueness(config, range, width, height);
  for (int frame = 0; frame < 2; ++frame) {
    auto costs =
        test::random_grid<Cost>(width, height, range.count, top, *rc::gen::arbitrary<std::uint32_t>());
    for (std::size_t i = 0; i < costs.data.size(); i += 7)
      costs.data[i] = static_cast<Cost>(costs.data[i] / 8);
    const auto map = test::naive_subpixel(subpixel, range, costs);
    RC_ASSERT(run(uniqueness, costs, map) == test::naive_uniqueness(config, range, costs, map));
  }
}

TEST(uniqueness, largest_image) {
  const DisparityRange range{0, 8};
  const auto costs = test::random_grid<Cost>(1856, 1856, range.count, 500, 1);
  const auto map = test::naive_subpixel(SubpixelConfig{}, range, costs);
  Uniqueness uniqueness(UniquenessConfig{}, range, 1856, 1856);
  EXPECT_EQ(run(uniqueness, costs, map), test::naive_uniqueness(UniquenessConfig{}, range, costs, map));
}

Disparity judge(const UniquenessConfig& config, std::vector<Cost> costs, int winner) {
  Uniqueness uniqueness(config, {0, static_cast<int>(costs.size())}, 1, 1);
  const Disparity d{static_cast<std::uint16_t>(winner * 16), Cause::kMatched};
  Disparity result;
  uniqueness.push(costs.data(), &d, [&](const Disparity* out) { result = *out; });
  return result;
}

TEST(uniqueness, neighbours_of_the_minimum) {
  UniquenessConfig config;
  config.factor = 512;
  const Disparity invalid{kInvalidDisparity, Cause::kUniqueness};
  EXPECT_TRUE(judge(config, {30, 11, 10, 11, 30}, 2).valid());
  EXPECT_TRUE(judge(config, {21, 11, 10, 11, 21}, 2).valid());
  EXPECT_EQ(judge(config, {20, 11, 10, 11, 30}, 2), invalid);  // 10 * 2 < 20 does not hold
  config.neighbours_are_rivals = true;
  EXPECT_EQ(judge(config, {30, 11, 10, 11, 30}, 2), invalid);
  EXPECT_TRUE(judge(config, {30, 21, 10, 21, 30}, 2).valid());
}

TEST(uniqueness, without_a_rival_a_match_is_unique) {
  EXPECT_TRUE(judge(UniquenessConfig{}, {5}, 0).valid());
  EXPECT_TRUE(judge(UniquenessConfig{}, {5, 4, 5}, 1).valid());
}

TEST(uniqueness, declares_what_its_circuit_needs) {
  UniquenessConfig config;
  EXPECT_EQ(Uniqueness(config, DisparityRange{}, 640, 480).storage_bits(), 4 * 24);
  config.neighbours_are_rivals = true;
  const Uniqueness uniqueness(config, DisparityRange{}, 640, 480);
  EXPECT_EQ(uniqueness.storage_bits(), 2 * 24);
  EXPECT_EQ(uniqueness.look_ahead_rows(), 0);
  EXPECT_EQ(uniqueness.look_ahead_pixels(), 0);
}

TEST(uniqueness, bad_configuration) {
  UniquenessConfig config;
  EXPECT_EQ(complaint(config), "");
  config.factor = 255;
  EXPECT_EQ(complaint(config), "uniqueness.factor = 255: must be within 256..4096 (1/256 steps, 1 to 16)");
  config.factor = 4097;
  EXPECT_EQ(complaint(config), "uniqueness.factor = 4097: must be within 256..4096 (1/256 steps, 1 to 16)");
}

}  // namespace uniqueness_test
}  // namespace parallax
