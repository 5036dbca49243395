// SPDX-License-Identifier: Apache-2.0
#include "modules/consistency.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/modules/images.hpp"
#include "tests/modules/naive_consistency.hpp"
#include "tests/modules/naive_subpixel.hpp"
#include "tests/modules/user_error.hpp"

namespace parallax {
namespace consistency_test {

using test::complaint;
using test::Grid;

Grid<Disparity> run(Consistency& consistency, const Grid<Cost>& costs, const Grid<Disparity>& map) {
  return test::collect<Disparity>(costs.width, costs.height, 1, [&](int y, const auto& emit) {
    consistency.push(costs.row(y), map.row(y), emit);
  });
}

RC_GTEST_PROP(consistency, equals_its_definition, ()) {
  ConsistencyConfig config;
  config.enabled = *rc::gen::inRange(0, 8) != 0;
  config.threshold = *rc::gen::element(0, 1, 2, 15);
  config.right_winner = *rc::gen::element(TieRule::kLowest, TieRule::kHighest);
  config.outside_match = *rc::gen::element(OutsideMatch::kKeep, OutsideMatch::kInvalidate);
  SubpixelConfig subpixel;
  subpixel.winner = *rc::gen::element(TieRule::kLowest, TieRule::kHighest);
  subpixel.border_width = 1;
  const DisparityRange range{*rc::gen::inRange(0, 30), *rc::gen::inRange(1, 60)};
  const int width = *rc::gen::inRange(1, 80);
  const int height = *rc::gen::inRange(1, 5);
  const auto top = *rc::gen::element<std::uint64_t>(0, 2, 30, 2544, 0xFFFF);
  Consistency consistency(config, range, width, height);
  for (int frame = 0; frame < 2; ++frame) {
    auto costs =
        test::random_grid<Cost>(width, height, range.count, top, *rc::gen::arbitrary<std::uint32_t>());
    // A surface that both views see, so that some matches agree.
    const int k = *rc::gen::inRange(0, range.count);
    for (int x = 0; x < width; x += 2) costs.at(x, 0, k) = 0;
    const auto map = test::naive_subpixel(subpixel, range, costs);
    RC_ASSERT(run(consistency, costs, map) == test::naive_consistency(config, range, costs, map));
  }
}

TEST(consistency, saturated_costs) {
  const DisparityRange range{2, 9};
  Grid<Cost> costs(30, 2, range.count);
  for (Cost& cost : costs.data) cost = 0xFFFF;
  Grid<Disparity> map(30, 2);
  for (Disparity& d : map.data) d.value = 5 * 16;
  for (const auto tie : {TieRule::kLowest, TieRule::kHighest}) {
    ConsistencyConfig config;
    config.right_winner = tie;
    Consistency consistency(config, range, 30, 2);
    EXPECT_EQ(run(consistency, costs, map), test::naive_consistency(config, range, costs, map));
  }
}

TEST(consistency, largest_image) {
  const DisparityRange range{0, 8};
  const auto costs = test::random_grid<Cost>(1856, 1856, range.count, 500, 1);
  const auto map = test::naive_subpixel(SubpixelConfig{}, range, costs);
  Consistency consistency(ConsistencyConfig{}, range, 1856, 1856);
  EXPECT_EQ(run(consistency, costs, map), test::naive_consistency(ConsistencyConfig{}, range, costs, map));
}

TEST(consistency, declares_what_its_circuit_needs) {
  ConsistencyConfig config;
  const DisparityRange range{16, 128};
  const Consistency consistency(config, range, 640, 480);
  EXPECT_EQ(consistency.look_ahead_rows(), 0);
  EXPECT_EQ(consistency.look_ahead_pixels(), 127);
  EXPECT_EQ(consistency.storage_bits(), 24 * 128 + 12 * 127);
  config.enabled = false;
  const Consistency off(config, range, 640, 480);
  EXPECT_EQ(off.look_ahead_pixels(), 0);
  EXPECT_EQ(off.storage_bits(), 0);
}

TEST(consistency, bad_configuration) {
  ConsistencyConfig config;
  EXPECT_EQ(complaint(config), "");
  config.threshold = -1;
  EXPECT_EQ(complaint(config), "consistency.threshold = -1: must be within 0..15 px");
  config.threshold = 16;
  EXPECT_EQ(complaint(config), "consistency.threshold = 16: must be within 0..15 px");
}

}  // namespace consistency_test
}  // namespace parallax
