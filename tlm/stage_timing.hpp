// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace parallax {

/// Whether a frame may come into a stage while the one before goes out: line buffers that are written and
/// read on, instead of being emptied first.
enum class FrameOverlap {
  kAsPipeline,  ///< as all stages of the pipeline
  kNo,
  kYes,
};

/// What a stage declares about its pace, in cycles of its clock.
struct StageTiming {
  std::uint32_t interval = 1;        ///< initiation interval: cycles from one firing to the next, >= 1
  std::uint32_t latency = 1;         ///< pipeline registers between reading and writing; 0 = combinational
  std::uint32_t row_overhead = 0;    ///< idle cycles after each row
  std::uint32_t frame_overhead = 0;  ///< idle cycles after each frame of the stage (Stage)
  FrameOverlap overlap = FrameOverlap::kAsPipeline;  ///< of a stage that looks ahead
};

}  // namespace parallax
