// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tlm/clock_domain.hpp"
#include "tlm/dataflow.hpp"
#include "tlm/schedule.hpp"
#include "tlm/stage_timing.hpp"

namespace parallax {

/// Where a stage lives: its clock, the engine, and the size of the images that pass through it, in pixels,
/// with how many of these are a token.
struct StageContext {
  const ClockDomain& clock;
  Dataflow& dataflow;
  int width;
  int height;
  bool overlap_frames = false;  ///< of stages that do not say it themselves (StageTiming)

  int pixels_per_token = 1;  ///< neighbours of a row that pass a stage at once; divides the width

  std::uint64_t row_tokens() const { return static_cast<std::uint64_t>(width / pixels_per_token); }
  std::uint64_t tokens() const { return row_tokens() * height; }
};

/// What a raster stage does to its ports for one token of pixels. It takes `groups` firings; ports are read
/// or written in each of them, in the first or in the last one.
struct TokenPorts {
  PortMask every = 0;
  PortMask first = 0;
  PortMask last = 0;
};

/// A stage that goes through the image in raster order, token by token (StageContext): it reads token i while
/// it writes token i - look_ahead.
struct RasterSchedule {
  TokenPorts reads;
  TokenPorts reads_late;  ///< inputs that go with the token written, not with the token read
  TokenPorts writes;
  TokenPorts writes_early;  ///< outputs that go with the token read, not with the token written
  /// A store outside that hands each row's tokens back with the row after: written in all rows but the last,
  /// read in all but the first. The tokens are those read, and where the look-ahead is the frame, so that a
  /// second pass follows, then those written.
  struct RowStore {
    TokenPorts reads;
    TokenPorts writes;
  };
  RowStore first_pass;
  RowStore second_pass;
  std::uint32_t groups = 1;  ///< firings of a token
  std::uint32_t step = 0;    ///< firings of a step: some to a token, or some tokens to a step; 0 = groups
  std::uint32_t last_interval = 1;  ///< cycles after a step's last firing, if more than timing.interval
  std::uint64_t look_ahead = 0;     ///< tokens, at most the frame's
  StageTiming timing;
};

/// Tokens between the newest input and the output, for a window that looks ahead so far; never more than the
/// frame.
std::uint64_t look_ahead_tokens(const StageContext& context, int rows, int pixels);

/// The schedule of one frame. After the last token is in, those still held back come out one in `interval`
/// cycles (one in groups * interval where every group writes). Row overhead follows the last token of a row
/// read, and, where the look-ahead is the frame, of a row written; frame overhead the last token written.
///
/// Where frames overlap (FrameOverlap), the stage has two sides: the reading side takes a pixel into the
/// place that the pixel `look_ahead` before it leaves, of this frame or of the one before; the writing side
/// goes by it, and writes what is held back at a frame's end beside the next frame's first tokens, one in
/// `interval` cycles, whether these come or not. Overheads follow the last pixel read. The look-ahead is one
/// pixel less than the frame at most. A stage with a store does not overlap: its passes share one circuit.
StageSchedule make_schedule(const StageContext& context, const RasterSchedule& raster);

}  // namespace parallax
