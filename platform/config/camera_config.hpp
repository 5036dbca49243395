// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "modules/pixel_format.hpp"

namespace parallax {

class Schema;

/// What is wrong with some of a camera's frames.
enum class CameraFault { kNone, kShortFrame, kMissingRow, kOutOfStep };

/// The stereo camera: two synchronised sensors and the way of their pixels into the memory.
struct CameraConfig {
  PixelFormat format = PixelFormat::kMono8;  ///< as it lies in memory, too; own choice
  double frame_rate =
      0.0;  ///< frames/s, 0.001 to 100000; 0 = triggered as soon as a frame buffer is free; own choice
  std::uint32_t jitter_ns = 0;    ///< largest delay of an exposure's end, 0 to 10^9; own choice
  std::uint32_t jitter_seed = 1;  ///< of the delays; own choice
  std::uint32_t exposure_ns = 0;  ///< before the read-out, 0 to 10^9; own choice
  bool overlap = true;            ///< expose while the frame before is read out; own choice
  std::uint32_t skew_ns = 0;      ///< the right sensor behind the left one, 0 to skew_limit_ns; own choice
  std::uint32_t skew_limit_ns = 1'000'000;  ///< of two images that count as one frame, 0 to 10^9; own choice
  CameraFault fault = CameraFault::kNone;   ///< of every fault_every-th frame; own choice
  std::uint32_t fault_every = 10;           ///< frames, 2 to 10^6; own choice
  std::uint32_t fault_rows = 1;             ///< rows that a faulty frame lacks, 1 to 65535; own choice
  std::int64_t bytes_per_second = 400'000'000;  ///< of one sensor's cable, 1 to 10^12; I
  std::uint32_t row_blanking = 32;              ///< pixel clocks between two rows, 0 to 10^6; own choice
  std::uint32_t frame_blanking = 2048;          ///< pixel clocks between two frames, 0 to 10^9; own choice
  std::uint32_t frame_buffers = 3;              ///< stereo frames that the memory holds, 1 to 64; own choice
  std::uint32_t early_start_rows =
      0;  ///< rows of both images with which the core starts; 0 = all; own choice

  /// Throws UserError for a frame rate that is neither 0 nor in its range, and for a jitter without a rate or
  /// not below the period; for a skew above its limit; and for faults of frames that the core has begun.
  void validate() const;
};

void describe(Schema& schema, CameraConfig& config);

}  // namespace parallax
