// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/machine_rows.hpp"

#include <utility>
#include <vector>

#include "modules/area.hpp"

namespace parallax {

MachineRows::MachineRows(const Machine& machine)
    : machine_(machine),
      height_(machine.input().height),
      tiles_(static_cast<std::int32_t>(machine.tiles().tiles.size())),
      row_tokens_(machine.tiles().width / machine.config().timing.pixels_per_token) {
  if (const auto& unpack = machine.map_port().stage) map_words_ = unpack->stage->output_streams(0).front();
  for (const StageInfo& info : machine.pipeline().stages()) {
    for (unsigned port = 0; port < Stage::kMaxPorts; ++port) {
      for (const StreamBase* stream : info.stage->output_streams(port)) {
        add(*stream, info.stage->schedule().produced(port) * info.passes);
      }
    }
  }
}

void MachineRows::add(const StreamBase& stream, std::uint64_t tokens) {
  if (stream.at_memory() || stream.inside_stage()) return;
  const std::uint64_t rows = area(height_, tiles_);
  if (&stream == map_words_) {
    // A word counts for the row that its first byte belongs to.
    const std::uint64_t word = machine_.config().dma.map.data_bits / 8;
    auto ends = std::make_shared<RowEnds>();
    ends->rows_of_a_tile = height_;
    std::uint64_t bytes = 0;
    for (const std::uint32_t row : machine_.map().row_bytes) {
      bytes += row;
      ends->ends.push_back((bytes + word - 1) / word);
    }
    streams_[&stream] = ends;
  } else if (tokens % rows == 0) {
    streams_[&stream] = std::make_shared<const RowEnds>(equal_rows(tokens / rows, height_, tiles_));
  } else if (const std::uint64_t of_a_tile = tokens / tiles_; of_a_tile % row_tokens_ == 0) {
    // Records of the matcher's store, of less rows, or of the rows of two passes.
    streams_[&stream] = std::make_shared<const RowEnds>(
        equal_rows(row_tokens_, static_cast<std::int32_t>(of_a_tile / row_tokens_), tiles_));
  }
}

std::shared_ptr<const RowEnds> MachineRows::of(const StreamBase& stream) const {
  const auto found = streams_.find(&stream);
  return found == streams_.end() ? nullptr : found->second;
}

StagePorts MachineRows::of(const StageInfo& info) const {
  StagePorts ports;
  ports.passes = info.passes;
  const auto port = [&](const std::vector<const StreamBase*>& streams) -> std::optional<StagePorts::RowPort> {
    if (streams.empty() || streams.front() == map_words_) return std::nullopt;
    std::shared_ptr<const RowEnds> rows = of(*streams.front());
    if (!rows) return std::nullopt;
    if (info.passes > 1) {  // a pass is a tile
      auto tile = std::make_shared<RowEnds>(*rows);
      tile->ends.resize(rows->rows_of_a_tile);
      rows = tile;
    }
    return StagePorts::RowPort{0, rows};
  };
  ports.read = port(info.stage->input_streams(0));
  ports.written = port(info.stage->output_streams(0));
  // What is read and what is written are counted together only if they are the same rows.
  if (ports.read && ports.written && ports.read->rows->ends.size() != ports.written->rows->ends.size()) {
    ports.written.reset();
  }
  if (!ports.read && !ports.written && !info.stage->output_streams(0).empty()) {
    // Words of the map: the one stage whose rows differ in length.
    if (const auto rows = of(*info.stage->output_streams(0).front()))
      ports.written = StagePorts::RowPort{0, rows};
  }
  return ports;
}

}  // namespace parallax
