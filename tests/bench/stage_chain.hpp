// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <memory>
#include <stdexcept>

#include "tests/bench/chain_load.hpp"
#include "tests/bench/cpu_seconds.hpp"
#include "tlm/stage.hpp"
#include "tlm/stream.hpp"

namespace parallax::bench {

/// A stage that reads and writes one token a firing; without one of the ports, a source or a sink.
class ChainStage final : public Stage {
 public:
  struct Shape {
    std::uint32_t latency = 1;
    std::vector<std::uint32_t> gaps;  ///< of one frame
    std::uint64_t frames = 0;         ///< 0: as many as come
    bool reads = true;
    bool writes = true;
  };

  ChainStage(const sc_core::sc_module_name& name, const ClockDomain& clock, Dataflow& dataflow,
             const Shape& shape)
      : Stage(name, clock, dataflow, shape.latency) {
    if (shape.reads) in = std::make_unique<StreamIn<int>>("in");
    if (shape.writes) out = std::make_unique<StreamOut<int>>("out");
    Firings firings;
    for (const std::uint32_t gap : shape.gaps) {
      firings.add(fires().reads(shape.reads ? 1 : 0).writes(shape.writes ? 1 : 0).every(gap));
    }
    set_schedule(Schedule().run(firings));
    set_frame_limit(shape.frames);
  }

  std::unique_ptr<StreamIn<int>> in;
  std::unique_ptr<StreamOut<int>> out;
};

/// The model's own mechanism: SystemC modules of class Stage, with all their statistics.
inline ChainRun run_stages(const ChainLoad& load) {
  const ClockDomain clock("clock", Hertz(1'000'000'000));
  Dataflow dataflow("dataflow");
  std::vector<std::unique_ptr<Stream<int>>> streams;
  for (int i = 0; i <= kStages; ++i) {
    const FifoConfig fifo{load.depth, Bits(8)};
    streams.push_back(
        std::make_unique<Stream<int>>(fmt::format("s{}", i).c_str(), dataflow, clock, clock, fifo));
  }
  ChainStage source("source", clock, dataflow, {0, load.source_gaps, load.frames, false, true});
  ChainStage sink("sink", clock, dataflow, {0, load.sink_gaps, 0, true, false});
  std::vector<std::unique_ptr<ChainStage>> stages;
  (*source.out)(*streams.front());
  for (std::size_t i = 0; i < kStages; ++i) {
    const ChainStage::Shape shape{1, std::vector<std::uint32_t>(load.source_gaps.size(), 1)};
    stages.push_back(std::make_unique<ChainStage>(fmt::format("n{}", i).c_str(), clock, dataflow, shape));
    (*stages.back()->in)(*streams[i]);
    (*stages.back()->out)(*streams[i + 1]);
  }
  (*sink.in)(*streams.back());

  const double began = cpu_seconds();
  sc_core::sc_start();
  const double seconds = cpu_seconds() - began;
  if (streams.back()->statistics().read != load.tokens())
    throw std::runtime_error("the sink has not read all tokens");
  return {seconds, sink.frames().back().last_firing.count()};
}

}  // namespace parallax::bench
