// SPDX-License-Identifier: Apache-2.0
#include "platform/results/run_metrics.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "platform/results/energy.hpp"
#include "platform/results/memory_metrics.hpp"
#include "platform/results/pipeline_metrics.hpp"
#include "platform/results/rate_metrics.hpp"
#include "platform/results/result_schema.hpp"
#include "platform/results/version.hpp"

namespace parallax {
namespace {

void add_run(MetricGroup& root, const RunTotals& totals, const std::string& status,
             const sc_core::sc_time& simulated) {
  const MetricWriter out(root, run_table());
  out.add("run/status", status);
  out.add("run/version", std::string(version()));
  out.add("run/revision", std::string(revision()));
  out.add("run/command", totals.command);
  if (totals.scene_seed) out.add("run/seed", fmt::format("{}", *totals.scene_seed));
  out.add("run/wall_time", totals.wall_seconds);
  out.add("run/simulated_time", simulated.to_seconds());
  out.add("run/speed", simulated.to_seconds() / std::max(totals.wall_seconds, 1e-9));
  out.add("run/peak_memory", totals.peak_megabytes);
}

std::int64_t startable_rows(const Machine& machine) {
  const std::int64_t early = machine.config().camera.early_start_rows;
  const std::int64_t all = machine.input().height;
  return early == 0 ? all : std::min(early, all);
}

void add_input(MetricGroup& root, const Machine& machine, const RunTotals& totals, int image_width,
               int image_height) {
  const MetricWriter out(root, run_table());
  out.add("input/width", std::int64_t{image_width});
  out.add("input/height", std::int64_t{image_height});
  out.add("input/processed_width", std::int64_t{machine.input().width});
  out.add("input/processed_height", std::int64_t{machine.input().height});
  out.add("input/startable_rows", startable_rows(machine));
  const DisparityRange range = machine.config().matching.range();
  out.add("input/disparity_range", std::int64_t{range.count});
  out.add("input/disparity_offset", std::int64_t{range.offset});
  out.add("input/frames", machine.finished() ? machine.frames() : machine.input().frames);
  out.add("input/frames_with_images", totals.frames);
}

void add_cameras(MetricGroup& root, const Machine& machine, const CameraCounts& cameras) {
  const MetricWriter out(root, run_table());
  out.add("camera/late_bursts", machine.sensor().late_bursts());
  out.add("camera/triggers", cameras.triggers);
  out.add("camera/taken_frames", cameras.taken);
  out.add("camera/dropped_frames", cameras.dropped);
  out.add("camera/faulty_frames", cameras.faulty);
  out.add("camera/missed_triggers", cameras.missed);
}

void add_software(MetricGroup& root, const Machine& machine, const SteadyWindow& window) {
  const MetricWriter out(root, run_table());
  out.add("software/rejected_starts", machine.rejected_starts());
  const sc_core::sc_time before =
      window.frames() > 0 ? machine.snapshots()[window.first].output_full : sc_core::SC_ZERO_TIME;
  out.over(window.text)
      .add("software/waits_for_output_buffer",
           (machine.snapshots()[window.last].output_full - before).to_seconds() * 1e3 / window.divisor());
}

void add_quality(MetricGroup& root, const RunTotals& totals) {
  root.group("quality");  // there even without images
  const MetricWriter out =
      MetricWriter(root, run_table()).over(fmt::format("{} frames with images", totals.frames));
  if (totals.pixels > 0) {
    out.add("quality/valid_share",
            100.0 * static_cast<double>(totals.valid) / static_cast<double>(totals.pixels));
  }
  if (!totals.has_truth) return;
  for (const Quality& q : totals.score.qualities()) out.add(fmt::format("quality/{}", q.name), q.value);
}

}  // namespace

const MetricTable& run_table() {
  constexpr const char* kImages = "the frames with images";
  static const MetricTable table{
      {"schema/version", "",
       "Version of the names and units in this file: results of the same version can be compared.", ""},
      {"schema/configuration", "",
       "Hash of the configuration: equal for two runs of machines whose keys all have the same values, "
       "however "
       "they were given.",
       ""},
      {"run/status", "", "done, or stuck: the machine came to a halt before all frames were done.", ""},
      {"run/version", "", "Version of the model.", ""},
      {"run/revision", "", "Git revision that the model was built from.", ""},
      {"run/command", "", "Command line that makes the run again, from the same folder.", ""},
      {"run/seed", "", "Seed of the built-in scene, when that was the input.", ""},
      {"run/wall_time", "s", "Time that the run took on this computer.", ""},
      {"run/simulated_time", "s",
       "Time that passed in the modelled machine, until the host had the last frame.", ""},
      {"run/speed", "s/s", "Simulated time per wall-clock time: 1 is as fast as the machine itself.", ""},
      {"run/peak_memory", "MB", "Largest resident memory of the program.", ""},
      {"input/width", "px", "Width of the images as given.", ""},
      {"input/height", "px", "Height of the images as given.", ""},
      {"input/processed_width", "px",
       "Width that the machine works on: that of the images rounded up to image.width_granularity.", ""},
      {"input/processed_height", "px",
       "Height that the machine works on: that of the images rounded up to image.height_granularity.", ""},
      {"input/startable_rows", "rows",
       "Rows of both images that must be in memory before the core can start with a frame: all, or "
       "camera.early_start_rows.",
       ""},
      {"input/disparity_range", "px",
       "Number of disparities searched: matching.parallelism times matching.iterations.", ""},
      {"input/disparity_offset", "px", "Smallest disparity searched.", ""},
      {"input/frames", "frames", "Frames simulated in time, at least --timing-frames.", ""},
      {"input/frames_with_images", "frames",
       "Frames whose images were computed too; the others repeat the traffic alone.", ""},
      {"camera/late_bursts", "bursts",
       "Bursts of the left sensor that found its FIFO full: the memory did not keep up with the read-out.",
       kWholeRun},
      {"camera/triggers", "triggers",
       "Triggers that the cameras were given: those of frames taken, dropped, faulty or missed, and of one "
       "that may be under way.",
       kWholeRun},
      {"camera/taken_frames", "frames", "Frames that found a frame buffer, without the faulty ones.",
       kWholeRun},
      {"camera/dropped_frames", "frames",
       "Frames of cameras with a camera.frame_rate that found no frame buffer free when their read-out "
       "began: "
       "dropped whole.",
       kWholeRun},
      {"camera/faulty_frames", "frames",
       "Frames that a camera.fault spoilt: flagged in the registers and not processed.", kWholeRun},
      {"camera/missed_triggers", "triggers",
       "Triggers that found a sensor still reading out (jitter, or a memory that does not keep up).",
       kWholeRun},
      {"software/rejected_starts", "starts",
       "Starts that the core refused because of what its registers said; software tries again, and each "
       "attempt "
       "counts.",
       kWholeRun},
      {"software/waits_for_output_buffer", "ms",
       "Time a frame in which the core could have been started but for its results, all link.output_buffers "
       "waiting to be sent: the link's back-pressure.",
       kSteadyState},
      {"quality/valid_share", "%", "Pixels of the image that have a disparity (\"valid pixels\").", kImages},
      {"quality/scored_pixels", "px",
       "With ground truth: pixels whose true disparity is known and that the mask selects.", kImages},
      {"quality/valid_pixels", "px", "Scored pixels that have a disparity.", kImages},
      {"quality/coverage", "%", "Scored pixels that have a disparity, as a share of all scored ones.",
       kImages},
      {"quality/mean_error", "px", "Mean absolute error of the scored pixels that have a disparity.",
       kImages},
      {"quality/bad_1", "%",
       "Scored pixels that are off by more than 1 px (\"bad-1\"), of those that have a disparity.", kImages},
      {"quality/bad_1_all", "%", "Scored pixels that are off by more than 1 px or have no disparity.",
       kImages},
      {"quality/bad_2", "%",
       "Scored pixels that are off by more than 2 px (\"bad-2\"), of those that have a disparity.", kImages},
      {"quality/bad_2_all", "%", "Scored pixels that are off by more than 2 px or have no disparity.",
       kImages},
      {"quality/bad_3", "%",
       "Scored pixels that are off by more than 3 px (\"bad-3\"), of those that have a disparity.", kImages},
      {"quality/bad_3_all", "%", "Scored pixels that are off by more than 3 px or have no disparity.",
       kImages},
  };
  return table;
}

MetricGroup measure(const Machine& machine, const RunTotals& totals, int image_width, int image_height) {
  const SteadyWindow window = steady_window(machine);
  MetricGroup root;
  add_schema(root, machine.config());
  add_run(root, totals, "done", machine.snapshots().back().time);
  add_input(root, machine, totals, image_width, image_height);
  add_cameras(root, machine, machine.snapshots().back().cameras);
  add_software(root, machine, window);
  add_rates(root, machine, window);
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
  add_schema(root, machine.config());
  add_run(root, totals, "stuck", sc_core::sc_time_stamp());
  add_input(root, machine, totals, image_width, image_height);
  add_deadlock(root, deadlock);
  add_pipeline(root, machine, window);
  add_quality(root, totals);
  return root;
}

}  // namespace parallax
