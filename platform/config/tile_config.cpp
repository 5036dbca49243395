// SPDX-License-Identifier: Apache-2.0
#include "platform/config/tile_config.hpp"

#include <fmt/format.h>

#include "platform/config/schema.hpp"
#include "tlm/error.hpp"

namespace parallax {

void TileConfig::validate() const {
  const auto even = [](const char* key, std::uint32_t columns) {
    if (columns % 2 == 0) return;
    throw UserError(
        fmt::format("{} = {}: must be even, two pixels share five bytes of the output", key, columns));
  };
  even("tiles.limit", limit);
  even("tiles.left_margin", left_margin);
  even("tiles.right_margin", right_margin);
}

void describe(Schema& schema, TileConfig& config) {
  schema.integer(
      "tiles.limit", config.limit, {8, 65536}, "px",
      "Columns that the line buffers hold, even. Wider images are processed in vertical tiles, all rows of "
      "one "
      "and then all rows of the next.",
      inferred("with two tiles that overlap by 192 columns it gives the largest image, 1856 columns"));
  schema.integer("tiles.largest_number", config.largest_number, {1, 64}, "tiles",
                 "Tiles that an image can have.",
                 stated("published network protocol: at most two tiles in the paper's generation"));
  schema.integer(
      "tiles.left_margin", config.left_margin, {0, 4096}, "px",
      "Columns processed on the left of those that a tile contributes; even.",
      inferred("windows of rectification and filters reach across a seam; the sum of both is not published"));
  schema.integer(
      "tiles.right_margin", config.right_margin, {0, 4096}, "px",
      "Columns processed on the right of those that a tile contributes; even.",
      inferred("windows of rectification and filters reach across a seam; the sum of both is not published"));
  schema.boolean("tiles.disparities_in_margin", config.disparities_in_margin,
                 "Whether matching.disparity_offset and the disparity range come on top of the left margin.",
                 inferred("raising either lowers the largest configurable image"));
}

}  // namespace parallax
