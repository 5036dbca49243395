// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace parallax {

class Schema;

/// Sizes are multiples of this, px.
struct Granularity {
  int width;
  int height;
};

/// Size of the processed images, in pixels.
struct ImageConfig {
  std::uint32_t width = 0;                ///< 0 = from the images; own choice
  std::uint32_t height = 0;               ///< 0 = from the images; own choice
  std::uint32_t width_granularity = 32;   ///< widths are multiples of this, 1 to 1024; D
  std::uint32_t height_granularity = 16;  ///< heights are multiples of this, 1 to 1024; D
  std::uint32_t max_width = 0;            ///< to 65536; 0 = as wide as the tiles hold; D
  std::uint32_t max_height = 1856;        ///< 1 to 65536; S

  Granularity granularity() const {
    return {static_cast<int>(width_granularity), static_cast<int>(height_granularity)};
  }
  /// Throws UserError when a size that is set is larger than the largest.
  void validate() const;
};

void describe(Schema& schema, ImageConfig& config);

}  // namespace parallax
