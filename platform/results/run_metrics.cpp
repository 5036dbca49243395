// SPDX-License-Identifier: Apache-2.0
#include "platform/results/run_metrics.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "platform/results/energy.hpp"
#include "platform/results/limits.hpp"
#include "platform/results/memory_metrics.hpp"
#include "platform/results/pipeline_metrics.hpp"
#include "platform/results/version.hpp"

namespace parallax {
namespace {

void add_performance(MetricGroup& root, const Machine& machine, const SteadyWindow& window) {
  const double pixels = static_cast<double>(machine.input().width) * machine.input().height;
  const double fps = window.period > 0 ? 1.0 / window.period : 0;
  const int range = machine.config().matching.range().count;
  MetricGroup& group = root.group("performance");
  group.add({"frame_rate", fps, "frames/s",
             "Steady-state rate at which the host receives frames; 0 for a single frame.", window.text});
  group.add({"disparities_per_second", fps * pixels, "1/s", "Frame rate times pixels of the processed image.",
             window.text});
  group.add({"evaluations_per_second", fps * pixels * range, "1/s",
             "Disparity evaluations: frame rate times pixels times disparity range.", window.text});
}

void add_latency(MetricGroup& root, const Machine& machine, const SteadyWindow& window) {
  MetricGroup& group = root.group("latency");
  const FrameLatencies& latencies = machine.latencies();
  // Of the frame whose arrival begins the window, too.
  const std::string frames =
      window.frames() == 0 ? window.text : fmt::format("frames {} to {}", window.first + 1, window.last + 1);
  for (std::size_t i = 0; i < frame_spans().size(); ++i) {
    const FrameSpan& span = frame_spans()[i];
    const LatencyHistogram& steady = latencies.steady(i);
    const auto add = [&](const char* what, const sc_core::sc_time& time, const std::string& of) {
      group.add({fmt::format("{}_{}", span.name, what), time.to_seconds() * 1e3, "ms", span.description, of});
    };
    add("first_frame", span.of(latencies.first_frame()), "frame 1");
    add("mean", steady.mean(), frames);
    add("p50", steady.percentile(0.5), frames);
    add("p95", steady.percentile(0.95), frames);
    add("p99", steady.percentile(0.99), frames);
    add("largest", steady.largest(), frames);
  }
}

void add_limit(MetricGroup& root, const Machine& machine, const SteadyWindow& window) {
  if (window.frames() == 0) return;
  const std::vector<PartLoad> all = part_loads(machine, window);
  const LimitVerdict verdict = find_limit(all);
  MetricGroup& group = root.group("limit");
  group.add(
      {"part", verdict.limited ? verdict.busiest.part->name : "none", "",
       "The part that is at work all the time; of several, the first that the data meets. none: no part is.",
       window.text});
  group.add({"key", verdict.limited ? verdict.busiest.part->key : verdict.otherwise, "",
             "The configuration keys that move this limit.", window.text});
  group.add({"utilisation", 100.0 * verdict.busiest.share, "%",
             "Share of the time in which the busiest part is at work.", window.text});
  const PartLoad& next = verdict.limited ? verdict.next : verdict.busiest;
  group.add(
      {"next_part", next.part->name, "", "The part that would limit if this one did not.", window.text});
  group.add({"next_frame_rate", 1.0 / next.busy, "frames/s", "The rate at which it would.", window.text});
  MetricGroup& parts = group.group("utilisation_by_part");
  for (const PartLoad& load : all) {
    parts.add({load.part->name, 100.0 * load.share, "%", "Share of the time in which the part is at work.",
               window.text});
  }
}

void add_run(MetricGroup& root, const RunTotals& totals, const std::string& status,
             const sc_core::sc_time& simulated) {
  MetricGroup& run = root.group("run");
  run.add({"status", status, "", "done, or stuck: the machine came to a halt before the host had all frames.",
           ""});
  run.add({"version", std::string(version()), "", "Of the model.", ""});
  run.add({"revision", std::string(revision()), "", "Git revision that the model was built from.", ""});
  run.add({"command", totals.command, "", "Makes this run again, from the same folder.", ""});
  if (totals.scene_seed) {
    run.add({"seed", fmt::format("{}", *totals.scene_seed), "", "Of the built-in scene.", ""});
  }
  run.add({"wall_time", totals.wall_seconds, "s", "Time that the run took on this computer.", ""});
  run.add({"simulated_time", simulated.to_seconds(), "s", "Time of the modelled machine.", ""});
  run.add({"speed", simulated.to_seconds() / std::max(totals.wall_seconds, 1e-9), "s/s",
           "Simulated time per wall-clock time.", ""});
  run.add({"peak_memory", totals.peak_megabytes, "MB", "Largest resident size of the program.", ""});
}

void add_input(MetricGroup& root, const Machine& machine, const RunTotals& totals, int image_width,
               int image_height) {
  MetricGroup& input = root.group("input");
  input.add({"width", std::int64_t{image_width}, "px", "Of the images as given.", ""});
  input.add({"height", std::int64_t{image_height}, "px", "Of the images as given.", ""});
  input.add({"processed_width", std::int64_t{machine.input().width}, "px", "Padded to the granularity.", ""});
  input.add(
      {"processed_height", std::int64_t{machine.input().height}, "px", "Padded to the granularity.", ""});
  const DisparityRange range = machine.config().matching.range();
  input.add({"disparity_range", std::int64_t{range.count}, "px", "Number of disparities searched.", ""});
  input.add({"disparity_offset", std::int64_t{range.offset}, "px", "Smallest disparity searched.", ""});
  input.add({"frames", machine.input().frames, "frames", "Simulated in time.", ""});
  input.add({"frames_with_images", totals.frames, "frames", "Of these, with their images computed.", ""});
}

void add_cameras(MetricGroup& root, const Machine& machine, const CameraCounts& cameras) {
  MetricGroup& camera = root.group("camera");
  camera.add(
      {"late_bursts", static_cast<std::int64_t>(machine.sensor().late_bursts()), "bursts",
       "Bursts of the left sensor that found its FIFO full: the memory did not keep up with the read-out.",
       "the whole run"});
  camera.add({"triggers", cameras.triggers, "triggers", "That the cameras were given.", "the whole run"});
  camera.add({"taken_frames", cameras.taken, "frames",
              "Frames that found a frame buffer, without the faulty ones.", "the whole run"});
  camera.add({"dropped_frames", cameras.dropped, "frames", "Frames that found no frame buffer free.",
              "the whole run"});
  camera.add({"faulty_frames", cameras.faulty, "frames",
              "Frames that a camera fault spoilt, flagged and not processed.", "the whole run"});
  camera.add({"missed_triggers", cameras.missed, "triggers", "Triggers that found a sensor reading out.",
              "the whole run"});
}

void add_software(MetricGroup& root, const Machine& machine, const SteadyWindow& window) {
  root.group("software")
      .add({"rejected_starts", machine.rejected_starts(), "starts",
            "Frames that the core did not take at once because of what its registers said.",
            "the whole run"});
  const sc_core::sc_time before =
      window.frames() > 0 ? machine.snapshots()[window.first].output_full : sc_core::SC_ZERO_TIME;
  root.group("software")
      .add({"waits_for_output_buffer",
            (machine.snapshots()[window.last].output_full - before).to_seconds() * 1e3 /
                static_cast<double>(std::max<std::size_t>(1, window.frames())),
            "ms",
            "Time a frame in which the core could have been started but for its results: all buffers waited "
            "to be sent.",
            window.text});
}

void add_quality(MetricGroup& root, const RunTotals& totals) {
  const std::string with_images = fmt::format("{} frames with images", totals.frames);
  MetricGroup& quality = root.group("quality");
  if (totals.pixels > 0) {
    quality.add({"valid_share",
                 100.0 * static_cast<double>(totals.valid) / static_cast<double>(totals.pixels), "%",
                 "Pixels of the image that have a disparity.", with_images});
  }
  if (totals.has_truth) {
    for (const Quality& q : totals.score.qualities()) {
      quality.add({q.name, q.value, q.unit, q.description, with_images});
    }
  }
}

}  // namespace

MetricGroup measure(const Machine& machine, const RunTotals& totals, int image_width, int image_height) {
  const SteadyWindow window = steady_window(machine);
  MetricGroup root;
  add_run(root, totals, "done", machine.snapshots().back().time);
  add_input(root, machine, totals, image_width, image_height);
  add_cameras(root, machine, machine.snapshots().back().cameras);
  add_software(root, machine, window);
  add_performance(root, machine, window);
  add_latency(root, machine, window);
  add_limit(root, machine, window);
  add_memory(root, machine, window);
  add_energy(root, estimate_energy(machine.config().energy, energy_activity(machine, window)), window.text);
  add_pipeline(root, machine, window);
  add_quality(root, totals);
  return root;
}

MetricGroup measure_stuck(const Machine& machine, const Deadlock& deadlock, const RunTotals& totals,
                          int image_width, int image_height) {
  SteadyWindow window;
  window.text = "until it got stuck";
  MetricGroup root;
  add_run(root, totals, "stuck", sc_core::sc_time_stamp());
  add_input(root, machine, totals, image_width, image_height);
  add_deadlock(root, deadlock);
  add_pipeline(root, machine, window);
  add_quality(root, totals);
  return root;
}

}  // namespace parallax
