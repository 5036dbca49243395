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
                       const MachineInput& input, std::uint64_t map_address, const ClockDomain& clock,
                       Dataflow& dataflow)
    : sc_module(name),
      input_(input),
      map_address_(map_address),
      dma_left_("dma_left", engine_config(config.dma.left), clock),
      dma_right_("dma_right", engine_config(config.dma.right), clock),
      dma_map_("dma_map", engine_config(config.dma.map), clock),
      dma_output_("dma_output", engine_config(config.dma.output), clock),
      pipeline_("pipeline", config, *input.map, {clock, dataflow, input.width, input.height}) {
  pipeline_.bind(dma_left_.out_bursts, dma_right_.out_bursts, dma_map_.out_bursts, dma_output_.in_bursts);
}

void StereoCore::start(const CoreJob& job) {
  const std::vector<std::uint32_t> rows = equal_rows(input_.height, static_cast<std::size_t>(input_.width));
  const std::function<void()> read = when_both(job.read);
  dma_left_.start({job.left, rows, job.values, read});
  dma_right_.start({job.right, rows, job.values, read});
  dma_map_.start({map_address_, input_.map->row_bytes, job.values, nullptr});
}

void StereoCore::start_output(std::uint64_t address, bool values, std::function<void()> written) {
  dma_output_.start({address, equal_rows(input_.height, OutputPacking::row_bytes(input_.width)), values,
                     std::move(written)});
}

}  // namespace parallax
