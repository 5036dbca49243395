// SPDX-License-Identifier: Apache-2.0
#include "modules/raster_schedule.hpp"

#include <algorithm>
#include <vector>

namespace parallax {
namespace {

unsigned at_firing(const PixelPorts& ports, std::uint32_t group, std::uint32_t groups) {
  unsigned mask = ports.every;
  if (group == 0) mask |= ports.first;
  if (group + 1 == groups) mask |= ports.last;
  return mask;
}

PixelPorts both(const PixelPorts& a, const PixelPorts& b) {
  const auto sum = [](PortMask one, PortMask other) { return static_cast<PortMask>(one | other); };
  return {sum(a.every, b.every), sum(a.first, b.first), sum(a.last, b.last)};
}

bool any(const RasterSchedule::RowStore& store) {
  const auto used = [](const PixelPorts& ports) { return (ports.every | ports.first | ports.last) != 0; };
  return used(store.reads) || used(store.writes);
}

// Pixels of one kind.
struct Kind {
  bool reads = false;
  bool writes = false;
  const RasterSchedule::RowStore* store = nullptr;
  bool first_row = false;
  bool last_row = false;
};

// The firings of one such pixel.
std::vector<Phase> pixel(const RasterSchedule& raster, const Kind& kind) {
  PixelPorts consume;
  PixelPorts produce;
  if (kind.reads) {
    consume = both(consume, raster.reads);
    produce = both(produce, raster.writes_early);
  }
  if (kind.writes) {
    consume = both(consume, raster.reads_late);
    produce = both(produce, raster.writes);
  }
  if (kind.store != nullptr && !kind.first_row) consume = both(consume, kind.store->reads);
  if (kind.store != nullptr && !kind.last_row) produce = both(produce, kind.store->writes);
  const bool all_groups = kind.reads || raster.writes.every != 0 || raster.reads_late.every != 0;
  const std::uint32_t groups = all_groups ? raster.groups : 1;
  Firings firings;
  for (std::uint32_t group = 0; group < groups; ++group) {
    std::uint32_t interval = raster.timing.interval;
    if (group + 1 == groups) interval = std::max(interval, raster.last_interval);
    firings.add(fires()
                    .reads(at_firing(consume, group, groups))
                    .writes(at_firing(produce, group, groups))
                    .every(interval));
  }
  return firings.phases();
}

}  // namespace

std::uint64_t look_ahead_pixels(const StageContext& context, int rows, int pixels) {
  const std::uint64_t wanted = static_cast<std::uint64_t>(rows) * context.width + pixels;
  return std::min(wanted, context.pixels());
}

Schedule make_schedule(const StageContext& context, const RasterSchedule& raster) {
  const std::uint64_t frame = context.pixels();
  const std::uint64_t width = context.width;
  Schedule schedule;
  // Pixels `done` to `end` of the frame, cut where the kind of pixel changes or a row ends with an overhead.
  const auto go_through = [&](std::uint64_t done, std::uint64_t end, Kind kind,
                              const RasterSchedule::RowStore& store, std::uint32_t row_overhead) {
    if (any(store)) kind.store = &store;
    while (done < end) {
      kind.first_row = done < width;
      kind.last_row = done >= frame - width;
      std::uint64_t stop = end;
      if (row_overhead > 0) {
        stop = std::min(end, (done / width + 1) * width);
      } else if (kind.store != nullptr && !kind.last_row) {
        stop = std::min(end, kind.first_row ? width : frame - width);
      }
      schedule.repeat(stop - done, pixel(raster, kind));
      if (stop % width == 0) schedule.run(idles(row_overhead));
      done = stop;
    }
  };
  const std::uint32_t overhead = raster.timing.row_overhead;
  go_through(0, raster.look_ahead, {true, false}, raster.first_pass, overhead);
  go_through(raster.look_ahead, frame, {true, true}, raster.first_pass, overhead);
  // What is held back for a frame comes out in a second pass, row by row like the first one.
  const std::uint32_t second = raster.look_ahead == frame ? overhead : 0;
  go_through(frame - raster.look_ahead, frame, {false, true}, raster.second_pass, second);
  return schedule.run(idles(raster.timing.frame_overhead));
}

}  // namespace parallax
