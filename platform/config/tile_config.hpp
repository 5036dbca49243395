// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace parallax {

class Schema;

/// Vertical tiles, in which images are processed that are wider than the line buffers.
struct TileConfig {
  std::uint32_t limit = 1024;        ///< columns that the line buffers hold, 8 to 65536; I
  std::uint32_t largest_number = 2;  ///< tiles of an image, 1 to 64; S
  std::uint32_t left_margin = 32;   ///< columns processed left of what a tile contributes, even, 0 to 4096; I
  std::uint32_t right_margin = 32;  ///< likewise on the right; I
  /// Whether disparity offset and range come on top of the left margin, so that the first column that a tile
  /// contributes can match over the whole range; I.
  bool disparities_in_margin = true;

  /// Throws UserError when a margin or the limit is odd: two pixels share five bytes of the output.
  void validate() const;
};

void describe(Schema& schema, TileConfig& config);

}  // namespace parallax
