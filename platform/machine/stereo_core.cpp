// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/stereo_core.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

#include "platform/machine/engine_config.hpp"
#include "platform/machine/when_both.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

std::vector<std::uint32_t> row_lengths(int rows, std::size_t bytes) {
  return std::vector<std::uint32_t>(static_cast<std::size_t>(rows), static_cast<std::uint32_t>(bytes));
}

// Rows, and those of tiles, must begin and end with a byte.
void check_whole_bytes(PixelFormat format, int width, const TilePlan& tiles) {
  const auto whole = [format](int pixels) { return pixels * bits_per_pixel(format) % 8 == 0; };
  if (!whole(width)) {
    throw UserError(
        fmt::format("camera.format = \"mono12_packed\": rows of {} px are no whole number of bytes; "
                    "image.width_granularity = 2 pads them",
                    width));
  }
  for (const Tile& tile : tiles.tiles) {
    if (whole(tile.begin) && whole(tiles.width)) continue;
    throw UserError(
        fmt::format("camera.format = \"mono12_packed\": a tile of {} px begins at column {}, which must "
                    "both be even; tiles.left_margin and tiles.right_margin move them",
                    tiles.width, tile.begin));
  }
}

}  // namespace

StereoCore::StorePorts::StorePorts(const std::string& what, const DmaPortConfig& config,
                                   const ClockDomain& clock, Dataflow& dataflow)
    : write(("dma_" + what + "_write").c_str(), engine_config(config), clock),
      read(("dma_" + what + "_read").c_str(), engine_config(config), clock),
      progress(std::make_shared<TransferProgress>(dataflow)) {}

StereoCore::StereoCore(const sc_core::sc_module_name& name, const MachineConfig& config,
                       const MachineInput& input, const CoreMap& map, const ClockDomain& clock,
                       Dataflow& dataflow)
    : sc_module(name),
      input_(input),
      map_(map),
      format_(config.camera.format),
      queue_frames_(config.software.queue_frames),
      output_left_(config.link.output_left()),
      dma_left_("dma_left", engine_config(config.dma.left), clock),
      dma_right_("dma_right", engine_config(config.dma.right), clock),
      dma_map_("dma_map", engine_config(config.dma.map), clock),
      dma_output_("dma_output", engine_config(config.dma.output), clock),
      pipeline_("pipeline", config, map.map, map.tiles, {clock, dataflow, map.tiles.width, input.height}),
      early_rows_(config.link.enabled
                      ? std::min(config.link.early_start_rows, static_cast<std::uint32_t>(input.height))
                      : 0),
      output_burst_(config.dma.output.burst_bytes) {
  if (early_rows_ > 0) output_progress_ = std::make_shared<TransferProgress>(dataflow);
  check_whole_bytes(format_, input.width, map.tiles);
  pipeline_.bind(dma_left_.out_bursts, dma_right_.out_bursts, dma_map_.out_bursts, dma_output_.in_bursts);
  if (pipeline_.store().keeps_rows()) {
    rows_ = std::make_unique<StorePorts>("buffer_row", config.dma.buffer, clock, dataflow);
    pipeline_.bind_rows(rows_->write.in_bursts, rows_->read.out_bursts);
  }
  if (pipeline_.store().keeps_frame()) {
    frame_ = std::make_unique<StorePorts>("buffer_frame", config.dma.buffer, clock, dataflow);
    pipeline_.bind_frame(frame_->write.in_bursts, frame_->read.out_bursts);
  }
  make_ports(config.dma);
}

void StereoCore::make_ports(const DmaConfig& config) {
  const auto shared = [](RowEnds rows) { return std::make_shared<const RowEnds>(std::move(rows)); };
  const std::vector<Tile>& tiles = map_.tiles.tiles;
  const auto tile_count = static_cast<std::int32_t>(tiles.size());
  const auto rows = static_cast<std::size_t>(input_.height);
  ports_ = {{"left", "left", dma_left_, config.left},
            {"right", "right", dma_right_, config.right},
            {"map", "map", dma_map_, config.map},
            {"output", "output", dma_output_, config.output}};
  const std::uint64_t image_row = bytes_of(format_, static_cast<std::uint64_t>(map_.tiles.width));
  ports_[0].buffer = BufferKind::kLeft;
  ports_[1].buffer = BufferKind::kRight;
  ports_[0].rows = ports_[1].rows = shared(equal_rows(image_row, input_.height, tile_count));
  const std::vector<std::uint32_t>& map_rows = map_.map.row_bytes;
  ports_[2].rows = shared(rows_of_lengths({map_rows.begin(), map_rows.end()}, input_.height));
  std::vector<std::uint64_t> lengths;
  for (const Tile& tile : tiles) {
    lengths.insert(lengths.end(), rows, output_job(tile).row_bytes.front());
  }
  ports_[3].buffer = BufferKind::kOutput;
  ports_[3].rows = shared(rows_of_lengths(lengths, input_.height));
  const auto add = [&](const std::string& name, StorePorts* store, const StoreLayout& layout) {
    if (store == nullptr) return;
    std::vector<std::uint64_t> kept;  // of a tile
    for (const StoreLayout::Pass& pass : layout.passes) {
      if (pass.record_bytes > 0) kept.insert(kept.end(), pass.rows, layout.row_bytes(pass));
    }
    std::vector<std::uint64_t> all;
    for (std::size_t tile = 0; tile < tiles.size(); ++tile) all.insert(all.end(), kept.begin(), kept.end());
    const auto ends = shared(rows_of_lengths(all, static_cast<std::int32_t>(kept.size())));
    for (MemoryPort port : {MemoryPort(name + "_write", "buffer", store->write, config.buffer),
                            MemoryPort(name + "_read", "buffer", store->read, config.buffer)}) {
      port.rows = ends;
      port.relieved_by.insert(port.relieved_by.end(), {Relief::kBufferPort, Relief::kPathStorage});
      buffer_ports_.push_back(std::move(port));
    }
  };
  add("buffer_row", rows_.get(), pipeline_.store().rows);
  add("buffer_frame", frame_.get(), pipeline_.store().frame);
}

// The stage that reads or writes the stream that the engine is bound to.
void StereoCore::find_stages() {
  const std::vector<StageInfo> stages = pipeline_.stages();
  const auto find = [&](MemoryPort& port, StreamPort& bursts) {
    const StreamBase* const stream = bursts.streams().front();
    for (const StageInfo& info : stages) {
      for (unsigned number = 0; number < Stage::kMaxPorts; ++number) {
        const auto bound = port.direction == MemoryPort::Direction::kReads
                               ? info.stage->input_streams(number)
                               : info.stage->output_streams(number);
        if (std::find(bound.begin(), bound.end(), stream) != bound.end()) port.stage = info;
      }
    }
  };
  find(ports_[0], dma_left_.out_bursts);
  find(ports_[1], dma_right_.out_bursts);
  find(ports_[2], dma_map_.out_bursts);
  find(ports_[3], dma_output_.in_bursts);
  std::size_t next = 0;
  for (StorePorts* store : {rows_.get(), frame_.get()}) {
    if (store == nullptr) continue;
    find(buffer_ports_[next++], store->write.in_bursts);
    find(buffer_ports_[next++], store->read.out_bursts);
  }
}

std::vector<Part> StereoCore::parts() const {
  std::vector<Part> parts;
  if (!queue_frames_) {
    parts.push_back({PartKind::kCore,
                     "core",
                     "clocks.core_hz, software.response_ns",
                     {Relief::kCoreClock, Relief::kSoftware, Relief::kMatchingInterval}});
  }
  for (const StageInfo& info : pipeline_.stages()) {
    Part part{PartKind::kStage, info.stage->basename(), "clocks.core_hz", {Relief::kCoreClock}};
    part.stage = info;
    const auto add = [&part](std::initializer_list<Relief> reliefs) {
      part.relieved_by.insert(part.relieved_by.end(), reliefs);
    };
    if (info.stage == &pipeline_.matcher()) add({Relief::kMatchingInterval});
    const auto feeds = [&](const MemoryPort& port) { return port.stage && port.stage->stage == info.stage; };
    if (std::any_of(buffer_ports_.begin(), buffer_ports_.end(), feeds)) {
      add({Relief::kBufferPort, Relief::kPathStorage});
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

void StereoCore::start(const CoreJob& job) {
  if (job.values) pipeline_.configure(job.parameters);
  start_input(job);
  start_output(job);
  start_store(job);
}

void StereoCore::start_input(const CoreJob& job) {
  const std::function<void()> read = when_both(job.read);
  const auto bytes = [this](int pixels) { return bytes_of(format_, static_cast<std::uint64_t>(pixels)); };
  for (const Tile& tile : map_.tiles.tiles) {
    DmaJob image;
    image.row_bytes = row_lengths(input_.height, bytes(map_.tiles.width));
    image.values = job.values;
    if (map_.tiles.tiles.size() > 1) image.pitch = bytes(input_.width);
    if (&tile == &map_.tiles.tiles.back()) image.done = read;
    const std::uint64_t column = bytes(tile.begin);
    const auto read_image = [&](DmaReader& dma, std::uint64_t address, const ImageSource& source) {
      image.address = address + column;
      image.behind = source.progress;
      // A row is read when all of it is there, in all tiles.
      image.needed = [source, row = bytes(map_.tiles.width),
                      whole = bytes(input_.width)](std::uint64_t last_byte) {
        return source.bursts_until((last_byte + row - 1) / row * whole);
      };
      dma.start(image);
    };
    read_image(dma_left_, job.left, job.left_source);
    read_image(dma_right_, job.right, job.right_source);
  }
  dma_map_.start({job.map, map_.map.row_bytes, job.values, nullptr});
}

DmaJob StereoCore::output_job(const Tile& tile) const {
  const auto output_bytes = [this](int pixels) { return OutputPacking::row_bytes(pixels, output_left_); };
  DmaJob result;
  result.address = output_bytes(tile.keep_begin);
  result.row_bytes = row_lengths(input_.height, output_bytes(tile.keep_end - tile.keep_begin));
  if (map_.tiles.tiles.size() > 1) result.pitch = output_bytes(input_.width);
  return result;
}

std::uint64_t StereoCore::output_bursts_until(std::uint64_t rows) const {
  const DmaJob job = output_job(map_.tiles.tiles.back());
  return job.bursts_until(rows * job.row_bytes.front(), output_burst_);
}

void StereoCore::start_output(const CoreJob& job) {
  for (const Tile& tile : map_.tiles.tiles) {
    DmaJob result = output_job(tile);
    result.address += job.output;
    result.values = job.values;
    if (&tile == &map_.tiles.tiles.back()) {
      result.done = job.written;
      result.progress = output_progress_;
      if (job.early) result.marks = {{std::uint64_t{early_rows_} * result.row_bytes.front(), job.early}};
    }
    dma_output_.start(std::move(result));
  }
}

// The engines of a store move the same bursts; what is written must be answered for before it is read.
void StereoCore::start_store(const CoreJob& job) {
  const MatcherStore& store = pipeline_.store();
  const auto move = [](StorePorts& ports, std::uint64_t address, std::uint64_t rows, std::uint64_t row_bytes,
                       Bytes burst, bool frame) {
    DmaJob transfer;
    transfer.address = address;
    transfer.row_bytes.assign(rows, static_cast<std::uint32_t>(row_bytes));
    transfer.values = false;
    transfer.progress = ports.progress;
    ports.write.start(transfer);
    transfer.progress = nullptr;
    transfer.behind = ports.progress;
    const std::uint64_t before = ports.bursts;
    ports.bursts += burst_count(rows * row_bytes, burst);
    // The frame comes back last pixel first; a row from its begin.
    transfer.downwards = frame;
    transfer.needed = [before, burst, all = ports.bursts, frame](std::uint64_t last_byte) {
      return frame ? all : before + burst_count(last_byte, burst);
    };
    ports.read.start(transfer);
  };
  for (std::size_t tile = 0; tile < map_.tiles.tiles.size(); ++tile) {
    for (const StoreLayout::Pass& pass : store.rows.passes) {
      if (pass.record_bytes == 0) continue;
      for (std::uint64_t row = 0; row < pass.rows; ++row) {
        move(*rows_, job.buffer, 1, store.rows.row_bytes(pass), store.rows.burst, false);
      }
    }
    if (store.keeps_frame()) {
      const StoreLayout::Pass& pass = store.frame.passes.front();
      move(*frame_, job.buffer + store.frame_offset(), pass.rows, store.frame.row_bytes(pass),
           store.frame.burst, true);
    }
  }
}

}  // namespace parallax
