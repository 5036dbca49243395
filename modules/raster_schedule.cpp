// SPDX-License-Identifier: Apache-2.0
#include "modules/raster_schedule.hpp"

#include <algorithm>
#include <vector>

namespace parallax {
namespace {

unsigned at_firing(const TokenPorts& ports, std::uint32_t group, std::uint32_t groups) {
  unsigned mask = ports.every;
  if (group == 0) mask |= ports.first;
  if (group + 1 == groups) mask |= ports.last;
  return mask;
}

TokenPorts both(const TokenPorts& a, const TokenPorts& b) {
  const auto sum = [](PortMask one, PortMask other) { return static_cast<PortMask>(one | other); };
  return {sum(a.every, b.every), sum(a.first, b.first), sum(a.last, b.last)};
}

bool any(const RasterSchedule::RowStore& store) {
  const auto used = [](const TokenPorts& ports) { return (ports.every | ports.first | ports.last) != 0; };
  return used(store.reads) || used(store.writes);
}

// Tokens of one kind.
struct Kind {
  bool reads = false;
  bool writes = false;
  const RasterSchedule::RowStore* store = nullptr;
  bool first_row = false;
  bool last_row = false;
};

// The firings of one such token, the first of them number `first` of the frame.
std::vector<Phase> token(const RasterSchedule& raster, const Kind& kind, std::uint64_t first) {
  TokenPorts consume;
  TokenPorts produce;
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
  const std::uint32_t step = all_groups && raster.step != 0 ? raster.step : groups;
  Firings firings;
  for (std::uint32_t group = 0; group < groups; ++group) {
    std::uint32_t interval = raster.timing.interval;
    if ((first + group + 1) % step == 0) interval = std::max(interval, raster.last_interval);
    firings.add(fires()
                    .reads(at_firing(consume, group, groups))
                    .writes(at_firing(produce, group, groups))
                    .every(interval));
  }
  return firings.phases();
}

// Tokens `begin` to `end` of the frame, all of one kind.
void add_tokens(Schedule& schedule, const RasterSchedule& raster, const Kind& kind, std::uint64_t begin,
                std::uint64_t end) {
  // Tokens in which the steps begin anew.
  const std::uint64_t period =
      raster.last_interval > raster.timing.interval ? std::max(raster.step / raster.groups, 1U) : 1;
  const auto at = [&](std::uint64_t i) { return token(raster, kind, i * raster.groups); };
  for (; begin < end && begin % period != 0; ++begin) schedule.repeat(1, at(begin));
  std::vector<Phase> of_period;
  for (std::uint64_t i = 0; i < period; ++i) {
    const std::vector<Phase> phases = at(i);
    of_period.insert(of_period.end(), phases.begin(), phases.end());
  }
  schedule.repeat((end - begin) / period, of_period);
  for (begin = end - (end - begin) % period; begin < end; ++begin) schedule.repeat(1, at(begin));
}

// One schedule that goes through the frame, and empties the look-ahead.
Schedule one_side(const StageContext& context, const RasterSchedule& raster) {
  const std::uint64_t frame = context.tokens();
  const std::uint64_t width = context.row_tokens();
  Schedule schedule;
  // Tokens `done` to `end` of the frame, cut where their kind changes or a row ends with an overhead.
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
      add_tokens(schedule, raster, kind, done, stop);
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

bool overlaps(const StageContext& context, const RasterSchedule& raster) {
  if (raster.look_ahead == 0 || context.tokens() < 2) return false;
  const TokenPorts& early = raster.writes_early;
  const bool store =
      any(raster.first_pass) || any(raster.second_pass) || (early.every | early.first | early.last) != 0;
  if (store) return false;
  const FrameOverlap overlap = raster.timing.overlap;
  return overlap == FrameOverlap::kAsPipeline ? context.overlap_frames : overlap == FrameOverlap::kYes;
}

// When in a token the sides meet: in each of its firings if each of them writes, otherwise once.
TokenPorts meeting(const TokenPorts& writes, const TokenPorts& late, unsigned port) {
  const auto mask = static_cast<PortMask>(1u << port);
  if ((writes.every | late.every) != 0) return {mask, 0, 0};
  return (writes.last | late.last) != 0 ? TokenPorts{0, 0, mask} : TokenPorts{0, mask, 0};
}

// What is read goes into the places of what is written: two schedules, which meet at each token.
StageSchedule two_sides(const StageContext& context, const RasterSchedule& raster) {
  const std::uint64_t frame = context.tokens();
  const std::uint64_t look_ahead = std::min(raster.look_ahead, frame - 1);
  const TokenPorts handed = meeting(raster.writes, raster.reads_late, StageSchedule::kHandedPort);
  const TokenPorts kept{0, static_cast<PortMask>(1u << StageSchedule::kKeptPort), 0};
  StageSchedule sides;
  sides.kept = static_cast<std::uint32_t>(look_ahead);

  RasterSchedule head = raster;
  head.reads_late = {};
  head.writes = kept;
  RasterSchedule rest = head;
  rest.writes = handed;
  const std::uint64_t width = context.row_tokens();
  const std::uint32_t overhead = raster.timing.row_overhead;
  const auto read = [&](std::uint64_t done, std::uint64_t end, const RasterSchedule& tokens) {
    while (done < end) {
      const std::uint64_t stop = overhead == 0 ? end : std::min(end, (done / width + 1) * width);
      add_tokens(sides.reading, tokens, {true, true}, done, stop);
      if (stop % width == 0) sides.reading.run(idles(overhead));
      done = stop;
    }
  };
  read(0, look_ahead, head);
  read(look_ahead, frame, rest);
  sides.reading.run(idles(raster.timing.frame_overhead));

  // A step's rest is the reading side's: the writing side goes by it until nothing more is read.
  RasterSchedule out = raster;
  out.last_interval = raster.timing.interval;
  out.reads = {};
  out.reads_late = both(raster.reads_late, handed);
  RasterSchedule tail = raster;
  tail.reads = {};
  tail.reads_late = both(raster.reads_late, kept);
  add_tokens(sides.writing, out, {false, true}, 0, frame - look_ahead);
  add_tokens(sides.writing, tail, {false, true}, frame - look_ahead, frame);
  return sides;
}

}  // namespace

std::uint64_t look_ahead_tokens(const StageContext& context, int rows, int pixels) {
  const std::uint64_t in_row = (pixels + context.pixels_per_token - 1) / context.pixels_per_token;
  return std::min(rows * context.row_tokens() + in_row, context.tokens());
}

StageSchedule make_schedule(const StageContext& context, const RasterSchedule& raster) {
  if (overlaps(context, raster)) return two_sides(context, raster);
  return {one_side(context, raster), {}, 0};
}

}  // namespace parallax
