// SPDX-License-Identifier: Apache-2.0
#include "modules/raster_schedule.hpp"

#include <algorithm>
#include <vector>

namespace parallax {
namespace {

PortMask at_beat(const PixelPorts& ports, std::uint32_t beat, std::uint32_t beats) {
  unsigned mask = ports.every;
  if (beat == 0) mask |= ports.first;
  if (beat + 1 == beats) mask |= ports.last;
  return static_cast<PortMask>(mask);
}

// The firings of one pixel that is read, written, or both; equal neighbours are one phase.
std::vector<Phase> pixel(const RasterSchedule& raster, bool reads, bool writes) {
  const bool all_beats = reads || raster.writes.every != 0 || raster.reads_late.every != 0;
  const std::uint32_t beats = all_beats ? raster.beats : 1;
  std::vector<Phase> phases;
  for (std::uint32_t beat = 0; beat < beats; ++beat) {
    Phase phase{1, raster.timing.interval, 0, 0};
    if (beat + 1 == beats) phase.interval = std::max(phase.interval, raster.last_interval);
    if (reads) phase.consume = at_beat(raster.reads, beat, beats);
    if (writes) {
      phase.consume = static_cast<PortMask>(phase.consume | at_beat(raster.reads_late, beat, beats));
      phase.produce = at_beat(raster.writes, beat, beats);
    }
    if (!phases.empty() && phases.back().consume == phase.consume && phases.back().produce == phase.produce &&
        phases.back().interval == phase.interval) {
      ++phases.back().count;
    } else {
      phases.push_back(phase);
    }
  }
  return phases;
}

}  // namespace

std::uint64_t look_ahead_pixels(const StageContext& context, int rows, int pixels) {
  const std::uint64_t wanted = static_cast<std::uint64_t>(rows) * static_cast<std::uint64_t>(context.width) +
                               static_cast<std::uint64_t>(pixels);
  return std::min(wanted, context.pixels());
}

Schedule make_schedule(const StageContext& context, const RasterSchedule& raster) {
  const std::uint64_t frame = context.pixels();
  const auto width = static_cast<std::uint64_t>(context.width);
  const std::vector<Phase> fill = pixel(raster, true, false);
  const std::vector<Phase> both = pixel(raster, true, true);
  Schedule schedule;
  std::uint64_t done = 0;
  const auto read_until = [&](std::uint64_t end, const std::vector<Phase>& phases) {
    if (raster.timing.row_overhead == 0) {
      schedule.repeat(end - done, phases);
      done = end;
      return;
    }
    while (done < end) {
      const std::uint64_t stop = std::min(end, (done / width + 1) * width);
      schedule.repeat(stop - done, phases);
      if (stop % width == 0) schedule.run({1, raster.timing.row_overhead, 0, 0});
      done = stop;
    }
  };
  read_until(raster.look_ahead, fill);
  read_until(frame, both);
  schedule.repeat(raster.look_ahead, pixel(raster, false, true));
  if (raster.timing.frame_overhead > 0) schedule.run({1, raster.timing.frame_overhead, 0, 0});
  return schedule;
}

}  // namespace parallax
