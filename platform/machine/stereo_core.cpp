// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/stereo_core.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "modules/output_packing.hpp"
#include "platform/machine/engine_config.hpp"
#include "platform/machine/when_both.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

std::vector<std::uint32_t> row_lengths(int rows, std::size_t bytes) {
  return std::vector<std::uint32_t>(rows, static_cast<std::uint32_t>(bytes));
}

// Rows must begin and end with a byte. Those of tiles do: their widths and margins are even (plan_tiles).
void check_whole_bytes(PixelFormat format, int width) {
  if (width * bits_per_pixel(format) % 8 == 0) return;
  throw UserError(
      fmt::format("camera.format = \"mono12_packed\": rows of {} px are no whole number of bytes; "
                  "image.width_granularity = 2 pads them",
                  width));
}

}  // namespace

StereoCore::StoreEngines::StoreEngines(const std::string& what, const DmaPortConfig& config,
                                       const ClockDomain& clock, Dataflow& dataflow)
    : write(("dma_" + what + "_write").c_str(), engine_config(config), clock),
      read(("dma_" + what + "_read").c_str(), engine_config(config), clock),
      progress(std::make_shared<TransferProgress>(dataflow)),
      write_port(what + "_write", "buffer", write, config),
      read_port(what + "_read", "buffer", read, config) {}

StereoCore::StereoCore(const sc_core::sc_module_name& name, const MachineConfig& config,
                       const MachineInput& run, CoreInput input, Hooks hooks, const ClockDomain& clock,
                       Dataflow& dataflow)
    : sc_module(name),
      run_(run),
      input_(std::move(input)),
      hooks_(std::move(hooks)),
      clock_(clock),
      format_(config.camera.format),
      queue_frames_(config.software.queue_frames),
      software_waits_(config.software.response_ns > 0),
      output_left_(config.link.output_left()),
      dma_left_("dma_left", engine_config(config.dma.left), clock),
      dma_right_("dma_right", engine_config(config.dma.right), clock),
      dma_map_("dma_map", engine_config(config.dma.map), clock),
      dma_output_("dma_output", engine_config(config.dma.output), clock),
      pipeline_("pipeline", config, input_.map, input_.tiles,
                {clock, dataflow, input_.tiles.width, run.height, config.timing.overlap_frames,
                 config.timing.pixels_per_token},
                run.replacements),
      early_rows_(config.link.enabled
                      ? std::min(config.link.early_start_rows, static_cast<std::uint32_t>(run.height))
                      : 0),
      output_burst_(config.dma.output.burst_bytes),
      left_port_("left", "left", dma_left_, config.dma.left),
      right_port_("right", "right", dma_right_, config.dma.right),
      map_port_("map", "map", dma_map_, config.dma.map),
      output_port_("output", "output", dma_output_, config.dma.output) {
  if (early_rows_ > 0) output_progress_ = std::make_shared<TransferProgress>(dataflow);
  check_whole_bytes(format_, run.width);
  pipeline_.bind(dma_left_.out_bursts, dma_right_.out_bursts, dma_map_.out_bursts, dma_output_.in_bursts);
  if (pipeline_.store().keeps_rows()) {
    rows_ = std::make_unique<StoreEngines>("buffer_row", config.dma.buffer, clock, dataflow);
    pipeline_.bind_rows(rows_->write.in_bursts, rows_->read.out_bursts);
  }
  if (pipeline_.store().keeps_frame()) {
    frame_ = std::make_unique<StoreEngines>("buffer_frame", config.dma.buffer, clock, dataflow);
    pipeline_.bind_frame(frame_->write.in_bursts, frame_->read.out_bursts);
  }
  describe_ports();
  facts_ = make_facts(config);
  control_ = std::make_unique<ControlBlocks>(
      "control", config, facts_,
      ControlBlocks::Hooks{hooks_.expected, [this](const FrameCommand& command) { start(command); }});
}

void StereoCore::start(const FrameCommand& command) {
  const std::int64_t frame = started_++;
  hooks_.started(frame);
  if (hooks_.has_values(frame)) pipeline_.configure(command.parameters);
  start_input(frame, command);
  start_output(frame, command);
  start_store(frame, command);
}

void StereoCore::start_input(std::int64_t frame, const FrameCommand& command) {
  const std::function<void()> read = when_both(hooks_.read);
  const auto bytes = [this](int pixels) { return bytes_of(format_, pixels); };
  const bool values = hooks_.has_values(frame);
  for (const Tile& tile : input_.tiles.tiles) {
    DmaJob image;
    image.row_bytes = row_lengths(run_.height, bytes(input_.tiles.width));
    image.values = values;
    if (input_.tiles.tiles.size() > 1) image.pitch = bytes(run_.width);
    if (&tile == &input_.tiles.tiles.back()) image.done = read;
    const std::uint64_t column = bytes(tile.begin);
    // A row is read when all of it is there, in all tiles.
    const auto read_image = [&](DmaReader& dma, std::uint64_t address, const FrameWriter& writer) {
      image.address = address + column;
      writer.lead(image, frame);
      dma.start(image);
    };
    read_image(dma_left_, command.left, input_.left);
    read_image(dma_right_, command.right, input_.right);
  }
  dma_map_.start({command.map, input_.map.row_bytes, values, nullptr});
}

DmaJob StereoCore::output_job(const Tile& tile) const {
  const auto output_bytes = [this](int pixels) { return OutputPacking::row_bytes(pixels, output_left_); };
  DmaJob result;
  result.address = output_bytes(tile.keep_begin);
  result.row_bytes = row_lengths(run_.height, output_bytes(tile.keep_end - tile.keep_begin));
  if (input_.tiles.tiles.size() > 1) result.pitch = output_bytes(run_.width);
  return result;
}

FrameWriter StereoCore::output_writer() const {
  return {output_progress_, static_cast<std::uint64_t>(run_.height),
          [job = output_job(input_.tiles.tiles.back()), burst = output_burst_](std::uint64_t rows) {
            return job.bursts_until(rows * job.row_bytes.front(), burst);
          }};
}

void StereoCore::start_output(std::int64_t frame, const FrameCommand& command) {
  for (const Tile& tile : input_.tiles.tiles) {
    DmaJob result = output_job(tile);
    result.address += command.output;
    result.values = hooks_.has_values(frame);
    result.late_values = !pipeline_.values_in_time();
    if (&tile == &input_.tiles.tiles.back()) {
      result.done = [this, frame] { written(frame); };
      result.progress = output_progress_;
      if (output_progress_) {
        result.marks = {
            {std::uint64_t{early_rows_} * result.row_bytes.front(), [this, frame] { hooks_.begun(frame); }}};
      }
    }
    dma_output_.start(std::move(result));
  }
}

void StereoCore::written(std::int64_t frame) {
  control_->frame_done();
  const StageInfo filter = pipeline_.last_filter();
  const std::size_t index = frame;
  hooks_.written(frame, {clock_.time_of(filter.first_pass(index).first_write),
                         clock_.time_of(filter.last_pass(index).last_write)});
}

// The engines of a buffer move the same bursts; what is written must be answered for before it is read.
void StereoCore::start_store(std::int64_t frame, const FrameCommand& command) {
  const MatcherStore& store = pipeline_.store();
  const auto move = [values = hooks_.has_values(frame)](StoreEngines& ports, std::uint64_t address,
                                                        std::uint64_t rows, std::uint64_t row_bytes,
                                                        Bytes burst, bool backwards) {
    DmaJob transfer;
    transfer.address = address;
    transfer.values = values;
    // Values come back burst by burst, each as soon as it is there.
    const std::uint64_t piece = values ? static_cast<std::uint64_t>(burst.count()) : row_bytes;
    transfer.row_bytes.assign(rows * row_bytes / piece, static_cast<std::uint32_t>(piece));
    transfer.progress = ports.progress;
    ports.write.start(transfer);
    transfer.progress = nullptr;
    transfer.behind = ports.progress;
    const std::uint64_t before = ports.bursts;
    ports.bursts += burst_count(rows * row_bytes, burst);
    // The frame comes back last pixel first; a row from its begin.
    transfer.downwards = backwards;
    transfer.needed = [before, burst, all = ports.bursts, backwards](std::uint64_t last_byte) {
      return backwards ? all : before + burst_count(last_byte, burst);
    };
    ports.read.start(transfer);
  };
  for (std::size_t tile = 0; tile < input_.tiles.tiles.size(); ++tile) {
    for (const StoreLayout::Pass& pass : store.rows.passes) {
      if (pass.record_bytes == 0) continue;
      for (std::uint64_t row = 0; row < pass.rows; ++row) {
        move(*rows_, command.buffer, 1, store.rows.row_bytes(pass), store.rows.burst, false);
      }
    }
    if (store.keeps_frame()) {
      const StoreLayout::Pass& pass = store.frame.passes.front();
      move(*frame_, command.buffer + store.frame_offset(), pass.rows, store.frame.row_bytes(pass),
           store.frame.burst, true);
    }
  }
}

}  // namespace parallax
