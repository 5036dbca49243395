// SPDX-License-Identifier: Apache-2.0
#include "platform/results/run_metrics.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "platform/machine_rows.hpp"
#include "platform/results/energy.hpp"
#include "platform/results/limits.hpp"
#include "platform/results/stage_time.hpp"
#include "platform/version.hpp"

namespace parallax {
namespace {

double seconds(const sc_core::sc_time& time) { return time.to_seconds(); }

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
  for (std::size_t i = 0; i < frame_spans().size(); ++i) {
    const FrameSpan& span = frame_spans()[i];
    const LatencyHistogram& steady = latencies.steady(i);
    const auto add = [&](const char* what, const sc_core::sc_time& time, const std::string& frames) {
      group.add({fmt::format("{}_{}", span.name, what), seconds(time) * 1e3, "ms", span.description, frames});
    };
    add("first_frame", span.of(latencies.first_frame()), "frame 1");
    add("mean", steady.mean(), window.text);
    add("p50", steady.percentile(0.5), window.text);
    add("p95", steady.percentile(0.95), window.text);
    add("p99", steady.percentile(0.99), window.text);
    add("largest", steady.largest(), window.text);
  }
}

void add_limit(MetricGroup& root, const Machine& machine, const SteadyWindow& window) {
  if (window.frames() == 0) return;
  const std::vector<PartLoad> all = part_loads(machine, window);
  const LimitVerdict verdict = find_limit(all);
  MetricGroup& group = root.group("limit");
  group.add(
      {"part", verdict.limited ? verdict.busiest.part : "none", "",
       "The part that is at work all the time; of several, the first that the data meets. none: no part is.",
       window.text});
  group.add({"key", verdict.limited ? verdict.busiest.key : verdict.otherwise, "",
             "The configuration keys that move this limit.", window.text});
  group.add({"utilisation", 100.0 * verdict.busiest.share, "%",
             "Share of the time in which the busiest part is at work.", window.text});
  const PartLoad& next = verdict.limited ? verdict.next : verdict.busiest;
  group.add({"next_part", next.part, "", "The part that would limit if this one did not.", window.text});
  group.add({"next_frame_rate", 1.0 / next.busy, "frames/s", "The rate at which it would.", window.text});
  MetricGroup& parts = group.group("utilisation_by_part");
  for (const PartLoad& load : all) {
    parts.add(
        {load.part, 100.0 * load.share, "%", "Share of the time in which the part is at work.", window.text});
  }
}

// Cycles in which a port of the core held up the stage at its other end.
void add_stalls(MetricGroup& memory, const Machine& machine, const SteadyWindow& window) {
  const double frames = static_cast<double>(std::max<std::size_t>(1, window.frames()));
  for (const auto& [port, stage] :
       {std::pair{"left", "unpack_left"}, std::pair{"right", "unpack_right"}, std::pair{"map", "unpack_map"},
        std::pair{"output", "output_packing"}, std::pair{"buffer_row_write", "pack_rows"},
        std::pair{"buffer_row_read", "unpack_rows"}, std::pair{"buffer_frame_write", "pack_frame"},
        std::pair{"buffer_frame_read", "unpack_frame"}}) {
    for (const StageInfo& info : machine.pipeline().stages()) {
      if (info.stage->basename() != std::string(stage)) continue;
      memory.group(port).add(
          {"stalls", static_cast<double>(stage_time(info, window).memory.count()) / frames, "cycles",
           "Core cycles a frame in which this port held back the stage next to it.", window.text});
    }
  }
}

void add_port(MetricGroup& group, const BusMaster& port, const SteadyWindow& window, double bytes_per_frame,
              double bytes_per_second) {
  const std::string all = "the whole run";
  group.add({"bytes_per_frame", bytes_per_frame, "B", "Bytes through the port, a frame.", window.text});
  group.add({"bandwidth", bytes_per_second / 1e6, "MB/s", "Bytes through the port by time.", window.text});
  const LatencyHistogram& latencies = port.latencies();
  const auto latency = [&](const char* name, const sc_core::sc_time& time, const char* description) {
    group.add({name, seconds(time) * 1e9, "ns", description, all});
  };
  latency("latency_mean", latencies.mean(), "From request to answer of a burst.");
  latency("latency_p50", latencies.percentile(0.5), "Half of the bursts are answered in this time (+1.6 %).");
  latency("latency_p95", latencies.percentile(0.95),
          "95 % of the bursts are answered in this time (+1.6 %).");
  latency("latency_p99", latencies.percentile(0.99),
          "99 % of the bursts are answered in this time (+1.6 %).");
  latency("latency_largest", latencies.largest(), "From request to answer of a burst.");
}

void add_dram(MetricGroup& memory, const DramStatistics& first, const DramStatistics& last,
              const SteadyWindow& window) {
  const auto per_frame = [&](const char* name, std::uint64_t from, std::uint64_t to, const char* unit,
                             const char* description) {
    memory.add(
        {name,
         static_cast<double>(to - from) / static_cast<double>(std::max<std::size_t>(1, window.frames())),
         unit, description, window.text});
  };
  const auto bursts = static_cast<double>(last.reads + last.writes - first.reads - first.writes);
  memory.add(
      {"row_hits",
       // A refresh may close a row before its burst has come: there may be more rows opened than bursts.
       bursts == 0
           ? 0
           : 100.0 * std::max(0.0, 1.0 - static_cast<double>(last.activates - first.activates) / bursts),
       "%", "DRAM bursts that opened no row.", window.text});
  per_frame("bursts", first.reads + first.writes, last.reads + last.writes, "bursts",
            "DRAM bursts, a frame.");
  per_frame("activates", first.activates, last.activates, "rows", "DRAM rows opened, a frame.");
  per_frame("refreshes", first.refreshes, last.refreshes, "refreshes",
            "DRAM refreshes of all banks, a frame.");
  per_frame("turn_arounds", first.turn_arounds, last.turn_arounds, "turns",
            "Changes of the DRAM's data bus between reading and writing, a frame.");
}

void add_memory(MetricGroup& root, const Machine& machine, const SteadyWindow& window) {
  MetricGroup& memory = root.group("memory");
  const Memory* model = machine.memory();
  const std::vector<Machine::Port>& ports = machine.ports();
  Activity first;  // the beginning of the run
  first.ports.resize(ports.size());
  if (window.frames() > 0) first = machine.activities()[window.first];
  const Activity& last = machine.activities()[window.last];
  const double elapsed = seconds(last.time - first.time);
  const auto share = [&](Cycles taken) {
    const Cycles cycles = model->cycle_at_or_after(last.time) - model->cycle_at_or_after(first.time);
    return 100.0 * (static_cast<double>(taken.count()) /
                    static_cast<double>(std::max<std::int64_t>(1, cycles.count())));
  };
  const MachineRows rows(machine);
  std::uint64_t total = 0;
  Cycles total_bus;  // whole cycles, so that a bus that is always taken is so for 100 %
  for (std::size_t id = 0; id < ports.size(); ++id) {
    MetricGroup& group = memory.group(ports[id].name);
    const std::uint64_t bytes = last.ports[id].bytes - first.ports[id].bytes;
    const Cycles bus = last.ports[id].bus - first.ports[id].bus;
    total += bytes;
    total_bus += bus;
    // After a single frame, the next one's traffic has begun.
    const double per_frame = window.frames() == 0
                                 ? static_cast<double>(rows.of(ports[id])->frame())
                                 : static_cast<double>(bytes) / static_cast<double>(window.frames());
    add_port(group, *ports[id].master, window, per_frame,
             elapsed == 0 ? 0 : static_cast<double>(bytes) / elapsed);
    if (model != nullptr) {
      group.add(
          {"share", share(bus), "%", "Time in which the memory's bus was taken for the port.", window.text});
    }
  }
  add_stalls(memory, machine, window);
  const EncodedMap& map = machine.map();
  memory.group("map").add({"bytes_per_pixel_and_image", map.bytes_per_pixel(), "B",
                           "Compressed size of the rectification map by pixels of both images.", ""});
  memory.add({"bandwidth", elapsed == 0 ? 0 : static_cast<double>(total) / elapsed / 1e6, "MB/s",
              "Of all ports together.", window.text});
  if (model == nullptr) return;
  memory.add({"usable_bandwidth", model->usable_bandwidth() / 1e6, "MB/s", "Peak times efficiency.", ""});
  memory.add({"share", share(total_bus), "%", "Time in which the memory's bus was taken.", window.text});
  memory.add({"at_work", share(last.memory - first.memory), "%",
              "Time in which the memory was at work: its bus taken, or, in a DRAM, rows opened, the bus "
              "turned around "
              "or refreshes waited for.",
              window.text});
  if (machine.config().memory.model == MemoryModel::kDram) add_dram(memory, first.dram, last.dram, window);
}

double share_of(const std::vector<PartLoad>& loads, const std::string& part) {
  const auto found =
      std::find_if(loads.begin(), loads.end(), [&](const PartLoad& l) { return l.part == part; });
  return found == loads.end() ? 0 : found->share;
}

const char* description_of(StageActivity activity) {
  switch (activity) {
    case StageActivity::kBusy:
      return "At work with a token on some port.";
    case StageActivity::kStarved:
      return "Held back by an empty input from another stage.";
    case StageActivity::kBlocked:
      return "Held back by a full output to another stage (back-pressure).";
    case StageActivity::kMemory:
      return "Held back by a stream from or to a memory port, within a frame.";
    case StageActivity::kSynchroniser:
      return "Held back by a token or a place that is there, but still in an asynchronous FIFO's "
             "synchroniser.";
    case StageActivity::kBlanking:
      return "Declared row and frame overhead, and waiting for a frame to begin.";
  }
  return "";
}

// Whole cycles, and shares of one decimal that sum to 100.
void add_stage_time(MetricGroup& group, const StageStatistics& time, const std::string& window) {
  group.add(
      {"window", time.total().count(), "cycles",
       "From the stage's first firing for the window's first frame to that for its last: the sum of the six "
       "below.",
       window});
  std::vector<std::int64_t> cycles;
  for (const StageActivity activity : kAllStageActivities) {
    cycles.push_back(time.of(activity).count());
    group.add({name_of(activity), cycles.back(), "cycles", description_of(activity), window});
  }
  const std::vector<std::int64_t> tenths = shares_in_tenths(cycles);
  for (std::size_t i = 0; i < tenths.size(); ++i) {
    group.add({fmt::format("{}_share", name_of(kAllStageActivities[i])),
               static_cast<double>(tenths[i]) / 10.0, "%",
               "The same as a share of the window; the six are rounded so that they sum to 100.0.", window});
  }
}

void add_stream(MetricGroup& group, const StreamBase& stream) {
  const std::string all = "the whole run";
  const StreamStatistics& s = stream.statistics();
  const Occupancy& held = stream.occupancy();
  const auto cycles = static_cast<double>(std::max<std::uint64_t>(1, held.total()));
  const auto percent = [cycles](std::uint64_t part) { return 100.0 * static_cast<double>(part) / cycles; };
  group.add({"depth", std::int64_t{stream.depth()}, "tokens", "Places of the FIFO.", ""});
  group.add({"width", stream.width().count(), "bit", "Of a token.", ""});
  group.add({"kind", std::string(name_of(stream.config().kind)), "",
             "Which circuit the FIFO is: it fixes by how many cycles tokens and places are delayed.", ""});
  group.add({"tokens", static_cast<std::int64_t>(s.written), "tokens", "Written.", all});
  group.add({"high_water", static_cast<std::int64_t>(s.high_water), "tokens", "Largest number held.", all});
  group.add({"mean_occupancy", held.mean(), "tokens", "Held on average over the time.", all});
  group.add({"full", percent(held.full()), "%", "Share of the time without a free place.", all});
  const double never = held.total() == 0 ? 100 : 0;  // a stream without a token
  group.add({"empty", percent(held.empty()) + never, "%", "Share of the time without a token.", all});
  group.add({"blocked_on_full", s.blocked_on_full.count(), "cycles",
             "Writer's cycles in which this FIFO alone held it back, being full.", all});
  group.add({"starved_on_empty", s.starved_on_empty.count(), "cycles",
             "Reader's cycles in which this FIFO alone held it back, being empty.", all});
  std::vector<std::int64_t> bins;
  for (std::size_t bin = 0; bin < held.bins(); ++bin)
    bins.push_back(static_cast<std::int64_t>(held.cycles(bin)));
  while (!bins.empty() && bins.back() == 0) bins.pop_back();
  group.add({"occupancy_bin", static_cast<std::int64_t>(held.bin_width()), "tokens",
             "Levels in a bin of the histogram.", ""});
  group.add(
      {"occupancy", std::move(bins), "cycles",
       "Writer's cycles at each level, from 0 tokens up, occupancy_bin levels together; bins above the last "
       "that occurred are left out.",
       all});
}

void add_pipeline(MetricGroup& root, const Machine& machine, const SteadyWindow& window) {
  const std::string all = "the whole run";
  const std::vector<PartLoad> loads =
      window.frames() == 0 ? std::vector<PartLoad>{} : part_loads(machine, window);
  MetricGroup& stages = root.group("stages");
  for (const StageInfo& info : machine.pipeline().stages()) {
    MetricGroup& group = stages.group(info.stage->basename());
    const double cycles = static_cast<double>(info.cycles_per_frame());
    group.add({"cycles_per_frame", cycles, "cycles",
               "Cycles of a frame without any wait, by the declared intervals.", ""});
    group.add(
        {"utilisation", 100.0 * share_of(loads, info.stage->basename()), "%", "Of the time.", window.text});
    add_stage_time(group, stage_time(info, window), window.frames() == 0 ? all : window.text);
    group.add({"storage", info.storage.count(), "bit", "Line buffers and the like, without FIFOs.", ""});
  }
  MetricGroup& streams = root.group("streams");
  for (const StreamBase* stream : machine.dataflow().streams()) {
    add_stream(streams.group(stream->basename()), *stream);
  }
}

}  // namespace

void add_verdict(MetricGroup& root, const std::string& sentence, const RelaxedLimits& limits) {
  MetricGroup& group = root.group("limit");
  const std::string window = "a run of the machine without that limit";
  group.add({"verdict", sentence, "", "What limits, and what taking it away would gain.", window});
  const RelaxedLimit* const found = limits.limit();
  group.add({"relaxation", found == nullptr ? std::string("none") : found->relaxation.name, "",
             "The limit that gains most when it alone is taken away, of those that were tried.", window});
  group.add({"relaxed_frame_rate", found == nullptr ? limits.frame_rate : found->frame_rate, "frames/s",
             "Frame rate without it.", window});
  group.add({"relaxed_part", found == nullptr ? std::string("none") : found->next_part, "",
             "The part that limits then.", window});
}

MetricGroup measure(const Machine& machine, const RunTotals& totals, int image_width, int image_height) {
  const SteadyWindow window = steady_window(machine);
  const std::string with_images = fmt::format("{} frames with images", totals.frames);
  MetricGroup root;

  MetricGroup& run = root.group("run");
  run.add({"version", std::string(version()), "", "Of the model.", ""});
  run.add({"revision", std::string(revision()), "", "Git revision that the model was built from.", ""});
  run.add({"command", totals.command, "", "Makes this run again, from the same folder.", ""});
  if (totals.scene_seed) {
    run.add({"seed", fmt::format("{}", *totals.scene_seed), "", "Of the built-in scene.", ""});
  }
  run.add({"wall_time", totals.wall_seconds, "s", "Time that the run took on this computer.", ""});
  run.add({"simulated_time", seconds(machine.activities().back().time), "s", "Time of the modelled machine.",
           ""});
  run.add({"speed", seconds(machine.activities().back().time) / std::max(totals.wall_seconds, 1e-9), "s/s",
           "Simulated time per wall-clock time.", ""});
  run.add({"peak_memory", totals.peak_megabytes, "MB", "Largest resident size of the program.", ""});

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

  MetricGroup& camera = root.group("camera");
  camera.add(
      {"late_bursts", static_cast<std::int64_t>(machine.sensor().late_bursts()), "bursts",
       "Bursts of the left sensor that found its FIFO full: the memory did not keep up with the read-out.",
       "the whole run"});
  const CameraCounts& cameras = machine.activities().back().cameras;
  camera.add({"triggers", cameras.triggers, "triggers", "That the cameras were given.", "the whole run"});
  camera.add({"taken_frames", cameras.taken, "frames",
              "Frames that found a frame buffer, without the faulty ones.", "the whole run"});
  camera.add({"dropped_frames", cameras.dropped, "frames", "Frames that found no frame buffer free.",
              "the whole run"});
  camera.add({"faulty_frames", cameras.faulty, "frames",
              "Frames that a camera fault spoilt, flagged and not processed.", "the whole run"});
  camera.add({"missed_triggers", cameras.missed, "triggers", "Triggers that found a sensor reading out.",
              "the whole run"});
  root.group("software")
      .add({"rejected_starts", machine.rejected_starts(), "starts",
            "Frames that the core did not take at once because of what its registers said.",
            "the whole run"});
  const sc_core::sc_time before =
      window.frames() > 0 ? machine.activities()[window.first].output_full : sc_core::SC_ZERO_TIME;
  root.group("software")
      .add({"waits_for_output_buffer",
            seconds(machine.activities()[window.last].output_full - before) * 1e3 /
                static_cast<double>(std::max<std::size_t>(1, window.frames())),
            "ms",
            "Time a frame in which the core could have been started but for its results: all buffers waited "
            "to be sent.",
            window.text});
  add_performance(root, machine, window);
  add_latency(root, machine, window);
  add_limit(root, machine, window);
  add_memory(root, machine, window);
  add_energy(root, estimate_energy(machine.config().energy, energy_activity(machine, window)), window.text);
  add_pipeline(root, machine, window);

  MetricGroup& quality = root.group("quality");
  if (totals.pixels > 0) {
    quality.add({"valid_share",
                 100.0 * static_cast<double>(totals.valid) / static_cast<double>(totals.pixels), "%",
                 "Pixels of the image that have a disparity.", with_images});
  }
  if (totals.has_truth) {
    for (const Quality& q : totals.evaluation.qualities()) {
      quality.add({q.name, q.value, q.unit, q.description, with_images});
    }
  }
  return root;
}

}  // namespace parallax
