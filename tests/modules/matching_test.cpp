// SPDX-License-Identifier: Apache-2.0
#include "modules/matching.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/modules/any_matching.hpp"
#include "tests/modules/images.hpp"
#include "tests/modules/naive_matching.hpp"
#include "tests/modules/user_error.hpp"

namespace parallax {
namespace matching_test {

using test::complaint;
using test::Grid;

Grid<Cost> run(Matching& matching, DisparityRange range, const Grid<CensusCode>& left,
               const Grid<CensusCode>& right) {
  return test::collect<Cost>(left.width, left.height, range.count, [&](int y, const auto& emit) {
    matching.push(left.row(y), right.row(y), emit);
  });
}

Grid<Cost> run(const MatchingConfig& config, int code_bits, const Grid<CensusCode>& left,
               const Grid<CensusCode>& right) {
  Matching matching(config, left.width, left.height, code_bits);
  return run(matching, config.range(), left, right);
}

Grid<CensusCode> random_codes(int width, int height, int code_bits, std::uint32_t seed) {
  return test::random_grid<CensusCode>(width, height, 1, (CensusCode{1} << code_bits) - 1, seed);
}

RC_GTEST_PROP(matching, equals_its_definition, ()) {
  const MatchingConfig config = test::any_matching_config();
  const bool grey = config.cost == MatchingCost::kAbsoluteDifference;
  const int code_bits = grey ? 8 : *rc::gen::element(1, 8, 9, 24, 48, 63);
  const int width = *rc::gen::inRange(1, 40);
  const int height = *rc::gen::inRange(1, 8);
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  Matching matching(config, width, height, code_bits);
  for (std::uint32_t frame = 0; frame < 2; ++frame) {
    const auto left = random_codes(width, height, code_bits, seed + 2 * frame);
    const auto right = random_codes(width, height, code_bits, seed + 2 * frame + 1);
    RC_ASSERT(run(matching, config.range(), left, right) ==
              test::naive_matching(config, code_bits, left, right));
  }
}

TEST(matching, flat_image) {
  const Grid<CensusCode> flat(50, 6);
  const MatchingConfig config;
  EXPECT_EQ(run(config, 24, flat, flat), test::naive_matching(config, 24, flat, flat));
}

TEST(matching, largest_costs_do_not_overflow) {
  Grid<CensusCode> left(40, 6);
  for (CensusCode& code : left.data) code = (CensusCode{1} << 63) - 1;
  auto right = random_codes(40, 6, 63, 11);
  MatchingConfig config;
  config.cost_weight = 4;
  config.p1 = 254;
  config.p2 = 255;
  config.paths = kEightPaths;
  EXPECT_EQ(run(config, 63, left, right), test::naive_matching(config, 63, left, right));
}

TEST(matching, largest_differences_of_grey_values_do_not_overflow) {
  Grid<CensusCode> left(40, 6);
  for (CensusCode& grey : left.data) grey = 255;
  auto right = random_codes(40, 6, 8, 11);
  for (int x = 0; x < 40; ++x) right.at(x, 2) = 0;
  MatchingConfig config;
  config.cost = MatchingCost::kAbsoluteDifference;
  config.p1 = 254;
  config.p2 = 255;
  config.paths = kEightPaths;
  EXPECT_EQ(run(config, 8, left, right), test::naive_matching(config, 8, left, right));
}

TEST(matching, a_delay_line_of_right_pixels_reaches_over_rows) {
  // Of rows shorter than the range, several lie in it; the right images differ in what is before the row.
  for (const unsigned paths : {kFourPaths, kEightPaths}) {
    for (const int width : {1, 5, 40}) {
      MatchingConfig config;
      config.parallelism = 16;
      config.iterations = 2;
      config.disparity_offset = 3;
      config.paths = paths;
      config.outside_cost = OutsideCost::kDelayLine;
      const auto left = random_codes(width, 30, 24, 5);
      const auto right = random_codes(width, 30, 24, 6);
      EXPECT_EQ(run(config, 24, left, right), test::naive_matching(config, 24, left, right));
    }
  }
}

TEST(matching, all_paths_start_in_the_first_column) {
  const auto left = random_codes(7, 5, 24, 8);
  const auto right = random_codes(7, 5, 24, 9);
  MatchingConfig config;
  config.parallelism = 4;
  config.iterations = 1;
  config.path_start = PathStart::kFirstColumn;
  const Grid<Cost> all = run(config, 24, left, right);
  config.path_start = PathStart::kDelayLine;
  const Grid<Cost> delayed = run(config, 24, left, right);
  const Grid<int> costs = test::naive_costs(config, 24, left, right);
  bool later_differ = false;
  for (int y = 0; y < 5; ++y) {
    for (int k = 0; k < 4; ++k) {
      EXPECT_EQ(all.at(0, y, k), 4 * costs.at(0, y, k)) << y;
      for (int x = 1; x < 7; ++x) later_differ = later_differ || all.at(x, y, k) != delayed.at(x, y, k);
    }
  }
  EXPECT_TRUE(later_differ);
}

TEST(matching, a_cost_outside_widens_path_costs) {
  MatchingConfig config;
  config.outside_value = 255;
  EXPECT_EQ(config.largest_cost(24), 24);
  config.outside_cost = OutsideCost::kValue;
  EXPECT_EQ(config.largest_cost(24), 255);
  EXPECT_EQ(summed_cost_bits(config, 24), 11);  // 4 * (255 + 255)
  config.outside_value = 2;
  EXPECT_EQ(config.largest_cost(24), 24);
}

TEST(matching, widths_follow_the_registers_of_the_circuit) {
  MatchingConfig config;
  config.path_bits = 6;
  config.paths = kFourPaths | kPathE;
  {
    const Matching matching(config, 640, 480, 24);
    EXPECT_EQ(summed_cost_bits(config, 24), 9);  // 5 * 63
    EXPECT_EQ(matching.storage_bits(), 6 * 129 * (3 * 640 + 2) + 24 * 127 + 640 * 128 * (5 + 9));
  }
  config.sum_shift = 2;
  EXPECT_EQ(summed_cost_bits(config, 24), 7);  // 315 / 4 = 78
  EXPECT_EQ(Matching(config, 640, 480, 24).storage_bits(),
            6 * 129 * (3 * 640 + 2) + 24 * 127 + 640 * 128 * (5 + 9));  // sums are shifted when complete
  config.path_bits = 12;                                                // more than are needed
  EXPECT_EQ(summed_cost_bits(config, 24), 9);                           // 5 * 279 / 4
  config.paths = kEightPaths;
  config.path_bits = 8;
  EXPECT_EQ(Matching(config, 64, 48, 24).store().frame, 128 * 11 + 2 * 24);  // 5 * 255
}

TEST(matching, full_range_of_256) {
  MatchingConfig config;
  config.iterations = 8;
  const auto left = random_codes(300, 5, 24, 1);
  const auto right = random_codes(300, 5, 24, 2);
  EXPECT_EQ(run(config, 24, left, right), test::naive_matching(config, 24, left, right));
}

TEST(matching, widest_rows) {
  MatchingConfig config;
  config.iterations = 2;
  const auto left = random_codes(1856, 12, 24, 1);
  const auto right = random_codes(1856, 12, 24, 2);
  EXPECT_EQ(run(config, 24, left, right), test::naive_matching(config, 24, left, right));
}

TEST(matching, largest_image) {
  MatchingConfig config;
  config.parallelism = 4;
  config.iterations = 1;
  const auto left = random_codes(1856, 1856, 24, 1);
  const auto right = random_codes(1856, 1856, 24, 2);
  EXPECT_EQ(run(config, 24, left, right), test::naive_matching(config, 24, left, right));
}

TEST(matching, emits_each_row_at_once_unless_a_second_pass_is_needed) {
  const auto codes = random_codes(8, 4, 24, 3);
  for (const unsigned paths : {kFourPaths, kFourPaths | kPathE, kEightPaths, unsigned{kPathS}}) {
    MatchingConfig config;
    config.paths = paths;
    const bool two_passes = (paths & kSouthernPaths) != 0;
    Matching matching(config, 8, 4, 24);
    int emitted = 0;
    for (int y = 0; y < 4; ++y) {
      matching.push(codes.row(y), codes.row(y), [&](const Cost*) { ++emitted; });
      EXPECT_EQ(emitted, two_passes ? (y == 3 ? 4 : 0) : y + 1);
    }
    EXPECT_EQ(matching.look_ahead_rows(), two_passes ? 3 : 0);
    EXPECT_EQ(matching.look_ahead_pixels(), paths == kFourPaths ? 0 : (paths & kSouthernPaths) != 0 ? 8 : 7);
  }
}

TEST(matching, declares_what_its_circuit_needs) {
  MatchingConfig config;
  {
    const Matching matching(config, 640, 480, 24);
    // 24 + 255 needs 9 bits; 128 costs and a minimum for three paths of a row and for one pixel.
    EXPECT_EQ(matching.storage_bits(), 9 * 129 * (3 * 640 + 1) + 24 * 127);
    EXPECT_EQ(matching.store().frame, 0);
    EXPECT_EQ(matching.store().first_pass_row, 0);
    EXPECT_EQ(summed_cost_bits(config, 24), 11);  // 4 * 279, whatever p2 is set to
  }
  config.cost_weight = 4;
  {
    const Matching matching(config, 640, 480, 63);
    EXPECT_EQ(matching.storage_bits(), 9 * 129 * (3 * 640 + 1) + 63 * 127);  // 4 * 63 + 255 needs 9 bits
    EXPECT_EQ(summed_cost_bits(config, 63), 11);                             // 4 * 507
  }
  config.cost = MatchingCost::kAbsoluteDifference;
  {
    const Matching matching(config, 640, 480, 8);
    EXPECT_EQ(matching.storage_bits(), 9 * 129 * (3 * 640 + 1) + 8 * 127);  // 255 + 255, without the weight
    EXPECT_EQ(summed_cost_bits(config, 8), 11);                             // 4 * 510
  }
  config.cost = MatchingCost::kHamming;
  config.cost_weight = 1;
  config.paths = kEightPaths;
  {
    const Matching matching(config, 64, 48, 24);
    // The first pass sums five paths of at most 279: 11 bits.
    EXPECT_EQ(matching.store().frame, 128 * 11 + 2 * 24);
    EXPECT_EQ(matching.store().second_pass_row, 0);
  }
  config.path_storage = PathStorage::kMemory;
  const Matching matching(config, 64, 48, 24);
  EXPECT_EQ(matching.store().first_pass_row, 3 * 9 * 129);
  EXPECT_EQ(matching.store().second_pass_row, 3 * 9 * 129);
  EXPECT_EQ(matching.store().frame, 128 * 11 + 2 * 24);
  // Of rows, two pixels of one path and one of another stay, and both horizontal paths; as before: right
  // codes, and for path E a row of costs (5 bits) and of sums (8 * 279: 12 bits).
  EXPECT_EQ(matching.storage_bits(), 9 * 129 * (3 + 2) + 24 * 127 + 64 * 128 * (5 + 12));
}

TEST(matching, bad_configuration) {
  const auto complain = [](auto change) {
    MatchingConfig config;
    change(config);
    return complaint(config);
  };
  EXPECT_EQ(complaint(MatchingConfig{}), "");
  EXPECT_EQ(complain([](auto& c) { c.parallelism = 0; }), "matching.parallelism = 0: must be within 1..256");
  EXPECT_EQ(complain([](auto& c) { c.iterations = 257; }),
            "matching.iterations = 257: must be within 1..256");
  EXPECT_EQ(complain([](auto& c) { c.disparity_offset = -1; }),
            "matching.disparity_offset = -1: must be within 0..255");
  EXPECT_EQ(complain([](auto& c) { c.disparity_offset = 129; }),
            "matching.disparity_offset + matching.iterations x matching.parallelism = 129 + 4 x 32 = 257: "
            "must be at most 256");
  EXPECT_EQ(complain([](auto& c) { c.cost_weight = 0; }), "matching.cost_weight = 0: must be within 1..4");
  EXPECT_EQ(complain([](auto& c) { c.cost_weight = 5; }), "matching.cost_weight = 5: must be within 1..4");
  EXPECT_EQ(complain([](auto& c) { c.outside_value = -1; }),
            "matching.outside_value = -1: must be within 0..255");
  EXPECT_EQ(complain([](auto& c) { c.outside_value = 256; }),
            "matching.outside_value = 256: must be within 0..255");
  EXPECT_EQ(complain([](auto& c) { c.outside_value = 0; }),
            "matching.outside_value = 0: has no effect without matching.outside_cost = \"value\"");
  EXPECT_EQ(complain([](auto& c) { c.path_bits = 17; }), "matching.path_bits = 17: must be within 0..16");
  EXPECT_EQ(
      complain([](auto& c) { c.path_overflow = PathOverflow::kWrap; }),
      "matching.path_overflow = \"wrap\": has no effect with matching.path_bits = 0, as many as needed");
  EXPECT_EQ(complain([](auto& c) { c.sum_shift = 12; }), "matching.sum_shift = 12: must be within 0..11");
  EXPECT_EQ(complain([](auto& c) { c.p1 = -1; }), "matching.p1 = -1: must be within 0..255");
  EXPECT_EQ(complain([](auto& c) { c.p2 = 256; }), "matching.p2 = 256: must be within 0..255");
  EXPECT_EQ(complain([](auto& c) { c.p1 = 42; }), "matching.p1 = 42: must be below matching.p2 = 42");
  EXPECT_EQ(complain([](auto& c) { c.paths = 0; }),
            "matching.paths = 0x0: must name one to eight of w, nw, n, ne, e, sw, s, se");
  EXPECT_EQ(complain([](auto& c) { c.paths = 0x100; }),
            "matching.paths = 0x100: must name one to eight of w, nw, n, ne, e, sw, s, se");
}

TEST(matching, the_cost_is_one_of_what_comes_in) {
  const auto complain = [](MatchingCost cost, bool census) {
    MatchingConfig config;
    config.cost = cost;
    return test::complaint_of([&] { config.validate_census(census); });
  };
  EXPECT_EQ(complain(MatchingCost::kHamming, true), "");
  EXPECT_EQ(complain(MatchingCost::kAbsoluteDifference, false), "");
  EXPECT_EQ(complain(MatchingCost::kHamming, false),
            "matching.cost = \"hamming\": needs census.enabled = true; grey values have "
            "\"absolute_difference\"");
  EXPECT_EQ(complain(MatchingCost::kAbsoluteDifference, true),
            "matching.cost = \"absolute_difference\": needs census.enabled = false, it is of grey values");
  MatchingConfig config;
  config.cost = MatchingCost::kAbsoluteDifference;
  EXPECT_THROW(Matching(config, 8, 8, 24), std::logic_error);
}

}  // namespace matching_test
}  // namespace parallax
