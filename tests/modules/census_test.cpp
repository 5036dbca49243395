// SPDX-License-Identifier: Apache-2.0
#include "modules/census.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <utility>

#include "tests/modules/images.hpp"
#include "tests/modules/naive_census.hpp"
#include "tests/modules/user_error.hpp"

namespace parallax {
namespace census_test {

using test::complaint;
using test::Grid;

Grid<CensusCode> run(Census& census, const Grid<Gray>& image) {
  return test::collect<CensusCode>(image.width, image.height, 1,
                                   [&](int y, const auto& emit) { census.push(image.row(y), emit); });
}

Grid<CensusCode> run(const CensusConfig& config, const Grid<Gray>& image) {
  Census census(config, image.width, image.height);
  return run(census, image);
}

CensusConfig any_config() {
  CensusConfig config;
  const auto window = *rc::gen::element(std::make_pair(5, 5), std::make_pair(3, 1), std::make_pair(1, 3),
                                        std::make_pair(3, 3), std::make_pair(7, 9), std::make_pair(9, 7),
                                        std::make_pair(63, 1), std::make_pair(1, 63), std::make_pair(21, 3));
  config.window_width = window.first;
  config.window_height = window.second;
  config.bit_order = *rc::gen::element(CensusBitOrder::kMsbFirst, CensusBitOrder::kLsbFirst);
  config.comparison = *rc::gen::element(CensusComparison::kLess, CensusComparison::kLessEqual,
                                        CensusComparison::kGreater, CensusComparison::kGreaterEqual);
  config.enabled = *rc::gen::inRange(0, 8) != 0;
  config.border = *rc::gen::element(CensusBorder::kReplicate, CensusBorder::kZero, CensusBorder::kMask,
                                    CensusBorder::kDelayLine);
  return config;
}

RC_GTEST_PROP(census, equals_its_definition, ()) {
  const CensusConfig config = any_config();
  const int width = *rc::gen::inRange(1, 40);
  const int height = *rc::gen::inRange(1, 20);
  const int top = *rc::gen::element(0, 1, 3, 255);  // flat, nearly flat, noisy
  const auto first = test::random_grid<Gray>(width, height, 1, static_cast<std::uint64_t>(top), 1);
  const auto second = test::random_grid<Gray>(width, height, 1, 255, *rc::gen::arbitrary<std::uint32_t>());
  Census census(config, width, height);
  RC_ASSERT(run(census, first) == test::naive_census(config, first));
  RC_ASSERT(run(census, second) == test::naive_census(config, second));
}

TEST(census, saturated_image) {
  Grid<Gray> image(9, 7);
  for (Gray& v : image.data) v = 255;
  for (const auto border :
       {CensusBorder::kReplicate, CensusBorder::kZero, CensusBorder::kMask, CensusBorder::kDelayLine}) {
    CensusConfig config;
    config.border = border;
    EXPECT_EQ(run(config, image), test::naive_census(config, image));
  }
}

TEST(census, largest_image) {
  const auto image = test::random_grid<Gray>(1856, 1856, 1, 255, 7);
  EXPECT_EQ(run(CensusConfig{}, image), test::naive_census(CensusConfig{}, image));
}

TEST(census, row_is_emitted_as_soon_as_its_window_is_complete) {
  const auto image = test::random_grid<Gray>(8, 6, 1, 255, 3);
  Census census(CensusConfig{}, 8, 6);
  int emitted = 0;
  for (int y = 0; y < 6; ++y) {
    census.push(image.row(y), [&](const CensusCode*) { ++emitted; });
    EXPECT_EQ(emitted, y < 2 ? 0 : y < 5 ? y - 1 : 6) << "after row " << y;
  }
}

TEST(census, taps_of_a_delay_line_lie_in_the_rows_beside) {
  Grid<Gray> image(4, 3);
  for (int i = 0; i < 12; ++i) image.data[i] = static_cast<Gray>(100 + i);
  CensusConfig config;
  config.window_width = 3;
  config.window_height = 1;
  config.comparison = CensusComparison::kGreater;
  config.border = CensusBorder::kDelayLine;
  // Each pixel is above the one before and below the one behind in raster order, and behind the last is 0.
  Grid<CensusCode> codes(4, 3);
  for (CensusCode& code : codes.data) code = 0b01;
  codes.at(3, 2) = 0b00;
  EXPECT_EQ(run(config, image), codes);
}

TEST(census, delay_line_emits_a_row_with_the_pixels_behind_its_window) {
  const auto image = test::random_grid<Gray>(8, 6, 1, 255, 3);
  CensusConfig config;
  config.border = CensusBorder::kDelayLine;
  Census census(config, 8, 6);
  int emitted = 0;
  for (int y = 0; y < 6; ++y) {
    census.push(image.row(y), [&](const CensusCode*) { ++emitted; });
    EXPECT_EQ(emitted, y < 3 ? 0 : y < 5 ? y - 2 : 6) << "after row " << y;
  }
}

TEST(census, declares_what_its_circuit_needs) {
  CensusConfig config;
  config.window_width = 9;
  config.window_height = 7;
  const Census census(config, 640, 480);
  EXPECT_EQ(census.look_ahead_rows(), 3);
  EXPECT_EQ(census.look_ahead_pixels(), 4);
  EXPECT_EQ(census.storage_bits(), 8 * (6 * 640 + 7 * 9));
  EXPECT_EQ(config.code_bits(), 62);
}

TEST(census, off_it_lets_intensities_pass_at_once) {
  CensusConfig config;
  config.enabled = false;
  EXPECT_EQ(config.code_bits(), 8);
  Census census(config, 640, 480);
  EXPECT_EQ(census.look_ahead_rows(), 0);
  EXPECT_EQ(census.look_ahead_pixels(), 0);
  EXPECT_EQ(census.storage_bits(), 0);
  const auto image = test::random_grid<Gray>(8, 6, 1, 255, 3);
  const Grid<CensusCode> out = run(config, image);
  for (int i = 0; i < 48; ++i) EXPECT_EQ(out.data[i], image.data[i]);
}

TEST(census, bad_configuration) {
  CensusConfig config;
  EXPECT_EQ(complaint(config), "");
  config.window_width = 4;
  EXPECT_EQ(complaint(config), "census.window_width = 4: must be odd and within 1..63");
  config = {};
  config.window_height = -1;
  EXPECT_EQ(complaint(config), "census.window_height = -1: must be odd and within 1..63");
  config = {};
  config.window_width = 13;
  EXPECT_EQ(complaint(config),
            "census.window_width x census.window_height = 13 x 5: 64 neighbours, must be 1..63");
  config.window_width = config.window_height = 1;
  EXPECT_EQ(complaint(config),
            "census.window_width x census.window_height = 1 x 1: 0 neighbours, must be 1..63");
  EXPECT_THROW(Census(config, 8, 8), UserError);
}

}  // namespace census_test
}  // namespace parallax
