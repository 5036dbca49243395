// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "modules/pixel_format.hpp"

namespace parallax {

class Schema;

/// The stereo camera: two synchronised sensors and the way of their pixels into the memory.
struct CameraConfig {
  PixelFormat format = PixelFormat::kMono8;  ///< as it lies in memory, too; own choice
  double frame_rate =
      0.0;  ///< frames/s, 0.001 to 100000; 0 = triggered as soon as a frame buffer is free; own choice
  std::uint32_t jitter_ns = 0;                  ///< largest delay of an exposure's end, 0 to 10^9; own choice
  std::uint32_t jitter_seed = 1;                ///< of the delays; own choice
  std::int64_t bytes_per_second = 400'000'000;  ///< of one sensor's cable, 1 to 10^12; I
  std::uint32_t row_blanking = 32;              ///< pixel clocks between two rows, 0 to 10^6; own choice
  std::uint32_t frame_blanking = 2048;          ///< pixel clocks between two frames, 0 to 10^9; own choice
  std::uint32_t frame_buffers = 3;              ///< stereo frames that the memory holds, 1 to 64; own choice

  /// Throws UserError for a frame rate that is neither 0 nor in its range, and for a jitter without a rate or
  /// not below the period.
  void validate() const;
};

void describe(Schema& schema, CameraConfig& config);

}  // namespace parallax
