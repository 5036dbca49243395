// SPDX-License-Identifier: Apache-2.0
#include "platform/stereo_core.hpp"

#include <utility>
#include <vector>

#include "platform/engine_config.hpp"
#include "platform/when_both.hpp"

namespace parallax {
namespace {

std::vector<std::uint32_t> equal_rows(int rows, std::size_t bytes) {
  return std::vector<std::uint32_t>(static_cast<std::size_t>(rows), static_cast<std::uint32_t>(bytes));
}

}  // namespace

StereoCore::StereoCore(const sc_core::sc_module_name& name, const MachineConfig& config,
                       const MachineInput& input, const CoreMap& map, const ClockDomain& clock,
                       Dataflow& dataflow)
    : sc_module(name),
      input_(input),
      map_(map),
      dma_left_("dma_left", engine_config(config.dma.left), clock),
      dma_right_("dma_right", engine_config(config.dma.right), clock),
      dma_map_("dma_map", engine_config(config.dma.map), clock),
      dma_output_("dma_output", engine_config(config.dma.output), clock),
      pipeline_("pipeline", config, map.map, map.tiles, {clock, dataflow, map.tiles.width, input.height}) {
  pipeline_.bind(dma_left_.out_bursts, dma_right_.out_bursts, dma_map_.out_bursts, dma_output_.in_bursts);
}

void StereoCore::start(const CoreJob& job) {
  if (job.values) pipeline_.configure(job.parameters);
  start_input(job);
  start_output(job);
}

void StereoCore::start_input(const CoreJob& job) {
  const std::function<void()> read = when_both(job.read);
  const auto width = static_cast<std::uint64_t>(input_.width);
  for (const Tile& tile : map_.tiles.tiles) {
    DmaJob image;
    image.row_bytes = equal_rows(input_.height, static_cast<std::size_t>(map_.tiles.width));
    image.values = job.values;
    if (map_.tiles.tiles.size() > 1) image.pitch = width;
    if (&tile == &map_.tiles.tiles.back()) image.done = read;
    const auto column = static_cast<std::uint64_t>(tile.begin);
    image.address = job.left + column;
    dma_left_.start(image);
    image.address = job.right + column;
    dma_right_.start(image);
  }
  dma_map_.start({job.map, map_.map.row_bytes, job.values, nullptr});
}

void StereoCore::start_output(const CoreJob& job) {
  for (const Tile& tile : map_.tiles.tiles) {
    DmaJob result;
    result.address = job.output + OutputPacking::row_bytes(tile.keep_begin);
    result.row_bytes = equal_rows(input_.height, OutputPacking::row_bytes(tile.keep_end - tile.keep_begin));
    result.values = job.values;
    if (map_.tiles.tiles.size() > 1) result.pitch = OutputPacking::row_bytes(input_.width);
    if (&tile == &map_.tiles.tiles.back()) result.done = job.written;
    dma_output_.start(std::move(result));
  }
}

}  // namespace parallax
