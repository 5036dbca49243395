// SPDX-License-Identifier: Apache-2.0
#include "modules/subpixel.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/modules/images.hpp"
#include "tests/modules/naive_subpixel.hpp"
#include "tests/modules/user_error.hpp"

namespace parallax {
namespace subpixel_test {

using test::complaint;
using test::Grid;

constexpr SubpixelCurve kCurves[] = {SubpixelCurve::kNone, SubpixelCurve::kParabola,
                                     SubpixelCurve::kEquiangular};
constexpr SubpixelRounding kRoundings[] = {SubpixelRounding::kTruncate, SubpixelRounding::kNearest};
constexpr TieRule kTies[] = {TieRule::kLowest, TieRule::kHighest};

Grid<Disparity> run(Subpixel& subpixel, const Grid<Cost>& costs) {
  return test::collect<Disparity>(costs.width, costs.height, 1,
                                  [&](int y, const auto& emit) { subpixel.push(costs.row(y), emit); });
}

RC_GTEST_PROP(subpixel, equals_its_definition, ()) {
  SubpixelConfig config;
  config.curve = *rc::gen::elementOf(std::vector<SubpixelCurve>(std::begin(kCurves), std::end(kCurves)));
  config.rounding =
      *rc::gen::elementOf(std::vector<SubpixelRounding>(std::begin(kRoundings), std::end(kRoundings)));
  config.winner = *rc::gen::elementOf(std::vector<TieRule>(std::begin(kTies), std::end(kTies)));
  config.mask_border = *rc::gen::arbitrary<bool>();
  config.border_width = *rc::gen::inRange(0, 5);
  config.border_height = *rc::gen::inRange(0, 5);
  const DisparityRange range{*rc::gen::inRange(0, 100), *rc::gen::inRange(1, 100)};
  const int width = *rc::gen::inRange(1, 20);
  const int height = *rc::gen::inRange(1, 10);
  const auto top = *rc::gen::element<std::uint64_t>(0, 2, 30, 2544, 0xFFFF);  // flat to saturated
  Subpixel subpixel(config, range, width, height);
  for (int frame = 0; frame < 2; ++frame) {
    const auto costs =
        test::random_grid<Cost>(width, height, range.count, top, *rc::gen::arbitrary<std::uint32_t>());
    RC_ASSERT(run(subpixel, costs) == test::naive_subpixel(config, range, costs));
  }
}

TEST(subpixel, largest_image) {
  const DisparityRange range{0, 8};
  const auto costs = test::random_grid<Cost>(1856, 1856, range.count, 500, 1);
  Subpixel subpixel(SubpixelConfig{}, range, 1856, 1856);
  EXPECT_EQ(run(subpixel, costs), test::naive_subpixel(SubpixelConfig{}, range, costs));
}

/// All shapes of a minimum with costs up to 24: the promise of winner.hpp.
TEST(subpixel, integer_disparity_recovers_the_winner) {
  const DisparityRange range{7, 3};
  for (const auto curve : kCurves) {
    for (const auto rounding : kRoundings) {
      for (const auto winner : kTies) {
        SubpixelConfig config;
        config.curve = curve;
        config.rounding = rounding;
        config.winner = winner;
        config.mask_border = false;
        Subpixel subpixel(config, range, 1, 1);
        for (int a = 0; a < 25; ++a) {
          for (int c = 0; c < 25; ++c) {
            for (int b = 0; b < 25; ++b) {
              const Cost costs[] = {static_cast<Cost>(a), static_cast<Cost>(c), static_cast<Cost>(b)};
              Grid<Cost> grid(1, 1, 3);
              grid.data.assign(std::begin(costs), std::end(costs));
              int expected = range.offset + test::naive_winner(grid, 0, 0, winner);
              const bool below_ties = winner == TieRule::kHighest && a == c && expected == range.offset + 1;
              if (below_ties && b > c && curve != SubpixelCurve::kNone) --expected;
              subpixel.push(costs, [&](const Disparity* d) {
                ASSERT_EQ(integer_disparity(*d), expected) << a << ' ' << c << ' ' << b;
                ASSERT_EQ(costs[integer_disparity(*d) - range.offset], lowest_cost(costs, 3));
              });
            }
          }
        }
      }
    }
  }
}

Disparity refine(SubpixelCurve curve, SubpixelRounding rounding, Cost a, Cost c, Cost b) {
  SubpixelConfig config;
  config.curve = curve;
  config.rounding = rounding;
  config.mask_border = false;
  Subpixel subpixel(config, {10, 3}, 1, 1);
  const Cost costs[] = {a, c, b};
  Disparity result;
  subpixel.push(costs, [&](const Disparity* d) { result = *d; });
  return result;
}

TEST(subpixel, fractions_by_hand) {
  const auto truncate = SubpixelRounding::kTruncate;
  const auto nearest = SubpixelRounding::kNearest;
  const auto parabola = SubpixelCurve::kParabola;
  const auto equiangular = SubpixelCurve::kEquiangular;
  EXPECT_EQ(refine(SubpixelCurve::kNone, truncate, 20, 2, 8).value, 11 * 16);
  EXPECT_EQ(refine(parabola, truncate, 20, 2, 8).value, 11 * 16 + 4);     // 96 / 24
  EXPECT_EQ(refine(parabola, truncate, 8, 2, 21).value, 11 * 16 - 4);     // -104 / 25 = -4.16
  EXPECT_EQ(refine(parabola, nearest, 8, 2, 24).value, 11 * 16 - 5);      // -128 / 28 = -4.57
  EXPECT_EQ(refine(equiangular, truncate, 20, 2, 8).value, 11 * 16 + 5);  // 96 / 18 = 5.33
  EXPECT_EQ(refine(equiangular, nearest, 20, 2, 7).value, 11 * 16 + 6);   // 104 / 18 = 5.78
  EXPECT_EQ(refine(parabola, truncate, 9, 2, 2).value, 11 * 16 + 8);      // ties with the one above
  EXPECT_EQ(refine(parabola, nearest, 100, 1, 2).value, 11 * 16 + 7);     // 784 / 100 = 7.84 does not tie
  EXPECT_EQ(refine(parabola, truncate, 5, 5, 5).value, 10 * 16);
}

TEST(subpixel, declares_what_its_circuit_needs) {
  const Subpixel subpixel(SubpixelConfig{}, DisparityRange{}, 640, 480);
  EXPECT_EQ(subpixel.look_ahead_rows(), 0);
  EXPECT_EQ(subpixel.look_ahead_pixels(), 0);
  EXPECT_EQ(subpixel.storage_bits(), 72);
}

TEST(subpixel, bad_configuration) {
  SubpixelConfig config;
  EXPECT_EQ(complaint(config), "");
  config.border_width = -1;
  EXPECT_EQ(complaint(config), "subpixel.border_width = -1: must be within 0..31");
  config = {};
  config.border_height = 32;
  EXPECT_EQ(complaint(config), "subpixel.border_height = 32: must be within 0..31");
}

}  // namespace subpixel_test
}  // namespace parallax
