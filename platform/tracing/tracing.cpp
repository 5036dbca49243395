// SPDX-License-Identifier: Apache-2.0
#include "platform/tracing/tracing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "platform/config/nearest_name.hpp"
#include "platform/machine/machine_rows.hpp"
#include "tlm/error.hpp"
#include "tlm/units.hpp"
#include "traces/csv_trace.hpp"
#include "traces/date_order.hpp"
#include "traces/json_trace.hpp"
#include "traces/perfetto_trace.hpp"
#include "traces/vcd_trace.hpp"

namespace parallax {
namespace {

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> names;
  std::istringstream in(text);
  for (std::string name; std::getline(in, name, ',');) names.push_back(name);
  return names;
}

Picoseconds date(const sc_core::sc_time& time) { return Picoseconds(time.value()); }

// As often as a row takes at the pace of the slowest stage.
sc_core::sc_time row_time(const Machine& machine) {
  double longest = 0;
  for (const StageInfo& info : machine.pipeline().stages()) {
    longest = std::max(longest, info.stage->clock().seconds(Cycles(info.cycles_per_frame())));
  }
  return sc_core::sc_time(longest / machine.input().height, sc_core::SC_SEC);
}

RecorderConfig recorder_config(const TraceChoice& choice, const Machine& machine) {
  const MachineInput& input = machine.input();
  choice.window.check(input.least_frames > 0 ? input.least_frames : input.frames, input.height);
  RecorderConfig config;
  config.window = choice.window;
  config.tokens = choice.tokens;
  config.rows = machine.input().height;
  config.tiles = static_cast<std::int32_t>(machine.tiles().tiles.size());
  config.frames = machine.input().frames;
  config.period = row_time(machine);
  return config;
}

const std::vector<std::string>& checked_parts(const std::vector<std::string>& parts, const Machine& machine) {
  std::vector<std::string> names;
  for (const StageInfo& info : machine.pipeline().stages()) names.emplace_back(info.stage->basename());
  for (const MemoryPort* port : machine.ports()) names.push_back(port->name);
  for (const std::string& part : parts) {
    if (std::find(names.begin(), names.end(), part) == names.end()) {
      throw UserError(fmt::format("--trace-parts: there is no stage or memory port '{}'; the nearest is {}",
                                  excerpt(part), nearest_name(part, names)));
    }
  }
  return parts;
}

}  // namespace

TraceChoice read_trace_options(const TraceOptions& options) {
  static const std::vector<std::string> formats{"perfetto", "vcd", "csv", "json"};
  TraceChoice choice;
  for (const std::string& format : split(options.formats)) {
    if (std::find(formats.begin(), formats.end(), format) == formats.end()) {
      throw UserError(
          fmt::format("--trace {}: there is no format '{}'; there are perfetto, vcd, csv and json",
                      excerpt(options.formats), excerpt(format)));
    }
    if (std::find(choice.formats.begin(), choice.formats.end(), format) == choice.formats.end()) {
      choice.formats.push_back(format);
    }
  }
  if (!options.level.empty() && options.level != "rows" && options.level != "tokens") {
    throw UserError(fmt::format("--trace-level {}: must be rows or tokens", excerpt(options.level)));
  }
  choice.tokens = options.level == "tokens";
  if (!options.from.empty()) choice.window.from = read_trace_bound("--trace-from", options.from);
  if (!options.to.empty()) choice.window.to = read_trace_bound("--trace-to", options.to);
  if (choice.tokens && !choice.window.bounded()) {
    throw UserError(
        "--trace-level tokens wants a window, as each frame has some ten million events: --trace-from, "
        "--trace-to");
  }
  choice.parts = split(options.parts);
  return choice;
}

Tracing::Tracing(const TraceChoice& choice, const Machine& machine, SamplingTimer& timer,
                 OutputFolder& folder)
    : machine_(machine),
      wanted_(checked_parts(choice.parts, machine)),
      window_(choice.window),
      recorder_("recorder", recorder_config(choice, machine), const_cast<Dataflow&>(machine.dataflow()),
                timer, [this] { add_parts(); }) {
  for (const std::string& format : choice.formats) {
    // A fault ends the simulation, and is thrown by finish(): the kernel would lose its line.
    auto sink = std::make_unique<DateOrder>(make_sink(format, folder));
    sinks_.push_back(std::make_unique<SinkThread>(std::move(sink), [this] {
      if (!std::exchange(stopping_, true)) sc_core::sc_stop();
    }));
    recorder_.add(*sinks_.back());
  }
}

ByteSink Tracing::file(OutputFolder& folder, const std::string& name) {
  OutputFile& out = folder.open(name);
  return [&out](std::string_view bytes) { out.write(bytes); };
}

std::unique_ptr<TraceSink> Tracing::make_sink(const std::string& format, OutputFolder& folder) {
  if (format == "csv") {
    return std::make_unique<CsvTrace>(
        [&folder](const std::string& table) { return file(folder, "trace_" + table + ".csv"); });
  }
  if (format == "json") return std::make_unique<JsonTrace>(file(folder, "trace.json"));
  if (format == "vcd") return std::make_unique<VcdTrace>(file(folder, "trace.vcd"));
  return std::make_unique<PerfettoTrace>(file(folder, "trace.pftrace"));
}

Tracing::~Tracing() = default;

void Tracing::add_parts() {
  const std::vector<StageInfo> stages = machine_.pipeline().stages();
  const auto is_wanted = [&](const std::string& name) {
    return wanted_.empty() || std::find(wanted_.begin(), wanted_.end(), name) != wanted_.end();
  };
  const MachineRows rows(machine_);
  // A stage's streams come with it.
  for (StreamBase* stream : machine_.dataflow().streams()) {
    if (stream->inside_stage()) continue;
    const bool touched = std::any_of(stages.begin(), stages.end(), [&](const StageInfo& info) {
      if (!is_wanted(info.stage->basename())) return false;
      for (unsigned port = 0; port < Stage::kMaxPorts; ++port) {
        for (const auto& bound : {info.stage->input_streams(port), info.stage->output_streams(port)}) {
          if (std::find(bound.begin(), bound.end(), stream) != bound.end()) return true;
        }
      }
      return false;
    });
    if (touched || wanted_.empty()) recorder_.add(*stream, rows.of(*stream));
  }
  for (const StageInfo& info : stages) {
    if (is_wanted(info.stage->basename())) recorder_.add(const_cast<Stage&>(*info.stage), rows.of(info));
  }
  for (const MemoryPort* port : machine_.ports()) {
    if (is_wanted(port->name)) recorder_.add(*port->master, port->name, port->rows);
  }
}

void Tracing::delivered(std::int64_t frame) {
  const FrameTimes& times = machine_.times()[frame];
  FrameRecord record;
  record.frame = frame;
  const auto at = [&record](FrameStep step) -> Picoseconds& { return record.at[index_of(step)]; };
  at(FrameStep::kExposed) = date(times.exposed);
  at(FrameStep::kFirstByte) = date(times.first_byte);
  at(FrameStep::kStartable) = date(times.startable);
  at(FrameStep::kInMemory) = date(times.in_memory);
  at(FrameStep::kCoreStarted) = date(times.core_started);
  at(FrameStep::kFirstDisparity) = date(times.first_disparity);
  at(FrameStep::kLastDisparity) = date(times.last_disparity);
  at(FrameStep::kResultsInMemory) = date(times.results_in_memory);
  at(FrameStep::kAtHost) = date(times.at_host);
  recorder_.frame(record);
}

void Tracing::finish() {
  for (const std::unique_ptr<SinkThread>& sink : sinks_) sink->check();
  std::vector<EndlessWait> waits;
  if (!machine_.finished()) {
    for (const Wait& wait : machine_.dataflow().waits()) {
      waits.push_back({wait.waiter, wait.stream->basename(), wait.on_full, wait.stream->depth()});
    }
  }
  recorder_.finish(waits);
  const Picoseconds end = date(sc_core::sc_time_stamp());
  if (window_.from && window_.from->time && *window_.from->time >= end) {
    throw UserError(fmt::format("--trace-from: {} us is after the run's end, {} us",
                                static_cast<double>(window_.from->time->count()) * 1e-6, end.real() * 1e-6));
  }
}

}  // namespace parallax
