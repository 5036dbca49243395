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

// Whole cycles, and shares of one decimal that sum to 100.
void add_stage_time(const MetricWriter& out, const StageStatistics& time) {
  out.add("stages/<stage>/window", time.total().count());
  std::vector<std::int64_t> cycles;
  for (const StageActivity activity : kAllStageActivities) {
    cycles.push_back(time.of(activity).count());
    out.add(fmt::format("stages/<stage>/{}", name_of(activity)), cycles.back());
  }
  const std::vector<std::int64_t> tenths = shares_in_tenths(cycles);
  for (std::size_t i = 0; i < tenths.size(); ++i) {
    out.add(fmt::format("stages/<stage>/{}_share", name_of(kAllStageActivities[i])),
            quotient(tenths[i], 10.0));
  }
}

void add_stream(const MetricWriter& out, const StreamBase& stream) {
  const StreamStatistics& s = stream.statistics();
  const Occupancy& held = stream.occupancy();
  const auto cycles = static_cast<double>(std::max<std::uint64_t>(1, held.total()));
  const auto percent = [cycles](std::uint64_t part) { return 100.0 * static_cast<double>(part) / cycles; };
  out.add("streams/<stream>/depth", std::int64_t{stream.depth()});
  out.add("streams/<stream>/width", stream.width().count());
  out.add("streams/<stream>/writer", stream.writer_name());
  out.add("streams/<stream>/reader", stream.reader_name());
  out.add("streams/<stream>/kind", std::string(name_of(stream.config().kind)));
  out.add("streams/<stream>/tokens", s.written);
  out.add("streams/<stream>/high_water", s.high_water);
  out.add("streams/<stream>/mean_occupancy", held.mean());
  out.add("streams/<stream>/full", percent(held.full()));
  const double never = held.total() == 0 ? 100 : 0;  // a stream without a token
  out.add("streams/<stream>/empty", percent(held.empty()) + never);
  out.add("streams/<stream>/blocked_on_full", s.blocked_on_full.count());
  out.add("streams/<stream>/starved_on_empty", s.starved_on_empty.count());
  std::vector<std::int64_t> bins;
  for (std::size_t bin = 0; bin < held.bins(); ++bin) bins.push_back(held.cycles(bin));
  while (!bins.empty() && bins.back() == 0) bins.pop_back();
  out.add("streams/<stream>/occupancy_bin", held.bin_width());
  out.add("streams/<stream>/occupancy", std::move(bins));
}

// Where data lies in memory between two engines: the machine's way past its streams.
void add_buffers(const MetricWriter& out, const Machine& machine) {
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
    const MetricWriter buffers = out.of(name_of(kind));
    buffers.add("buffers/<buffers>/writer", name(writer));
    buffers.add("buffers/<buffers>/reader", name(reader));
    buffers.add("buffers/<buffers>/number", machine.memory_map().number_of(kind));
  }
}

}  // namespace

const MetricTable& pipeline_table() {
  static const MetricTable table{
      {"stages/<stage>/cycles_per_frame", "cycles",
       "Cycles of a frame without any wait, by the stage's declared intervals.", ""},
      {"stages/<stage>/utilisation", "%",
       "Cycles of a frame without any wait as a share of the frame period; declared overheads of rows and "
       "frames, "
       "which are blanking, are in it.",
       kSteadyState},
      {"stages/<stage>/window", "cycles",
       "Core cycles from the stage's first firing for one frame to that for a later one, over the frames of "
       "the steady state; "
       "for a single frame, the whole run. The six kinds of cycles (busy, starved, blocked, memory, "
       "synchroniser, blanking) "
       "sum to it exactly.",
       kSteadyState},
      {"stages/<stage>/busy", "cycles", "Cycles at work with a token on some port.", kSteadyState},
      {"stages/<stage>/starved", "cycles", "Cycles held back by an empty input from another stage.",
       kSteadyState},
      {"stages/<stage>/blocked", "cycles",
       "Cycles held back by a full output to another stage: back-pressure.", kSteadyState},
      {"stages/<stage>/memory", "cycles",
       "Cycles held back by a stream from or to a memory port, within a frame.", kSteadyState},
      {"stages/<stage>/synchroniser", "cycles",
       "Cycles held back by a token or a slot that is there, but still in the synchroniser of an "
       "asynchronous FIFO.",
       kSteadyState},
      {"stages/<stage>/blanking", "cycles",
       "Cycles of declared row and frame overhead, and, in stages that read from the memory, of waiting for "
       "a "
       "frame's first burst; other stages starve then.",
       kSteadyState},
      {"stages/<stage>/busy_share", "%",
       "Busy cycles as a share of the window; the six shares are rounded to one decimal so that they sum to "
       "100.0, those with "
       "the largest remainders upward.",
       kSteadyState},
      {"stages/<stage>/starved_share", "%", "Starved cycles as a share of the window, rounded likewise.",
       kSteadyState},
      {"stages/<stage>/blocked_share", "%", "Blocked cycles as a share of the window, rounded likewise.",
       kSteadyState},
      {"stages/<stage>/memory_share", "%",
       "Cycles of waiting for the memory as a share of the window, rounded likewise.", kSteadyState},
      {"stages/<stage>/synchroniser_share", "%",
       "Synchroniser cycles as a share of the window, rounded likewise.", kSteadyState},
      {"stages/<stage>/blanking_share", "%", "Blanking cycles as a share of the window, rounded likewise.",
       kSteadyState},
      {"stages/<stage>/storage", "bit",
       "Line buffers, windows and registers that the stage declares, without FIFOs.", ""},
      {"streams/<stream>/depth", "tokens", "Slots of the FIFO.", ""},
      {"streams/<stream>/width", "bit", "Bits of a token.", ""},
      {"streams/<stream>/writer", "", "The module that writes the stream, as its path in the model.", ""},
      {"streams/<stream>/reader", "", "The module that reads the stream, as its path in the model.", ""},
      {"streams/<stream>/kind", "",
       "Which circuit the FIFO is: it fixes how many cycles later a token can be read, and a freed slot "
       "written.",
       ""},
      {"streams/<stream>/tokens", "tokens", "Tokens written.", kWholeRun},
      {"streams/<stream>/high_water", "tokens", "Most tokens held at the end of a cycle.", kWholeRun},
      {"streams/<stream>/mean_occupancy", "tokens",
       "Tokens held on average over the time; a token counts from its writing until its slot can be written "
       "again.",
       kWholeRun},
      {"streams/<stream>/full", "%", "Share of the time without a free slot.", kWholeRun},
      {"streams/<stream>/empty", "%", "Share of the time without a token.", kWholeRun},
      {"streams/<stream>/blocked_on_full", "cycles",
       "Writer's cycles of waits that this FIFO ended: of all that the writer waited for, it had room last.",
       kWholeRun},
      {"streams/<stream>/starved_on_empty", "cycles",
       "Reader's cycles of waits that this FIFO ended: of all that the reader waited for, it had a token "
       "last.",
       kWholeRun},
      {"streams/<stream>/occupancy_bin", "tokens",
       "Fill levels that one bin of the histogram holds together: 1 up to a depth of 64.", ""},
      {"streams/<stream>/occupancy", "cycles",
       "Histogram: writer's cycles at each fill level, from 0 tokens up; bins above the last level that "
       "occurred are left out.",
       kWholeRun},
      {"buffers/<buffers>/writer", "",
       "The engine that fills these buffers in memory: the way of the data past the streams.", ""},
      {"buffers/<buffers>/reader", "", "The engine that empties these buffers.", ""},
      {"buffers/<buffers>/number", "buffers",
       "How many buffers there are, each of one image: camera.frame_buffers, link.output_buffers.", ""},
  };
  return table;
}

void add_pipeline(MetricGroup& root, const Machine& machine, const SteadyWindow& window) {
  const MetricWriter out(root, pipeline_table());
  const std::vector<PartLoad> loads =
      window.frames() == 0 ? std::vector<PartLoad>{} : part_loads(machine, window);
  root.group("stages");  // there even where no stage is
  for (const StageInfo& info : machine.pipeline().stages()) {
    const MetricWriter stage = out.of(info.stage->basename());
    stage.add("stages/<stage>/cycles_per_frame", static_cast<double>(info.cycles_per_frame()));
    stage.over(window.text).add("stages/<stage>/utilisation", 100.0 * share_of(loads, info.stage));
    add_stage_time(stage.over(window.frames() == 0 ? kWholeRun : window.text), stage_time(info, window));
    stage.add("stages/<stage>/storage", info.storage.count());
  }
  root.group("streams");
  for (const StreamBase* stream : machine.dataflow().streams()) {
    if (!stream->inside_stage()) add_stream(out.of(stream->basename()), *stream);
  }
  add_buffers(out, machine);
}

}  // namespace parallax
