// SPDX-License-Identifier: Apache-2.0
// What is taken inside the matcher, against its definition on whole images, in the order in which it comes.
#include "modules/matching_taps.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "modules/token_formats.hpp"
#include "tests/modules/any_matching.hpp"
#include "tests/modules/naive_matching.hpp"

namespace parallax {
namespace matching_taps_test {

using test::Grid;

// Pixels of an image in the order of a scan, one frame after the other.
void append_scanned(const Grid<int>& grid, ScanOrder order, std::vector<int>& all) {
  for (int i = 0; i < grid.height; ++i) {
    for (int j = 0; j < grid.width; ++j) {
      const int y = order == ScanOrder::kTurned ? grid.height - 1 - i : i;
      const int x = order == ScanOrder::kRaster ? j : grid.width - 1 - j;
      for (int k = 0; k < grid.depth; ++k) all.push_back(grid.at(x, y, k));
    }
  }
}

ScanOrder order_of(const test::NaivePath& path) {
  if (path.dy > 0) return ScanOrder::kTurned;
  return path.dy == 0 && path.dx > 0 ? ScanOrder::kRightToLeft : ScanOrder::kRaster;
}

struct Taken {
  std::vector<int> pixel_costs;
  std::array<std::vector<int>, kMostPaths> paths;

  bool operator==(const Taken& other) const {
    return pixel_costs == other.pixel_costs && paths == other.paths;
  }
};

// Of frames of random codes, by the kernel; `wanted`: bit i is path i, bit 8 the matching costs.
struct Frames {
  MatchingConfig config;
  int width, height, code_bits;
  std::uint32_t seed;
  int number = 2;

  Grid<CensusCode> codes(int frame, int side) const {
    return test::random_grid<CensusCode>(width, height, 1, (CensusCode{1} << code_bits) - 1,
                                         seed + static_cast<std::uint32_t>(2 * frame + side));
  }
  Taken taken(unsigned wanted, std::vector<Cost>& sums) const {
    Taken out;
    MatchingTaps taps;
    const auto row = static_cast<std::ptrdiff_t>(width) * config.range().count;
    const auto into = [row](std::vector<int>& all) {
      return [&all, row](const Cost* values) { all.insert(all.end(), values, values + row); };
    };
    if ((wanted & 1U << kMostPaths) != 0) taps.pixel_costs = into(out.pixel_costs);
    for (std::size_t i = 0; i < out.paths.size(); ++i) {
      if ((wanted >> i & 1U) != 0) taps.paths[i] = into(out.paths[i]);
    }
    Matching matching(config, width, height, code_bits);
    matching.open(taps);
    for (int frame = 0; frame < number; ++frame) {
      const auto left = codes(frame, 0), right = codes(frame, 1);
      for (int y = 0; y < height; ++y) {
        matching.push(left.row(y), right.row(y),
                      [&](const Cost* values) { sums.insert(sums.end(), values, values + row); });
      }
    }
    return out;
  }
  Taken defined(unsigned wanted, std::vector<Cost>& sums) const {
    Taken out;
    for (int frame = 0; frame < number; ++frame) {
      const auto left = codes(frame, 0), right = codes(frame, 1);
      const Grid<int> costs = test::naive_costs(config, code_bits, left, right);
      if ((wanted & 1U << kMostPaths) != 0) append_scanned(costs, ScanOrder::kRaster, out.pixel_costs);
      for (std::size_t i = 0; i < out.paths.size(); ++i) {
        const test::NaivePath& path = test::kNaivePaths[i];
        if ((wanted >> i & 1U) == 0 || (config.paths & path.bit) == 0) continue;
        append_scanned(test::naive_path_costs(config, path, costs), order_of(path), out.paths[i]);
      }
      const Grid<Cost> whole = test::naive_matching(config, code_bits, left, right);
      sums.insert(sums.end(), whole.data.begin(), whole.data.end());
    }
    return out;
  }
};

constexpr unsigned kAll = (2U << kMostPaths) - 1;

RC_GTEST_PROP(MatchingTaps, equal_their_definition, ()) {
  Frames frames{test::any_matching_config(), 0, 0, 0, 0};
  const bool grey = frames.config.cost == MatchingCost::kAbsoluteDifference;
  frames.code_bits = grey ? 8 : *rc::gen::element(1, 9, 24, 63);
  frames.width = *rc::gen::inRange(1, 30);
  frames.height = *rc::gen::inRange(1, 8);
  frames.seed = *rc::gen::arbitrary<std::uint32_t>();
  const unsigned wanted = *rc::gen::element(kAll, 1U << kMostPaths, *rc::gen::inRange(0U, kAll + 1));
  std::vector<Cost> sums, defined_sums;
  RC_ASSERT(frames.taken(wanted, sums) == frames.defined(wanted, defined_sums));
  RC_ASSERT(sums == defined_sums);
}

TEST(MatchingTaps, OfFourAndEightPathsAtTheSizesOfTheCircuit) {
  for (const unsigned paths : {kFourPaths, kEightPaths}) {
    for (const int iterations : {1, 3}) {
      Frames frames{{}, 33, 9, 24, 5};
      frames.config.parallelism = 8;
      frames.config.iterations = iterations;
      frames.config.paths = paths;
      std::vector<Cost> sums, defined_sums;
      const Taken taken = frames.taken(kAll, sums);
      EXPECT_TRUE(taken == frames.defined(kAll, defined_sums));
      EXPECT_EQ(sums, defined_sums);
      for (const auto& path : taken.paths)
        EXPECT_EQ(path.empty(), paths == kFourPaths && &path - taken.paths.data() >= 4);
    }
  }
}

TEST(MatchingTaps, AreAsWideAsTheRegistersOfTheCircuit) {
  MatchingConfig config;
  EXPECT_EQ(pixel_cost_bits(config, 24), 5);
  EXPECT_EQ(path_cost_bits(config, 24), 9);  // 24 + 255
  config.path_bits = 6;
  EXPECT_EQ(path_cost_bits(config, 24), 6);
  config.path_bits = 12;  // more than are needed
  EXPECT_EQ(path_cost_bits(config, 24), 12);
  config.cost_weight = 4;
  EXPECT_EQ(pixel_cost_bits(config, 24), 7);
}

TEST(MatchingTaps, AreOpenedBeforeTheFirstRow) {
  const MatchingTaps taps;
  EXPECT_FALSE(taps.any());
  const Grid<CensusCode> flat(8, 2);
  Matching matching({}, 8, 2, 24);
  matching.open(taps);
  matching.push(flat.row(0), flat.row(0), [](const Cost*) {});
  EXPECT_THROW(matching.open(taps), std::logic_error);
}

}  // namespace matching_taps_test
}  // namespace parallax
