// SPDX-License-Identifier: Apache-2.0
// The stereo core as others see it: its memory ports, its parts, and what its registers take for granted.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

#include "modules/output_packing.hpp"
#include "platform/machine/stereo_core.hpp"

namespace parallax {
namespace {

std::shared_ptr<const RowEnds> shared(RowEnds rows) {
  return std::make_shared<const RowEnds>(std::move(rows));
}

// The same rows for each of several tiles.
std::shared_ptr<const RowEnds> rows_of_tiles(const StoreLayout& layout, std::size_t tiles) {
  std::vector<std::uint64_t> of_a_tile;
  for (const StoreLayout::Pass& pass : layout.passes) {
    if (pass.record_bytes > 0) of_a_tile.insert(of_a_tile.end(), pass.rows, layout.row_bytes(pass));
  }
  std::vector<std::uint64_t> all;
  for (std::size_t tile = 0; tile < tiles; ++tile) all.insert(all.end(), of_a_tile.begin(), of_a_tile.end());
  return shared(rows_of_lengths(all, static_cast<std::int32_t>(of_a_tile.size())));
}

}  // namespace

// Which buffers the ports fill and empty, and where rows end in their bytes.
void StereoCore::describe_ports() {
  const std::vector<Tile>& tiles = input_.tiles.tiles;
  const std::uint64_t image_row = bytes_of(format_, input_.tiles.width);
  left_port_.buffer = BufferKind::kLeft;
  right_port_.buffer = BufferKind::kRight;
  output_port_.buffer = BufferKind::kOutput;
  left_port_.rows = shared(equal_rows(image_row, run_.height, static_cast<std::int32_t>(tiles.size())));
  right_port_.rows = left_port_.rows;
  const std::vector<std::uint32_t>& map_rows = input_.map.row_bytes;
  map_port_.rows = shared(rows_of_lengths({map_rows.begin(), map_rows.end()}, run_.height));
  std::vector<std::uint64_t> output_rows;
  for (const Tile& tile : tiles) {
    const DmaJob job = output_job(tile);
    output_rows.insert(output_rows.end(), job.row_bytes.begin(), job.row_bytes.end());
  }
  output_port_.rows = shared(rows_of_lengths(output_rows, run_.height));
  const auto describe = [&](const std::unique_ptr<StoreEngines>& engines, const StoreLayout& layout) {
    if (!engines) return;
    for (MemoryPort* port : {&engines->write_port, &engines->read_port}) {
      port->rows = rows_of_tiles(layout, tiles.size());
      port->relieved_by.insert(port->relieved_by.end(), {Relief::kBufferPort, Relief::kPathStorage});
    }
  };
  describe(rows_, pipeline_.store().rows);
  describe(frame_, pipeline_.store().frame);
}

std::vector<MemoryPort*> StereoCore::store_ports() const {
  std::vector<MemoryPort*> ports;
  for (StoreEngines* engines : {rows_.get(), frame_.get()}) {
    if (engines == nullptr) continue;
    ports.push_back(&engines->write_port);
    ports.push_back(&engines->read_port);
  }
  return ports;
}

void StereoCore::find_stages() {
  const std::vector<StageInfo> stages = pipeline_.stages();
  for (MemoryPort* port : ports()) port->find_stage(stages);
  for (MemoryPort* port : store_ports()) port->find_stage(stages);
}

std::vector<Part> StereoCore::parts() const {
  std::vector<Part> parts;
  if (!queue_frames_) {
    parts.push_back(
        {PartKind::kCore,
         "core",
         software_waits_ ? "clocks.core_hz, software.response_ns" : "clocks.core_hz, software.queue_frames",
         {Relief::kCoreClock, Relief::kSoftware, Relief::kMatchingInterval}});
  }
  const std::vector<MemoryPort*> buffer = store_ports();
  for (const StageInfo& info : pipeline_.stages()) {
    Part part{PartKind::kStage, info.stage->basename(), "clocks.core_hz", {Relief::kCoreClock}};
    part.stage = info;
    const auto add = [&part](std::initializer_list<Relief> reliefs) {
      part.relieved_by.insert(part.relieved_by.end(), reliefs);
    };
    if (pipeline_.is_matcher(*info.stage)) add({Relief::kMatchingInterval});
    const auto is_at = [&info](const MemoryPort* port) {
      return port->stage && port->stage->stage == info.stage;
    };
    if (std::any_of(buffer.begin(), buffer.end(), is_at)) add({Relief::kBufferPort, Relief::kPathStorage});
    parts.push_back(std::move(part));
  }
  return parts;
}

CoreFacts StereoCore::make_facts(const MachineConfig& config) const {
  const std::uint64_t rows = run_.height;
  const std::uint64_t image_row = bytes_of(format_, run_.width);
  const std::uint64_t early = config.camera.early_start_rows;
  CoreFacts facts;
  facts.width = run_.width;
  facts.height = run_.height;
  facts.image_bytes = image_row * rows;
  facts.start_bytes = image_row * (early == 0 ? rows : std::min(early, rows));
  facts.map_bytes = input_.map.bytes.size();
  facts.output_bytes = OutputPacking::row_bytes(run_.width, output_left_) * rows;
  facts.buffer_bytes = pipeline_.store().bytes();
  facts.memory_bytes = config.memory.size_bytes;
  facts.left = {left_port_.master, config.dma.left.outstanding};
  facts.right = {right_port_.master, config.dma.right.outstanding};
  facts.map = {map_port_.master, config.dma.map.outstanding};
  facts.output = {output_port_.master, config.dma.output.outstanding};
  for (const MemoryPort* port : store_ports()) facts.buffer.push_back({port->master, port->slots});
  return facts;
}

}  // namespace parallax
