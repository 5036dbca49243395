// SPDX-License-Identifier: Apache-2.0
#include "platform/results/rate_metrics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tlm/time_resolution.hpp"

namespace parallax {
namespace {

constexpr double kClosePace = 1e-3;      // of the frame period
constexpr double kHardlyKeepsUp = 0.98;  // likewise
constexpr double kSure = 1e-3;           // of the frame rate
// So many frames after the warm-up show a trend well enough to tell where it leads to.
constexpr std::size_t kTold = 100;
// Where triggers jitter, a queue that is hardly kept up with grows and shrinks by chance, over hundreds of
// frames.
constexpr std::size_t kManyByChance = 2000;

void add_performance(const MetricWriter& out, const Machine& machine, const SteadyWindow& window) {
  const double pixels = static_cast<double>(machine.input().width) * machine.input().height;
  const double fps = window.seconds > 0 ? 1.0 / window.period() : 0;
  out.add("performance/frame_rate", fps);
  out.add("performance/disparities_per_second", fps * pixels);
  out.add("performance/evaluations_per_second", fps * pixels * machine.config().matching.range().count);
}

void add_latency(const MetricWriter& out, const Machine& machine, const SteadyWindow& window) {
  const FrameLatencies& latencies = machine.latencies();
  // Of the frame whose arrival begins the window, too.
  const std::string frames = window.frames() == 0
                                 ? window.text
                                 : fmt::format("frames {} to {}", window.first + 1, latencies.measured_end());
  for (std::size_t i = 0; i < frame_spans().size(); ++i) {
    const FrameSpan& span = frame_spans()[i];
    const LatencyHistogram steady = latencies.steady(i);
    const MetricWriter of_span = out.of(span.name, span.description).over(frames);
    const auto add = [&](const char* path, const sc_core::sc_time& time) {
      of_span.add(path, time.to_seconds() * 1e3);
    };
    of_span.over("frame 1").add("latency/<span>_first_frame",
                                span.of(latencies.first_frame()).to_seconds() * 1e3);
    add("latency/<span>_mean", steady.mean());
    add("latency/<span>_p50", steady.percentile(0.5));
    add("latency/<span>_p95", steady.percentile(0.95));
    add("latency/<span>_p99", steady.percentile(0.99));
    add("latency/<span>_largest", steady.largest());
  }
}

std::string names_of(const std::vector<Relief>& reliefs) {
  std::string names;
  for (const Relief relief : reliefs) names += (names.empty() ? "" : " ") + std::string(name_of(relief));
  return names;
}

void add_limit(const MetricWriter& out, const Machine& machine, const SteadyWindow& window) {
  if (window.frames() == 0) return;
  const std::vector<PartLoad> all = part_loads(machine, window);
  const Limit limit = find_limit(all);
  out.add("limit/part", limit.limited ? limit.busiest.part->name : std::string("none"));
  out.add("limit/key", limit.limited ? limit.busiest.part->key : limit.otherwise);
  out.add("limit/relieved_by",
          limit.limited ? names_of(limit.busiest.part->relieved_by) : std::string("none"));
  out.add("limit/utilisation", 100.0 * limit.busiest.share);
  const PartLoad& next = limit.limited ? limit.next : limit.busiest;
  out.add("limit/next_part", next.part->name);
  out.add("limit/next_frame_rate", 1.0 / next.busy);
  for (const PartLoad& load : all)
    out.of(load.part->name).add("limit/utilisation_by_part/<part>", 100.0 * load.share);
}

// From exposure to the host when no buffer is free any more, s: a frame then waits in all of them. A frame
// buffer is exposed into again as soon as the frame in it has been read; where link or host are what the
// others wait for, the core starts when the oldest output buffer has been sent.
double latency_when_full(const Machine& machine, const SteadyWindow& window, const Limit& limit) {
  const MachineConfig& config = machine.config();
  const FrameTimes& last = machine.times()[window.last];
  const double exposure = nanoseconds(config.camera.exposure_ns).to_seconds();
  const PartKind kind = limit.busiest.part->kind;
  if (kind != PartKind::kLink && kind != PartKind::kHost) {
    return config.camera.frame_buffers * window.period() + (last.at_host - last.read).to_seconds() - exposure;
  }
  const double buffers = config.camera.frame_buffers + config.link.output_buffers;
  return buffers * window.period() - (last.read - last.core_started).to_seconds() -
         nanoseconds(config.software.response_ns).to_seconds() - exposure;
}

// What a rising trend leads to.
struct Full {
  double latency;  // s
  double frames;   // from the last one on
};

Full until_full(const Machine& machine, const SteadyWindow& window) {
  const double full = latency_when_full(machine, window, find_limit(part_loads(machine, window)));
  const FrameTimes& last = machine.times()[window.last];
  const double more = std::max(0.0, full - (last.at_host - last.exposed).to_seconds());
  return {full, std::ceil(more / machine.trend().slope())};
}

// Good frames a second of cameras with a rate of their own; 0 of others.
double sent_rate(const CameraConfig& camera) {
  const double faulty = camera.fault == CameraFault::kNone ? 0 : 1.0 / camera.fault_every;
  return camera.frame_rate * (1 - faulty);
}

// Cameras, core, and what sends: a queue of frames lies between each of these.
int side_of(PartKind kind) {
  if (kind == PartKind::kCamera || kind == PartKind::kCameraRate) return 0;
  if (kind == PartKind::kSoftware || kind == PartKind::kCore) return 1;
  return kind == PartKind::kLink || kind == PartKind::kHost ? 2 : -1;
}

// Whether two sides of a queue have so nearly the same pace that a few frames do not show how it fills. With
// a frame rate any part may be what hardly keeps up.
bool paces_are_close(const std::vector<PartLoad>& loads, const LatencyTrend& trend) {
  const auto given = std::find_if(loads.begin(), loads.end(), [](const PartLoad& load) {
    return load.part->kind == PartKind::kCameraRate;
  });
  if (given != loads.end()) {
    return std::any_of(loads.begin(), loads.end(), [&](const PartLoad& load) {
      return load.part->kind != PartKind::kCameraRate && load.busy >= kHardlyKeepsUp * given->busy;
    });
  }
  std::array<double, 3> busy{};
  for (const PartLoad& load : loads) {
    const int side = side_of(load.part->kind);
    if (side >= 0) busy[side] = std::max(busy[side], load.busy);
  }
  std::sort(busy.begin(), busy.end());
  return busy[2] - busy[1] <= 4 * trend.tolerance().to_seconds() + kClosePace * busy[2];
}

// Whether frames are lost by chance, so many that the rate of another such run may differ by a percent.
bool rate_is_by_chance(const Machine& machine, const SteadyWindow& window) {
  if (machine.config().camera.jitter_ns == 0) return false;
  const CameraCounts& first = machine.snapshots()[window.first].cameras;
  const CameraCounts& last = machine.snapshots()[window.last].cameras;
  const auto lost = static_cast<double>(last.dropped + last.missed - first.dropped - first.missed);
  return 2 * std::sqrt(lost) > 0.01 * static_cast<double>(window.frames());
}

// By which share the rate of many more frames may differ, where cameras lose some: over a part of a cycle, by
// one frame.
double uncertainty_of_losses(const Machine& machine, const SteadyWindow& window) {
  return machine.latencies().whole_cycles() ? machine.losses().uncertainty()
                                            : 1.0 / static_cast<double>(window.frames());
}

// Whether a queue may fill so slowly that the frames do not show it.
bool too_few(const Machine& machine, const SteadyWindow& window) {
  const std::size_t enough =
      machine.config().camera.jitter_ns == 0 ? 2 * LatencyTrend::kBlock : kManyByChance;
  return window.frames() < enough && paces_are_close(part_loads(machine, window), machine.trend());
}

std::string established(const Machine& machine, const SteadyWindow& window) {
  if (machine.losses().any()) return uncertainty_of_losses(machine, window) <= kSure ? "yes" : "unknown";
  const LatencyTrend& trend = machine.trend();
  if (!trend.known()) return "unknown";
  if (!trend.settled()) return "no";
  if (too_few(machine, window)) return "unknown";
  return rate_is_by_chance(machine, window) ? "unknown" : "yes";
}

void add_steady(const MetricWriter& out, const Machine& machine, const SteadyWindow& window) {
  if (window.frames() == 0) return;
  out.add("steady/frames", static_cast<std::int64_t>(window.frames() + 1));
  out.add("steady/established", established(machine, window));
  if (machine.losses().any()) {
    out.add("steady/loss_cycles",
            static_cast<std::int64_t>(machine.latencies().whole_cycles() ? machine.losses().whole() : 0));
    out.add("steady/latency_trend", 0.0);
    return;
  }
  const LatencyTrend& trend = machine.trend();
  out.add("steady/latency_trend", trend.slope() * 1e3);
  if (trend.slope() <= 0) return;
  const Full full = until_full(machine, window);
  out.add("steady/latency_when_full", full.latency * 1e3);
  out.add("steady/frames_until_full", static_cast<std::int64_t>(full.frames));
  if (const double drops = sent_rate(machine.config().camera) - 1 / window.period(); drops > 0)
    out.add("steady/drops_when_full", drops);
}

}  // namespace

bool frames_are_enough(const Machine& machine) {
  if (machine.losses().any()) return machine.settled();
  const SteadyWindow window = steady_window(machine);
  if (window.frames() == 0) return machine.settled();
  if (machine.settled()) return !too_few(machine, window);
  const std::size_t frames = machine.snapshots().size();
  const std::int64_t warm_up = warm_up_frames(machine.config());
  if (frames < warm_up + kTold || machine.trend().slope() <= 0) return false;
  return static_cast<double>(frames) + until_full(machine, window).frames >
         static_cast<double>(warm_up + kMostFrames);
}

const MetricTable& rate_table() {
  constexpr const char* kRelaxed = "a run of the machine without that limit";
  static const MetricTable table{
      {"steady/frames", "frames",
       "Frames of the steady state: those after the warm-up (as many as there are buffers), and after those "
       "whose "
       "latency had a trend; of cameras that lose frames without jitter, whole cycles of that.",
       kSteadyState},
      {"steady/established", "",
       "yes: the latency of the last frames, from exposure to the host, has no trend. no: each frame waits "
       "longer "
       "(or shorter) than the one before, as a queue between parts of nearly the same pace fills (or "
       "empties): the "
       "rate is right, latencies are those of these frames. unknown: fewer than three frames after the "
       "warm-up (twelve where triggers jitter); or so few that parts of nearly the same pace, between which "
       "a queue may fill for hundreds "
       "of frames, do not show it; or frames are lost by chance, as triggers jitter, and the rate of another "
       "such run may differ by a percent; or the cameras lose frames, and the rate of more cycles of that "
       "may differ by more than 0.1 %.",
       kSteadyState},
      {"steady/loss_cycles", "",
       "Where the cameras lose frames and their triggers do not jitter: whole cycles of that, from the first "
       "frame after a lost one to another such; 0 where "
       "the run is too short for one, or holds an unfinished one that is longer.",
       kSteadyState},
      {"steady/latency_trend", "ms", "By how much the latency grows from frame to frame; 0 without a trend.",
       kSteadyState},
      {"steady/latency_when_full", "ms",
       "With a rising trend: the latency from exposure to the host that frames come to when no buffer is "
       "free any "
       "more.",
       kSteadyState},
      {"steady/frames_until_full", "frames", "With a rising trend: about as many frames later.",
       kSteadyState},
      {"steady/drops_when_full", "frames/s",
       "With a rising trend, of cameras with a camera.frame_rate: what they send beyond what the machine "
       "takes, so the least that is dropped when no buffer is free any more.",
       kSteadyState},
      {"performance/frame_rate", "frames/s",
       "Rate at which the host receives frames, or, where the link is off, at which their results are in "
       "memory; 0 when there is one frame only. Where triggers jitter and all that the cameras send comes "
       "through, it is that of exposures without the jitter.",
       kSteadyState},
      {"performance/disparities_per_second", "1/s", "Frame rate times processed pixels, valid or not.",
       kSteadyState},
      {"performance/evaluations_per_second", "1/s",
       "Candidate disparities compared: frame rate times processed pixels times disparity range.",
       kSteadyState},
      {"latency/<span>_first_frame", "ms", "What the first frame took <span>.", "frame 1"},
      {"latency/<span>_mean", "ms",
       "What frames took <span>, mean; a span that begins when the core can start contains the wait for the "
       "frames before.",
       kSteadyState},
      {"latency/<span>_p50", "ms", "Half of the frames took at most this <span> (up to 1.6 % too large).",
       kSteadyState},
      {"latency/<span>_p95", "ms", "95 % of the frames took at most this <span> (up to 1.6 % too large).",
       kSteadyState},
      {"latency/<span>_p99", "ms", "99 % of the frames took at most this <span> (up to 1.6 % too large).",
       kSteadyState},
      {"latency/<span>_largest", "ms", "What the slowest frame took <span>.", kSteadyState},
      {"limit/part", "",
       "The part that is at work (nearly) all the time; of several, the first that the data meets. none: no "
       "part is at work for "
       "95 % of the time, so that what limits lies between them: FIFO depths, frame buffers, or the "
       "look-ahead that each frame "
       "fills anew.",
       kSteadyState},
      {"limit/key", "", "The configuration keys that move this limit.", kSteadyState},
      {"limit/relieved_by", "",
       "The limits of --relax without which this part would be faster, separated by blanks.", kSteadyState},
      {"limit/utilisation", "%", "Share of the time in which the busiest part is at work.", kSteadyState},
      {"limit/next_part", "", "The part that would limit if this one did not.", kSteadyState},
      {"limit/next_frame_rate", "frames/s", "The frame rate at which the next part would limit.",
       kSteadyState},
      {"limit/utilisation_by_part/<part>", "%",
       "Share of the time in which the part is at work; a DMA engine is when all requests that it may have "
       "are under way.",
       kSteadyState},
      {"limit/verdict", "",
       "What limits, and what taking it away would gain, in a sentence (--no-verdict leaves it and the next "
       "three out).",
       kRelaxed},
      {"limit/relaxation", "",
       "The limit that gains most when it alone is taken away; fifo_ and a stream for a single FIFO, several "
       "names joined "
       "by + where they gain only together.",
       kRelaxed},
      {"limit/relaxed_frame_rate", "frames/s", "The frame rate without that limit.", kRelaxed},
      {"limit/all_fifos_frame_rate", "frames/s",
       "Where a single FIFO is named and deeper ones gain more: the frame rate with all of them deeper.",
       kRelaxed},
      {"limit/faster_clock_frame_rate", "frames/s",
       "Where what is named costs the core cycles of its own: the frame rate with twice the core's clock, "
       "which "
       "shortens these too.",
       kRelaxed},
      {"limit/relaxed_part", "", "The part that limits then.", kRelaxed},
  };
  return table;
}

void add_rates(MetricGroup& root, const Machine& machine, const SteadyWindow& window) {
  const MetricWriter out = MetricWriter(root, rate_table()).over(window.text);
  add_steady(out, machine, window);
  add_performance(out, machine, window);
  add_latency(out, machine, window);
  add_limit(out, machine, window);
}

}  // namespace parallax
