// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/machine_rows.hpp"

#include <numeric>

#include "modules/output_packing.hpp"
#include "modules/pixel_format.hpp"

namespace parallax {
namespace {

// Rows of the given lengths, tile by tile.
std::shared_ptr<RowEnds> rows_of_lengths(const std::vector<std::uint64_t>& lengths,
                                         std::int32_t rows_of_a_tile) {
  auto rows = std::make_shared<RowEnds>();
  rows->rows_of_a_tile = rows_of_a_tile;
  rows->ends.resize(lengths.size());
  std::partial_sum(lengths.begin(), lengths.end(), rows->ends.begin());
  return rows;
}

std::shared_ptr<const RowEnds> shared(RowEnds rows) { return std::make_shared<RowEnds>(std::move(rows)); }

}  // namespace

MachineRows::MachineRows(const Machine& machine)
    : machine_(machine),
      height_(machine.input().height),
      tiles_(static_cast<std::int32_t>(machine.tiles().tiles.size())),
      width_(static_cast<std::uint64_t>(machine.tiles().width)) {
  for (const StageInfo& info : machine.pipeline().stages()) {
    for (unsigned port = 0; port < Stage::kMaxPorts; ++port) {
      for (const StreamBase* stream : info.stage->output_streams(port)) {
        add(*stream, info.stage->schedule().produced(port) * info.passes);
      }
    }
  }
}

void MachineRows::add(const StreamBase& stream, std::uint64_t tokens) {
  if (stream.at_memory()) return;
  const std::uint64_t rows = static_cast<std::uint64_t>(height_) * static_cast<std::uint64_t>(tiles_);
  if (stream.basename() == std::string("map_words")) {
    // A word counts for the row that its first byte belongs to.
    const auto word = static_cast<std::uint64_t>(machine_.config().dma.map.data_bits / 8);
    auto ends = std::make_shared<RowEnds>();
    ends->rows_of_a_tile = height_;
    std::uint64_t bytes = 0;
    for (const std::uint32_t row : machine_.map().row_bytes) {
      bytes += row;
      ends->ends.push_back((bytes + word - 1) / word);
    }
    streams_[&stream] = ends;
  } else if (tokens % rows == 0) {
    streams_[&stream] = shared(equal_rows(tokens / rows, height_, tiles_));
  } else if (const std::uint64_t of_a_tile = tokens / static_cast<std::uint64_t>(tiles_);
             of_a_tile % width_ == 0) {
    // Records of the matcher's store, of less rows, or of the rows of two passes.
    streams_[&stream] = shared(equal_rows(width_, static_cast<std::int32_t>(of_a_tile / width_), tiles_));
  }
}

std::shared_ptr<const RowEnds> MachineRows::of(const StreamBase& stream) const {
  const auto found = streams_.find(&stream);
  return found == streams_.end() ? nullptr : found->second;
}

StagePorts MachineRows::of(const StageInfo& info) const {
  StagePorts ports;
  ports.passes = static_cast<std::int64_t>(info.passes);
  const auto port = [&](const std::vector<const StreamBase*>& streams) -> std::optional<StagePorts::Port> {
    if (streams.empty() || streams.front()->basename() == std::string("map_words")) return std::nullopt;
    std::shared_ptr<const RowEnds> rows = of(*streams.front());
    if (!rows) return std::nullopt;
    if (info.passes > 1) {  // a pass is a tile
      auto tile = std::make_shared<RowEnds>(*rows);
      tile->ends.resize(static_cast<std::size_t>(rows->rows_of_a_tile));
      rows = tile;
    }
    return StagePorts::Port{0, rows};
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
      ports.written = StagePorts::Port{0, rows};
  }
  return ports;
}

std::shared_ptr<const RowEnds> MachineRows::of(const Machine::Port& port) const {
  const MachineConfig& config = machine_.config();
  const PixelFormat format = config.camera.format;
  const OutputLeft left = config.link.output_left();
  const auto row = static_cast<std::uint64_t>(machine_.input().width);
  const auto height = static_cast<std::size_t>(height_);
  if (port.name == "camera_left" || port.name == "camera_right") {
    return shared(equal_rows(bytes_of(format, row), height_, 1));
  }
  if (port.name == "left" || port.name == "right") {
    return shared(equal_rows(bytes_of(format, width_), height_, tiles_));
  }
  if (port.name == "map") {
    const std::vector<std::uint32_t>& bytes = machine_.map().row_bytes;
    return rows_of_lengths({bytes.begin(), bytes.end()}, height_);
  }
  if (port.name == "link")
    return shared(equal_rows(OutputPacking::row_bytes(machine_.input().width, left), height_, 1));
  std::vector<std::uint64_t> lengths;
  const MatcherStore& store = machine_.pipeline().store();
  for (const Tile& tile : machine_.tiles().tiles) {
    if (port.name == "output") {
      lengths.insert(lengths.end(), height, OutputPacking::row_bytes(tile.keep_end - tile.keep_begin, left));
      continue;
    }
    const StoreLayout& layout = port.name.rfind("buffer_frame", 0) == 0 ? store.frame : store.rows;
    for (const StoreLayout::Pass& pass : layout.passes) {
      if (pass.record_bytes > 0) lengths.insert(lengths.end(), pass.rows, layout.row_bytes(pass));
    }
  }
  return rows_of_lengths(lengths, static_cast<std::int32_t>(lengths.size()) / tiles_);
}

}  // namespace parallax
