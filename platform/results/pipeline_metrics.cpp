// SPDX-License-Identifier: Apache-2.0
#include "platform/results/pipeline_metrics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "platform/results/stage_time.hpp"

namespace parallax {
namespace {

double share_of(const std::vector<PartLoad>& loads, const Stage* stage) {
  const auto found = std::find_if(loads.begin(), loads.end(), [&](const PartLoad& l) {
    return l.part->stage && l.part->stage->stage == stage;
  });
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
  group.add({"writer", stream.writer_name(), "", "The module that writes it.", ""});
  group.add({"reader", stream.reader_name(), "", "The module that reads it.", ""});
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

// Where data lies in memory between two engines: the machine's way past its streams.
void add_buffers(MetricGroup& root, const Machine& machine) {
  for (const BufferKind kind : {BufferKind::kLeft, BufferKind::kRight, BufferKind::kOutput}) {
    const auto engine = [&](MemoryPort::Direction direction) -> const MemoryPort* {
      const auto found = std::find_if(
          machine.ports().begin(), machine.ports().end(),
          [&](const MemoryPort* port) { return port->buffer == kind && port->direction == direction; });
      return found == machine.ports().end() ? nullptr : *found;
    };
    const MemoryPort* const writer = engine(MemoryPort::Direction::kWrites);
    const MemoryPort* const reader = engine(MemoryPort::Direction::kReads);
    if (writer == nullptr || reader == nullptr) continue;  // results stay there: the link is off
    const auto name = [](const MemoryPort* port) {
      return std::string(port->master->get_parent_object()->name());
    };
    MetricGroup& group = root.group("buffers").group(name_of(kind));
    group.add({"writer", name(writer), "", "The module that fills them.", ""});
    group.add({"reader", name(reader), "", "The module that empties them.", ""});
    group.add({"number", static_cast<std::int64_t>(machine.memory_map().number_of(kind)), "buffers",
               "In memory, each of one image.", ""});
  }
}

}  // namespace

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
    group.add({"utilisation", 100.0 * share_of(loads, info.stage), "%", "Of the time.", window.text});
    add_stage_time(group, stage_time(info, window), window.frames() == 0 ? all : window.text);
    group.add({"storage", info.storage.count(), "bit", "Line buffers and the like, without FIFOs.", ""});
  }
  MetricGroup& streams = root.group("streams");
  for (const StreamBase* stream : machine.dataflow().streams()) {
    add_stream(streams.group(stream->basename()), *stream);
  }
  add_buffers(root, machine);
}

}  // namespace parallax
