// SPDX-License-Identifier: Apache-2.0
#include "platform/results/limits.hpp"

#include <fmt/format.h>

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

// After the warm-up: two frame periods lie between three arrivals at the host.
constexpr std::int64_t kMeasuredFrames = 3;
// With cameras that go their own way.
constexpr std::int64_t kManyFrames = 100;

Cycles cycles_between(const ClockDomain& clock, const sc_core::sc_time& from, const sc_core::sc_time& to) {
  return clock.cycle_at_or_after(to) - clock.cycle_at_or_after(from);
}

double ratio(Cycles part, Cycles whole) {
  return static_cast<double>(part.count()) / static_cast<double>(std::max<std::int64_t>(1, whole.count()));
}

// Of all within kSamePace of the largest share, the first. A pace is followed by all: it is one of them only
// where nobody is busier.
const PartLoad& first_at_largest(const std::vector<PartLoad>& loads) {
  double largest = 0;
  for (const PartLoad& load : loads) largest = std::max(largest, load.share);
  return *std::find_if(loads.begin(), loads.end(), [&](const PartLoad& l) {
    return l.share >= (l.is_pace ? kFullPace : kSamePace) * largest;
  });
}

std::int64_t frames_taken(const Activity& first, const Activity& last) {
  return last.cameras.taken - first.cameras.taken + last.cameras.faulty - first.cameras.faulty;
}

// Reading out, and exposing where that does not overlap. Cameras with a rate of their own read out frames
// that nobody takes, too; that limits nothing.
PartLoad camera_load(const Machine& machine, const Activity& first, const Activity& last) {
  const CameraConfig& config = machine.config().camera;
  const ClockDomain& clock = machine.camera_clock();
  PartLoad load{"camera", "clocks.camera_hz", 0, clock.seconds(machine.sensor().frame_time())};
  if (config.exposure_ns > 0) {
    const double exposure = config.exposure_ns * 1e-9;
    load.key = "camera.exposure_ns, clocks.camera_hz";
    load.busy = config.overlap ? std::max(exposure, load.busy) : exposure + load.busy;
  }
  if (config.frame_rate == 0 && config.skew_ns > 0) {
    load.key += ", camera.skew_ns";
    load.busy += config.skew_ns * 1e-9;  // the later image ends the frame
  }
  const bool by_cycles = config.exposure_ns == 0 && config.frame_rate == 0 && config.skew_ns == 0;
  load.share = by_cycles ? ratio(last.camera - first.camera, cycles_between(clock, first.time, last.time))
                         : static_cast<double>(frames_taken(first, last)) * load.busy /
                               (last.time - first.time).to_seconds();
  load.share = std::min(1.0, load.share);  // frames are counted whole
  load.core_waits = config.early_start_rows > 0;
  return load;
}

// The cameras set the pace as far as their frames come through.
PartLoad camera_rate_load(const Machine& machine, const SteadyWindow& window, const Activity& first,
                          const Activity& last) {
  const double rate = machine.config().camera.frame_rate;
  const auto through =
      static_cast<std::int64_t>(window.frames()) + last.cameras.faulty - first.cameras.faulty;
  const double elapsed = (last.time - first.time).to_seconds();
  PartLoad load{"camera_frame_rate", "camera.frame_rate", 0, 1.0 / rate};
  load.share = std::min(1.0, static_cast<double>(through) / (elapsed * rate));
  load.is_pace = true;
  return load;
}

}  // namespace

std::int64_t frames_to_simulate(const MachineConfig& config, std::int64_t input_frames,
                                std::optional<std::int64_t> asked) {
  std::int64_t measured = kMeasuredFrames;
  if (config.camera.frame_rate > 0 || config.camera.fault != CameraFault::kNone) {
    // Buffers fill, or not; frames jitter, and some are lost: of these, whole rounds.
    const std::int64_t round = config.camera.fault == CameraFault::kNone
                                   ? 1
                                   : std::max<std::int64_t>(1, std::int64_t{config.camera.fault_every} - 1);
    measured = 1 + (kManyFrames + round - 1) / round * round;
  }
  return std::max(input_frames, asked.value_or(warm_up_frames(config) + measured));
}

SteadyWindow steady_window(const Machine& machine) {
  const KeptRecords<Activity>& activities = machine.activities();
  SteadyWindow window;
  window.last = activities.size() - 1;
  if (window.last == 0) {
    window.text = "frame 1";
    return window;
  }
  window.first = steady_first(machine.config(), machine.input().frames);
  window.period = (activities[window.last].time - activities[window.first].time).to_seconds() /
                  static_cast<double>(window.frames());
  window.text = fmt::format("frames {} to {}", window.first + 2, window.last + 1);
  return window;
}

std::vector<PartLoad> part_loads(const Machine& machine, const SteadyWindow& window) {
  const Activity& first = machine.activities()[window.first];
  const Activity& last = machine.activities()[window.last];
  const auto frames = static_cast<double>(window.frames());
  const MachineConfig& config = machine.config();
  std::vector<PartLoad> loads;

  if (const Memory* memory = machine.memory()) {
    const Cycles work = last.memory - first.memory;
    loads.push_back(
        {"memory", config.memory.model == MemoryModel::kDram ? "memory.device" : "memory.bytes_per_cycle",
         ratio(work, memory->cycle_at_or_after(last.time) - memory->cycle_at_or_after(first.time)),
         memory->seconds(work) / frames, true});
  }

  const double elapsed = (last.time - first.time).to_seconds();
  loads.push_back(camera_load(machine, first, last));
  if (config.camera.frame_rate > 0) loads.push_back(camera_rate_load(machine, window, first, last));

  const std::vector<Machine::Port>& ports = machine.ports();
  for (std::size_t port = 0; port < last.ports.size(); ++port) {
    const sc_core::sc_time occupied = last.ports[port].occupied - first.ports[port].occupied;
    const std::uint32_t places = ports[port].places;
    const std::uint64_t whole = places * (last.time - first.time).value();
    loads.push_back({"dma_" + ports[port].name, "dma." + ports[port].engine + ".outstanding",
                     static_cast<double>(occupied.value()) / static_cast<double>(whole),
                     occupied.to_seconds() / places / frames});
  }

  if (config.software.response_ns > 0) {
    const double starting = (last.software - first.software).to_seconds();
    loads.push_back({"software", "software.response_ns", starting / elapsed, starting / frames});
  }
  if (!config.software.queue_frames) {
    const double taken = (last.core - first.core).to_seconds();
    loads.push_back({"core", "clocks.core_hz, software.response_ns", taken / elapsed, taken / frames});
  }
  for (const StageInfo& info : machine.pipeline().stages()) {
    const Cycles frame(static_cast<std::int64_t>(info.cycles_per_frame()));
    const Cycles whole =
        info.first_pass(window.last).first_firing - info.first_pass(window.first).first_firing;
    loads.push_back({info.stage->basename(), "clocks.core_hz",
                     ratio(frame * static_cast<std::int64_t>(window.frames()), whole),
                     info.stage->clock().seconds(frame)});
  }

  if (config.link.enabled) {
    const ClockDomain& link_clock = machine.link_clock();
    const Cycles whole = cycles_between(link_clock, first.time, last.time);
    const Cycles wire = last.wire - first.wire;
    const Cycles host = last.host - first.host;
    loads.push_back({"link", "link.line_rate", ratio(wire, whole), link_clock.seconds(wire) / frames});
    loads.push_back({"host", "link.host_pixel_rate", ratio(host, whole), link_clock.seconds(host) / frames});
  }
  return loads;
}

LimitVerdict find_limit(const std::vector<PartLoad>& loads) {
  LimitVerdict verdict;
  verdict.busiest = first_at_largest(loads);
  verdict.limited = verdict.busiest.share >= kSaturated;
  if (verdict.busiest.part == "core") {
    std::vector<PartLoad> outside;
    std::copy_if(loads.begin(), loads.end(), std::back_inserter(outside),
                 [](const PartLoad& l) { return l.core_waits && l.share >= kWaitedFor; });
    if (!outside.empty()) verdict.busiest = first_at_largest(outside);
  }
  std::vector<PartLoad> others;
  std::copy_if(loads.begin(), loads.end(), std::back_inserter(others), [&](const PartLoad& l) {
    // The core's time holds the software's.
    const bool same =
        l.part == verdict.busiest.part || (verdict.busiest.part == "core" && l.part == "software");
    return l.share < kSamePace * verdict.busiest.share && !same;
  });
  verdict.next = others.empty() ? verdict.busiest : first_at_largest(others);
  verdict.otherwise = "streams.<name>.depth, camera.frame_buffers, link.output_buffers";
  return verdict;
}

}  // namespace parallax
