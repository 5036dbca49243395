// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/tile_plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tlm/error.hpp"

namespace parallax {
namespace {

struct Margins {
  int left;
  int right;
  int both() const { return left + right; }
};

int round_up_to_even(int value) { return (value + 1) / 2 * 2; }

Margins margins(const TileConfig& config, const DisparityRange& range) {
  const int disparities = config.disparities_in_margin ? range.offset + range.count : 0;
  return {round_up_to_even(static_cast<int>(config.left_margin) + disparities),
          static_cast<int>(config.right_margin)};
}

// Columns that so many tiles of the full width contribute.
int columns(int tiles, const TileConfig& config, const Margins& margins) {
  const int limit = config.limit;
  return tiles * limit - (tiles - 1) * margins.both();
}

}  // namespace

TilePlan one_tile(int width) { return {width, {{0, 0, width}}}; }

int largest_width(const TileConfig& config, const DisparityRange& range) {
  // Further tiles of nothing but margins would add nothing.
  return std::max(columns(1, config, {}), columns(config.largest_number, config, margins(config, range)));
}

TilePlan plan_tiles(const TileConfig& config, const DisparityRange& range, int width, int pixels) {
  if (width % pixels != 0) {
    throw UserError(
        fmt::format("pipeline.pixels_per_token = {0}: rows of {1} px are no whole number of tokens; "
                    "image.width_granularity = {0} pads them",
                    pixels, width));
  }
  if (width <= static_cast<int>(config.limit)) return one_tile(width);
  const Margins margin = margins(config, range);
  if (width > largest_width(config, range)) {
    throw UserError(
        fmt::format("images of {} columns do not fit: {} tiles of {} columns (tiles.largest_number, "
                    "tiles.limit) that overlap by "
                    "{} + {}{} hold {}",
                    width, config.largest_number, config.limit, config.left_margin, config.right_margin,
                    config.disparities_in_margin
                        ? fmt::format(" + disparity offset {} + range {}", range.offset, range.count)
                        : "",
                    largest_width(config, range)));
  }
  if (width % 2 != 0) {
    throw UserError(fmt::format(
        "images of {} columns in tiles: the width must be even, two pixels share five bytes of the "
        "output; image.width_granularity = 2 pads them",
        width));
  }
  int number = 2;
  while (columns(number, config, margin) < width) ++number;
  TilePlan plan;
  plan.width = round_up_to_even((width + (number - 1) * margin.both() + number - 1) / number);
  // Other places of the seams would be other disparities.
  if (plan.width % pixels != 0) {
    throw UserError(fmt::format(
        "pipeline.pixels_per_token = {}: tiles of {} px are no whole number of tokens; other margins "
        "(tiles.left_margin, tiles.right_margin) make other tiles",
        pixels, plan.width));
  }
  // Where tiles add little, what rounding adds makes some of them needless.
  const int step = plan.width - margin.both();
  number = 1 + (width - plan.width + step - 1) / step;
  for (int i = 0; i < number; ++i) {
    // The last tile ends where the image does; what rounding adds, it shares with the one before.
    const int begin = i + 1 == number ? width - plan.width : i * step;
    plan.tiles.push_back({begin, i == 0 ? 0 : begin + margin.left, width});
    if (i > 0) plan.tiles[i - 1].keep_end = begin + margin.left;
  }
  return plan;
}

EncodedMap cut_map(const EncodedMap& map, const TilePlan& plan) {
  std::vector<MapEncoder> tiles;
  const auto number = static_cast<int>(plan.tiles.size());
  for (int t = 0; t < number; ++t)
    tiles.emplace_back(plan.width, t == 0 ? map.height * number : map.height, map.range);
  decode_rows(map, [&](const OffsetPair* row) {
    for (std::size_t t = 0; t < tiles.size(); ++t) tiles[t].push(row + plan.tiles[t].begin);
  });
  for (std::size_t t = 1; t < tiles.size(); ++t) tiles[0].append(tiles[t]);
  return tiles[0].take();
}

}  // namespace parallax
