// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tlm/clock_domain.hpp"
#include "tlm/dataflow.hpp"
#include "tlm/schedule.hpp"
#include "tlm/stage_timing.hpp"

namespace parallax {

/// Where a stage lives: its clock, the engine, and the size of the images that pass through it, in pixels.
struct StageContext {
  const ClockDomain& clock;
  Dataflow& dataflow;
  int width;
  int height;

  std::uint64_t pixels() const { return static_cast<std::uint64_t>(width) * height; }
};

/// What a raster stage does to its ports for one pixel. Each pixel takes `groups` firings; ports are read or
/// written in each of them, in the first or in the last one.
struct PixelPorts {
  PortMask every = 0;
  PortMask first = 0;
  PortMask last = 0;
};

/// A stage that goes through the image in raster order: it reads pixel i while it writes pixel i -
/// look_ahead.
struct RasterSchedule {
  PixelPorts reads;
  PixelPorts reads_late;  ///< inputs that go with the pixel written, not with the pixel read
  PixelPorts writes;
  PixelPorts writes_early;  ///< outputs that go with the pixel read, not with the pixel written
  /// A store outside that hands each row's tokens back with the row after: written in all rows but the last,
  /// read in all but the first. The pixels are those read, and where the look-ahead is the frame, so that a
  /// second pass follows, then those written.
  struct RowStore {
    PixelPorts reads;
    PixelPorts writes;
  };
  RowStore first_pass;
  RowStore second_pass;
  std::uint32_t groups = 1;
  std::uint32_t last_interval = 1;  ///< cycles after a pixel's last firing, if more than timing.interval
  std::uint64_t look_ahead = 0;     ///< pixels, at most the frame's
  StageTiming timing;
};

/// Pixels between the newest input and the output, for a window that looks ahead so far; never more than the
/// frame.
std::uint64_t look_ahead_pixels(const StageContext& context, int rows, int pixels);

/// The schedule of one frame. After the last pixel is in, the pixels still held back come out one in
/// `interval` cycles (one in groups * interval where every group writes). Row overhead follows the last pixel
/// of a row read, and, where the look-ahead is the frame, of a row written; frame overhead the last pixel
/// written.
Schedule make_schedule(const StageContext& context, const RasterSchedule& raster);

}  // namespace parallax
