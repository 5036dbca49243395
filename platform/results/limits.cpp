// SPDX-License-Identifier: Apache-2.0
#include "platform/results/limits.hpp"

#include <algorithm>
#include <iterator>

namespace parallax {
namespace {

// A part that is at work for less than this is not what the others wait for.
constexpr double kSaturated = 0.95;
// Parts that a slower one feeds run at its pace; those within this share of the largest load count as one.
constexpr double kSamePace = 0.99;
constexpr double kFullPace = 0.9995;
// The core counts as at work while it waits; a part outside it that is at work for so much is what it waits
// for.
constexpr double kWaitedFor = 0.9;

Cycles cycles_between(const ClockDomain& clock, const sc_core::sc_time& from, const sc_core::sc_time& to) {
  return clock.cycle_at_or_after(to) - clock.cycle_at_or_after(from);
}

double ratio(Cycles part, Cycles whole) {
  return part.real() / static_cast<double>(std::max<std::int64_t>(1, whole.count()));
}

// Of all within kSamePace of the largest share, the first. A pace is followed by all: it is one of them only
// where nobody is busier.
const PartLoad& first_at_largest(const std::vector<PartLoad>& loads) {
  double largest = 0;
  for (const PartLoad& load : loads) largest = std::max(largest, load.share);
  return *std::find_if(loads.begin(), loads.end(), [&](const PartLoad& l) {
    return l.share >= (l.part->kind == PartKind::kCameraRate ? kFullPace : kSamePace) * largest;
  });
}

/// What the machine did in a window, part by part.
class WindowLoads {
 public:
  WindowLoads(const Machine& machine, const SteadyWindow& window)
      : machine_(machine),
        config_(machine.config()),
        window_(window),
        first_(machine.snapshots()[window.first]),
        last_(machine.snapshots()[window.last]),
        frames_(static_cast<double>(window.frames())),
        seconds_((last_.time - first_.time).to_seconds()) {}

  PartLoad of(const Part& part) const {
    PartLoad load;
    switch (part.kind) {
      case PartKind::kMemory:
        load = memory();
        break;
      case PartKind::kCamera:
        load = cameras();
        break;
      case PartKind::kCameraRate:
        load = camera_rate();
        break;
      case PartKind::kDmaEngine:
        load = engine(*part.port);
        break;
      case PartKind::kSoftware:
        load = taken(last_.software - first_.software);
        break;
      case PartKind::kCore:
        load = taken(last_.core - first_.core);
        break;
      case PartKind::kStage:
        load = stage(*part.stage);
        break;
      case PartKind::kLink:
        load = cycles(machine_.link_clock(), last_.wire - first_.wire);
        break;
      case PartKind::kHost:
        load = cycles(machine_.link_clock(), last_.host - first_.host);
        break;
    }
    load.part = &part;
    return load;
  }

 private:
  PartLoad cycles(const ClockDomain& clock, Cycles work) const {
    return {nullptr, ratio(work, cycles_between(clock, first_.time, last_.time)),
            clock.seconds(work) / frames_};
  }

  PartLoad taken(const sc_core::sc_time& time) const {
    return {nullptr, time.to_seconds() / seconds_, time.to_seconds() / frames_};
  }

  PartLoad memory() const {
    const Memory& memory = *machine_.memory();
    const Cycles work = last_.memory - first_.memory;
    return {nullptr,
            ratio(work, memory.cycle_at_or_after(last_.time) - memory.cycle_at_or_after(first_.time)),
            memory.seconds(work) / frames_};
  }

  // Reading out, and exposing where that does not overlap. Cameras with a rate of their own read out frames
  // that nobody takes, too; that limits nothing.
  PartLoad cameras() const {
    const CameraConfig& camera = config_.camera;
    const ClockDomain& clock = machine_.camera_clock();
    PartLoad load{nullptr, 0, clock.seconds(machine_.sensor().frame_time())};
    if (camera.exposure_ns > 0) {
      const double exposure = camera.exposure_ns * 1e-9;
      load.busy = camera.overlap ? std::max(exposure, load.busy) : exposure + load.busy;
    }
    // The later image ends the frame.
    if (camera.frame_rate == 0 && camera.skew_ns > 0) load.busy += camera.skew_ns * 1e-9;
    const bool by_cycles = camera.exposure_ns == 0 && camera.frame_rate == 0 && camera.skew_ns == 0;
    const std::int64_t taken =
        last_.cameras.taken - first_.cameras.taken + last_.cameras.faulty - first_.cameras.faulty;
    load.share = by_cycles
                     ? ratio(last_.camera - first_.camera, cycles_between(clock, first_.time, last_.time))
                     : static_cast<double>(taken) * load.busy / seconds_;
    load.share = std::min(1.0, load.share);  // frames are counted whole
    return load;
  }

  // The cameras set the pace as far as their frames come through.
  PartLoad camera_rate() const {
    const double rate = config_.camera.frame_rate;
    const std::int64_t through = window_.frames() + last_.cameras.faulty - first_.cameras.faulty;
    return {nullptr, std::min(1.0, quotient(through, window_.seconds * rate)), 1.0 / rate};
  }

  PartLoad engine(const MemoryPort& port) const {
    const sc_core::sc_time occupied = last_.ports[port.number].occupied - first_.ports[port.number].occupied;
    const std::uint64_t whole = port.slots * (last_.time - first_.time).value();
    return {nullptr, quotient(occupied.value(), whole), occupied.to_seconds() / port.slots / frames_};
  }

  PartLoad stage(const StageInfo& info) const {
    const Cycles frame(info.cycles_per_frame());
    const Cycles whole =
        info.first_pass(window_.last).first_firing - info.first_pass(window_.first).first_firing;
    return {nullptr, ratio(frame * window_.frames(), whole), info.stage->clock().seconds(frame)};
  }

  const Machine& machine_;
  const MachineConfig& config_;
  const SteadyWindow& window_;
  const MachineSnapshot& first_;
  const MachineSnapshot& last_;
  const double frames_;
  const double seconds_;
};

}  // namespace

std::vector<PartLoad> part_loads(const Machine& machine, const SteadyWindow& window) {
  const WindowLoads loads(machine, window);
  std::vector<PartLoad> all;
  for (const Part& part : machine.parts()) all.push_back(loads.of(part));
  return all;
}

Limit find_limit(const std::vector<PartLoad>& loads) {
  Limit limit;
  limit.busiest = first_at_largest(loads);
  limit.limited = limit.busiest.share >= kSaturated;
  if (limit.busiest.part->kind == PartKind::kCore) {
    std::vector<PartLoad> outside;
    std::copy_if(loads.begin(), loads.end(), std::back_inserter(outside),
                 [](const PartLoad& l) { return l.part->core_waits && l.share >= kWaitedFor; });
    if (!outside.empty()) limit.busiest = first_at_largest(outside);
  }
  std::vector<PartLoad> others;
  std::copy_if(loads.begin(), loads.end(), std::back_inserter(others), [&](const PartLoad& l) {
    // The core's time holds the software's.
    const bool same = l.part == limit.busiest.part ||
                      (limit.busiest.part->kind == PartKind::kCore && l.part->kind == PartKind::kSoftware);
    return l.share < kSamePace * limit.busiest.share && !same;
  });
  limit.next = others.empty() ? limit.busiest : first_at_largest(others);
  limit.otherwise = "streams.<name>.depth, camera.frame_buffers, link.output_buffers";
  return limit;
}

}  // namespace parallax
