// SPDX-License-Identifier: Apache-2.0
#include "traces/recorder.hpp"

#include <limits>
#include <utility>

namespace parallax {
namespace {

Picoseconds now() { return Picoseconds(sc_core::sc_time_stamp().value()); }

}  // namespace

Recorder::Recorder(const sc_core::sc_module_name& name, const RecorderConfig& config, Dataflow& dataflow,
                   SamplingTimer& timer, std::function<void()> add_parts)
    : sc_module(name), config_(config), dataflow_(dataflow), add_parts_(std::move(add_parts)) {
  parts_.rows = config.rows;
  parts_.tiles = config.tiles;
  parts_.frames = config.frames;
  parts_.tokens = config.tokens;
  timer.add(config.period, [this] { go_on(); });
}

void Recorder::add(StreamBase& stream, const std::shared_ptr<const RowEnds>& rows) {
  const auto id = static_cast<PartId>(parts_.streams.size());
  TraceParts::StreamPart part;
  part.name = stream.basename();
  part.path = stream.name();
  part.depth = stream.depth();
  part.width = stream.width().count();
  part.write_cycle = stream.writer_clock().date_of(Cycles(1));
  part.read_cycle = stream.reader_clock().date_of(Cycles(1));
  parts_.streams.push_back(part);
  stream_ids_[&stream] = id;
  streams_.push_back(&stream);
  fifos_.emplace_back(stream, id, rows, config_.window, sinks_);
  if (config_.tokens) tokens_.emplace_back(stream, id, rows, config_.window, sinks_);
}

void Recorder::add(Stage& stage, const StagePorts& ports) {
  const auto id = static_cast<PartId>(parts_.stages.size());
  parts_.stages.push_back({stage.basename(), stage.name()});
  stages_.emplace_back(
      stage, id, ports, config_.window, config_.tokens,
      [this](const StreamBase* stream) { return id_of(stream); }, sinks_);
}

void Recorder::add(BusMaster& master, const std::string& name, const std::shared_ptr<const RowEnds>& rows) {
  const auto id = static_cast<PartId>(parts_.ports.size());
  parts_.ports.push_back({name, master.name()});
  ports_.emplace_back(master, id, rows, config_.window, config_.tokens, sinks_);
}

PartId Recorder::id_of(const StreamBase* stream) const {
  const auto found = stream_ids_.find(stream);
  return found == stream_ids_.end() ? kNoPart : found->second;
}

void Recorder::frame_step(std::int64_t frame, FrameStep step) {
  if (!config_.window.contains({frame, 0, 0}, now(), now())) return;
  for (TraceSink* sink : sinks_) sink->frame_step(frame, step, now());
}

void Recorder::frame(const FrameRecord& record) {
  const Picoseconds begin = record.at[0];
  if (!config_.window.contains({record.frame, 0, 0}, begin, now())) return;
  for (TraceSink* sink : sinks_) sink->frame(record);
}

void Recorder::start_of_simulation() {
  add_parts_();
  for (std::size_t i = 0; i < streams_.size(); ++i) {
    parts_.streams[i].writer = streams_[i]->writer_name();
    parts_.streams[i].reader = streams_[i]->reader_name();
  }
  for (TraceSink* sink : sinks_) sink->begin(parts_);
}

void Recorder::go_on() {
  for (FifoTrace& fifo : fifos_) fifo.sample();
  // Streams that are in a leap tell of their tokens when it has come to an end, or when they are asked.
  if (config_.tokens) dataflow_.bring_up_to_date();
  // Events of rows are few: to look for them costs more than to keep some.
  if (config_.tokens || ++looks_ % kLooksBetween == 0) tell_until(now());
}

void Recorder::tell_until(Picoseconds date) {
  for (TokenTrace& tokens : tokens_) tokens.known_until(date);
  for (PortTrace& port : ports_) port.known_until(date);
  for (TraceSink* sink : sinks_) sink->known_until(date);
}

void Recorder::finish(const std::vector<EndlessWait>& waits) {
  dataflow_.bring_up_to_date();
  for (StageTrace& stage : stages_) stage.finish();
  for (FifoTrace& fifo : fifos_) fifo.finish();
  for (PortTrace& port : ports_) port.finish();
  tell_until(Picoseconds(std::numeric_limits<std::int64_t>::max()));
  for (TraceSink* sink : sinks_) sink->end(now(), waits);
}

}  // namespace parallax
