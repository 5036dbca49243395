// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "modules/map_codec.hpp"
#include "modules/matching.hpp"
#include "platform/config/tile_config.hpp"

namespace parallax {

/// One vertical tile, in columns of the image: begin to begin + TilePlan::width are processed, of which
/// keep_begin to keep_end go out.
struct Tile {
  int begin = 0;
  int keep_begin = 0;
  int keep_end = 0;
};

/// How an image is cut into tiles that overlap: all have one width, and what they keep covers each column
/// once. Processed columns are the image's and, for each further tile, both margins.
struct TilePlan {
  int width = 0;            ///< px, of every tile
  std::vector<Tile> tiles;  ///< from left to right
};

/// The plan for an image that is one tile.
TilePlan one_tile(int width);

/// The plan with the fewest tiles. Throws UserError with the arithmetic when `width` is more than
/// largest_width(), or when it, or a tile, is no whole number of tokens of `pixels` px.
TilePlan plan_tiles(const TileConfig& config, const DisparityRange& range, int width, int pixels = 1);

/// Columns of the widest image that the tiles hold.
int largest_width(const TileConfig& config, const DisparityRange& range);

/// The map of an image cut for its tiles: the rows of tile 0, then those of tile 1, ...
EncodedMap cut_map(const EncodedMap& map, const TilePlan& plan);

}  // namespace parallax
