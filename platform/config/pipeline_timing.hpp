// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tlm/stage_timing.hpp"

namespace parallax {

class Schema;

/// Time of each stage, in cycles of the core clock. The function of a stage is configured by its own struct.
/// Ranges: interval 1 to 1000, latency 0 to 1000, overheads 0 to 10^6 and 10^9.
struct PipelineTiming {
  // The intervals follow from the frame rates of the paper (D). Latencies are estimates (I) of the registers
  // that each stage's arithmetic needs at some 170 MHz; overheads are not published (own choice: none).
  StageTiming map_decoder{1, 4, 0, 0};
  StageTiming rectification{1, 10, 0, 0};
  StageTiming census{1, 4, 0, 0};
  StageTiming matching{1, 24, 0,
                       0};  ///< its interval is per iteration, `matching.iterations` of them a pixel
  StageTiming subpixel{1, 16, 0, 0};
  StageTiming uniqueness{1, 4, 0, 0};
  StageTiming consistency{1, 6, 0, 0};
  StageTiming texture{1, 6, 0, 0};
  StageTiming speckle{1, 6, 0, 0};
  StageTiming gap_interpolation{1, 16, 0, 0};
  StageTiming noise_reduction{1, 8, 0, 0};

  bool overlap_frames = false;  ///< of stages that do not say it themselves (FrameOverlap); own choice
  int pixels_per_token = 1;  ///< neighbours of a row that pass a stage at once, 1 to 16; D: published rates
};

enum class LooksAhead { kNo, kYes };

/// Declares interval, latency and overheads of one stage, and, if it looks ahead, whether its frames overlap;
/// `token`: what it takes one of an interval.
void describe_timing(Schema& schema, const std::string& stage, const std::string& token,
                     LooksAhead looks_ahead, StageTiming& timing);

/// The same of all stages but the filters of the disparity map, which are a list of their own.
void describe(Schema& schema, PipelineTiming& timing);

}  // namespace parallax
