// SPDX-License-Identifier: Apache-2.0
// The model's VCD beside the one that the simulator of a circuit writes: in a viewer, which shows both on one
// time axis, every handshake is in the same cycle.
#include <TracedChain8.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <verilated_vcd_c.h>

#include <filesystem>
#include <fstream>

#include "tests/bench/stage_chain.hpp"
#include "tests/cli/program.hpp"
#include "tests/timing/in_child.hpp"
#include "tests/traces/wave.hpp"
#include "traces/date_order.hpp"
#include "traces/recorder.hpp"
#include "traces/vcd_trace.hpp"

namespace parallax::test {
namespace wave_rtl_test {

constexpr std::int64_t kPeriod = 1000;  // ps

bench::ChainLoad load() {
  bench::ChainLoad load = bench::stalling_load(4, 1);
  load.source_gaps.resize(600);
  return load;
}

// A cycle begins with the rising edge. Returns how many cycles there were.
std::int64_t run_circuit(const std::string& file) {
  const bench::ChainLoad chain = load();
  VerilatedContext context;
  context.traceEverOn(true);
  TracedChain8 top(&context);
  VerilatedVcdC vcd;
  vcd.set_time_unit("1ps");
  vcd.set_time_resolution("1ps");
  top.trace(&vcd, 99);
  vcd.open(file.c_str());
  bench::Gaps source(chain.source_gaps);
  bench::Gaps sink(chain.sink_gaps);
  std::uint64_t written = 0, read = 0;
  std::int64_t source_free = 0, sink_free = 0, cycle = 0;
  for (; read < chain.tokens(); ++cycle) {
    top.clk = cycle > 0 ? 1 : 0;  // what is agreed on in a cycle happens at its end
    top.eval();
    top.want_write = written < chain.tokens() && cycle >= source_free;
    top.want_read = cycle >= sink_free;
    top.eval();
    vcd.dump(static_cast<std::uint64_t>(cycle * kPeriod));
    if (top.wrote) {
      ++written;
      source_free = cycle + source.next();
    }
    if (top.was_read) {
      ++read;
      sink_free = cycle + sink.next();
    }
    top.clk = 0;
    top.eval();
    vcd.dump(static_cast<std::uint64_t>(cycle * kPeriod + kPeriod / 2));
  }
  vcd.close();
  return cycle;
}

void run_model(const std::string& file) {
  const bench::ChainLoad chain = load();
  const ClockDomain clock("clock", Hertz(1'000'000'000));
  Dataflow dataflow("dataflow");
  std::vector<std::unique_ptr<Stream<int>>> streams;
  for (int i = 0; i <= bench::kStages; ++i) {
    streams.push_back(std::make_unique<Stream<int>>(fmt::format("link{}", i).c_str(), dataflow, clock, clock,
                                                    FifoConfig{chain.depth, Bits(8)}));
  }
  bench::ChainStage source("source", clock, dataflow, {0, chain.source_gaps, chain.frames, false, true});
  bench::ChainStage sink("sink", clock, dataflow, {0, chain.sink_gaps, 0, true, false});
  std::vector<std::unique_ptr<bench::ChainStage>> stages;
  (*source.out)(*streams.front());
  for (std::size_t i = 0; i < bench::kStages; ++i) {
    const bench::ChainStage::Shape shape{1, std::vector<std::uint32_t>(chain.source_gaps.size(), 1)};
    stages.push_back(
        std::make_unique<bench::ChainStage>(fmt::format("hop{}", i).c_str(), clock, dataflow, shape));
    (*stages.back()->in)(*streams[i]);
    (*stages.back()->out)(*streams[i + 1]);
  }
  (*sink.in)(*streams.back());

  std::ofstream out(file, std::ios::binary);
  DateOrder vcd(std::make_unique<VcdTrace>([&out](std::string_view text) { out << text; }));
  SamplingTimer timer("sampling_timer");
  RecorderConfig config;
  config.tokens = true;
  config.rows = 1;
  config.frames = 1;
  config.period = sc_core::sc_time(100, sc_core::SC_NS);
  Recorder* recorder = nullptr;
  Recorder wave("recorder", config, dataflow, timer, [&] {
    for (const auto& stream : streams) recorder->add(*stream, nullptr);
  });
  recorder = &wave;
  wave.add(vcd);
  sc_core::sc_start();
  wave.finish();
}

TEST(WaveRtl, HandshakesOfModelAndCircuitAreInTheSameCycles) {
  SKIP_WITHOUT("fst2vcd", "gtkwave");
  const Program program;  // for its folder
  const std::string circuit_file = (program / "circuit.vcd").string();
  const std::string model_file = (program / "model.vcd").string();
  const std::string cycles = in_child([&] { return std::to_string(run_circuit(circuit_file)); });
  ASSERT_EQ(in_child([&] {
              run_model(model_file);
              return std::string("ran");
            }),
            "ran");
  const Wave circuit = read_wave(circuit_file);
  const Wave model = read_wave(model_file);
  EXPECT_EQ(model.timescale, circuit.timescale);

  std::size_t handshakes = 0;
  for (std::int64_t cycle = 0; cycle < std::stoll(cycles); ++cycle) {
    const std::int64_t time = cycle * kPeriod;
    for (int i = 0; i <= bench::kStages; ++i) {
      for (const auto& [side, signal] : {std::pair{"in", "write"}, std::pair{"out", "read"}}) {
        const auto bit = [&](const char* name) {
          return circuit.at(fmt::format("TOP.chain8.{}_{}", side, name), time) >> i & 1;
        };
        const std::int64_t expected = bit("valid") & bit("ready");
        ASSERT_EQ(model.at(fmt::format("link{}.{}", i, signal), time), expected)
            << signal << " of link " << i << " in cycle " << cycle;
        handshakes += static_cast<std::size_t>(expected);
      }
    }
  }
  EXPECT_EQ(handshakes, 2u * (bench::kStages + 1) * load().tokens());
}

}  // namespace wave_rtl_test
}  // namespace parallax::test
