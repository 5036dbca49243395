// SPDX-License-Identifier: Apache-2.0
// What a machine makes of a wide image is, bit for bit, what machines of one tile make of its tiles.
#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <sstream>
#include <vector>

#include "tests/timing/in_child.hpp"
#include "tests/timing/machine_bench.hpp"

namespace parallax::test {
namespace machine_tiles_test {

constexpr int kWidth = 150;
constexpr int kHeight = 40;
constexpr int kFrames = 2;

std::vector<Gray> image(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<Gray> pixels(static_cast<std::size_t>(kWidth * kHeight));
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    pixels[i] = static_cast<Gray>((i % kWidth / 5 * 37 + i / kWidth / 3 * 91) % 200 + random() % 20);
  }
  return pixels;
}

std::vector<Gray> columns(const std::vector<Gray>& whole, int begin, int width) {
  std::vector<Gray> part;
  for (int y = 0; y < kHeight; ++y) {
    const auto row = whole.begin() + y * kWidth + begin;
    part.insert(part.end(), row, row + width);
  }
  return part;
}

struct Result {
  Gray left;
  Disparity disparity;
};

// Columns begin to begin + width of all frames, as text for those from keep_begin to keep_end (of the image).
std::vector<std::string> results(const MachineConfig& config, const RectificationMap& whole_map, int begin,
                                 int width, int keep_begin, int keep_end) {
  const std::string text = in_child([&] {
    RectificationMap part = identity_map(width, kHeight, whole_map.range);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < width; ++x) {
        part.offsets[static_cast<std::size_t>(y * width + x)] =
            whole_map.offsets[static_cast<std::size_t>(y * kWidth + begin + x)];
      }
    }
    const EncodedMap map = encode(part);
    std::ostringstream out;
    MachineInput input;
    input.width = width;
    input.height = kHeight;
    input.map = &map;
    input.frames = kFrames;
    input.expose = [&](std::int64_t frame) {
      const auto seed = static_cast<std::uint32_t>(frame);
      const auto sensor = [&](std::uint32_t s) {
        return std::make_shared<const std::vector<Gray>>(columns(image(s), begin, width));
      };
      return StereoFrame{sensor(seed), sensor(seed + 1)};
    };
    input.deliver = [&](const FrameResult& result) {
      for (int y = 0; y < kHeight; ++y) {
        for (int x = keep_begin - begin; x < keep_end - begin; ++x) {
          const auto i = static_cast<std::size_t>(y * width + x);
          out << int{result.left[i]} << " " << result.disparities[i].value << "/"
              << static_cast<int>(result.disparities[i].cause) << " ";
        }
        out << "\n";
      }
    };
    const Machine machine("machine", config, input);
    sc_core::sc_start();
    if (!machine.finished()) return "stuck:\n" + describe(machine.dataflow().waits());
    return out.str();
  });
  std::vector<std::string> rows;
  std::istringstream lines(text);
  for (std::string row; std::getline(lines, row);) rows.push_back(row);
  return rows;
}

void compare(const std::vector<std::string>& assignments, std::size_t tiles) {
  std::vector<std::string> all{"rectification.window=9", "matching.parallelism=8", "matching.iterations=2",
                               "tiles.left_margin=10", "tiles.right_margin=6"};
  all.insert(all.end(), assignments.begin(), assignments.end());
  const MachineConfig config = preset(all);
  const TilePlan plan = plan_tiles(config.tiles, config.matching.range(), kWidth);
  ASSERT_EQ(plan.tiles.size(), tiles);
  const RectificationMap map = lens_map(kWidth, kHeight, config.rectification.range);
  const std::vector<std::string> whole = results(config, map, 0, kWidth, 0, kWidth);
  ASSERT_EQ(whole.size(), static_cast<std::size_t>(kFrames * kHeight)) << (whole.empty() ? "" : whole[0]);
  std::vector<std::string> joined(whole.size());
  for (const Tile& tile : plan.tiles) {
    const std::vector<std::string> part =
        results(config, map, tile.begin, plan.width, tile.keep_begin, tile.keep_end);
    ASSERT_EQ(part.size(), whole.size());
    for (std::size_t i = 0; i < joined.size(); ++i) joined[i] += part[i];
  }
  EXPECT_EQ(whole, joined);
}

TEST(MachineTiles, AreImagesOfTheirOwn) { compare({"tiles.limit=100"}, 2); }
TEST(MachineTiles, AnyNumberOfThem) { compare({"tiles.limit=66", "tiles.largest_number=4"}, 4); }
TEST(MachineTiles, WithOddBurstsAndEightPaths) {
  compare({"tiles.limit=92", "dma.left.burst_bytes=24", "dma.output.burst_bytes=40",
           "matching.paths=w, nw, n, ne, e, se, s, sw"},
          2);
}

}  // namespace machine_tiles_test
}  // namespace parallax::test
