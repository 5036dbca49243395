// SPDX-License-Identifier: Apache-2.0
// Circuits at pin level between streams add nothing: every date is that of the circuit itself, as the
// reference has it.
#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <random>
#include <sstream>

#include "tests/timing/in_child.hpp"
#include "tests/timing/model_simulation.hpp"
#include "tests/timing/pin_fifo.hpp"
#include "tests/timing/reference_simulation.hpp"
#include "tlm/pin_sink.hpp"
#include "tlm/pin_source.hpp"

namespace parallax::test {
namespace pin_dates_test {

/// A circuit and its ends.
struct Block {
  Block(const std::string& name, const ClockDomain& domain, const PinClockConfig& config,
        const GraphEdge* fifo)
      : clock((name + "_clock").c_str(), domain, config),
        source((name + "_source").c_str(), clock),
        sink((name + "_sink").c_str(), clock),
        circuit(name.c_str(), fifo != nullptr ? fifo->depth : 0, fifo != nullptr && fifo->write_to_read == 0,
                fifo != nullptr && fifo->read_to_write == 0) {
    clock.clock(clk);
    clock.reset(rst);
    source.valid(in_valid);
    source.ready(in_ready);
    source.data(in_data);
    sink.valid(out_valid);
    sink.ready(out_ready);
    sink.data(out_data);
    circuit.clk(clk);
    circuit.rst(rst);
    circuit.in_valid(in_valid);
    circuit.in_ready(in_ready);
    circuit.in_data(in_data);
    circuit.out_valid(out_valid);
    circuit.out_ready(out_ready);
    circuit.out_data(out_data);
  }
  sc_core::sc_signal<bool> clk, rst, in_valid, in_ready, out_valid, out_ready;
  sc_core::sc_signal<std::uint32_t> in_data, out_data;
  PinClock clock;
  PinSource<int, std::uint32_t> source;
  PinSink<int, std::uint32_t> sink;
  PinFifo circuit;
};

/// A source, streams with circuits between them, and a sink: edge 0 is a stream, and each further one that
/// is not `at_pins`.
struct Chain {
  Graph graph;
  std::vector<bool> at_pins;
  std::uint64_t tokens = 0;
  std::uint64_t threads = 0;
  std::uint64_t rest_after = 0;
};

std::vector<EdgeDates> run_chain(const Chain& chain, std::string& fault) {
  const Graph& graph = chain.graph;
  std::deque<ClockDomain> clocks;
  for (const std::int64_t period : graph.periods)
    clocks.emplace_back("clock_" + std::to_string(clocks.size()), Hertz(kUnitsPerSecond / period));
  const auto clock_of = [&](int node) -> const ClockDomain& {
    return clocks[static_cast<std::size_t>(graph.nodes[static_cast<std::size_t>(node)].clock)];
  };
  Dataflow dataflow("dataflow");
  std::vector<EdgeDates> dates(graph.edges.size());
  std::deque<DateLog> logs;
  std::deque<Stream<int>> streams;
  std::vector<std::size_t> edges;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    if (chain.at_pins[e]) continue;
    FifoConfig config;
    config.depth = graph.edges[e].depth;
    config.write_to_read = graph.edges[e].write_to_read;
    config.read_to_write = graph.edges[e].read_to_write;
    config.not_ready_cycles = graph.edges[e].not_ready_cycles;
    streams.emplace_back(("s" + std::to_string(e)).c_str(), dataflow, clock_of(graph.edges[e].from),
                         clock_of(graph.edges[e].to), config);
    streams.back().add_listener(logs.emplace_back(dates[e]));
    edges.push_back(e);
  }
  std::vector<int> sent(chain.tokens), got;
  for (std::size_t i = 0; i < sent.size(); ++i) sent[i] = static_cast<int>(i * i + 3);
  streams.back().on_row(1, [&got](const int* row, std::size_t) { got.push_back(*row); });
  streams.front().send_row(sent.data(), sent.size());

  const GraphNode &first = graph.nodes.front(), &last = graph.nodes.back();
  std::deque<GraphNode> as_stages;
  std::deque<GraphStage> stages;
  std::deque<GraphThread<int>> threads;
  const auto end = [&](const char* name, const GraphNode& node, bool thread) {
    const bool is_source = node.kind == GraphNode::Kind::kSource;
    if (thread) {
      threads.emplace_back(name, clocks[static_cast<std::size_t>(node.clock)], node);
      is_source ? (*threads.back().out)(streams.front()) : (*threads.back().in)(streams.back());
      return;
    }
    const Phase token = is_source ? fires().writes(1) : fires().reads(1);
    as_stages.push_back(test::stage(0));
    for (const std::uint32_t stall : node.stalls)
      as_stages.back().parts.push_back({1, {idles(stall), token}});
    stages.emplace_back(name, clocks[static_cast<std::size_t>(node.clock)], dataflow, as_stages.back(), 1,
                        is_source ? 0 : 1, is_source ? 1 : 0);
    is_source ? (*stages.back().out[0])(streams.front()) : (*stages.back().in[0])(streams.back());
  };
  end("from", first, (chain.threads & 1u) != 0);
  end("to", last, (chain.threads & 2u) != 0);

  std::deque<Block> blocks;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    PinClockConfig config;
    config.rest_after = chain.rest_after;
    config.order = static_cast<std::uint32_t>(i);
    const GraphEdge* fifo = edges[i + 1] - edges[i] > 1 ? &graph.edges[edges[i] + 1] : nullptr;
    blocks.emplace_back("block" + std::to_string(i), clock_of(1), config, fifo);
    blocks.back().source.in(streams[i]);
    blocks.back().sink.out(streams[i + 1]);
  }
  sc_core::sc_start(sc_core::sc_time(50, sc_core::SC_US));
  if (got != sent) fault += "the values differ\n";
  if (chain.rest_after > 0 && sc_core::sc_pending_activity()) fault += "it does not come to rest\n";
  for (std::size_t i = 0; i < edges.size(); ++i)
    dates[edges[i]].high_water = streams[i].statistics().high_water;
  return dates;
}

// What is inside a circuit at pins has no dates of its own in the model: those of its ends say it all.
std::string against_reference(const Chain& chain) {
  std::ostringstream description;
  const std::string found = in_child([&] {
    std::vector<EdgeDates> expected = ReferenceSimulation(chain.graph).run();
    std::string fault;
    std::vector<EdgeDates> dates = run_chain(chain, fault);
    for (std::size_t e = 0; e < expected.size(); ++e) {
      if (!chain.at_pins[e]) continue;
      // A token goes into the FIFO at pins when it leaves the stream before, and out into the one behind.
      if (expected[e].written != dates[e - 1].read || expected[e].read != dates[e + 1].written)
        fault += "the circuit's own dates differ\n";
      expected[e] = dates[e] = {};
    }
    return fault + differences(expected, dates);
  });
  if (!found.empty()) description << found << "threads " << chain.threads << chain.graph;
  return description.str();
}

class Drawn {
 public:
  explicit Drawn(std::uint64_t seed) : random_(seed) {}
  std::uint32_t below(std::uint32_t bound) { return static_cast<std::uint32_t>(random_() % bound); }
  std::vector<std::uint32_t> stalls(std::uint64_t tokens) {
    std::vector<std::uint32_t> all(tokens, 0);
    const std::uint32_t mode = below(4);
    for (std::uint32_t& stall : all)
      stall = ((mode & 1u) != 0 ? below(3) : 0) + ((mode & 2u) != 0 && below(16) == 0 ? below(40) : 0);
    return all;
  }
  GraphEdge stream(int from, bool at_thread) {
    const std::uint32_t least = at_thread ? 1 : 0;
    return link(from, from + 1)
        .deep(1 + below(5))
        .offsets(least + below(3), least + below(3))
        .ready_after(below(3) == 0 ? below(6) : 0);
  }

 private:
  std::mt19937_64 random_;
};

Chain between(std::uint64_t tokens, Drawn& drawn) {
  Chain chain;
  chain.graph.periods = {300};
  chain.tokens = tokens;
  chain.threads = drawn.below(4);
  chain.rest_after = drawn.below(3) == 0 ? 0 : 1 + drawn.below(5);
  chain.graph.nodes.push_back(source(drawn.stalls(tokens)));
  return chain;
}

TEST(PinDates, WiresAreAStageWithoutLatency) {
  for (std::uint64_t seed = 1; seed <= 80; ++seed) {
    Drawn drawn(seed);
    Chain chain = between(150, drawn);
    chain.graph.nodes.push_back(copying(0, 150));
    chain.graph.nodes.push_back(sink(drawn.stalls(150)));
    chain.graph.edges = {drawn.stream(0, (chain.threads & 1u) != 0),
                         drawn.stream(1, (chain.threads & 2u) != 0)};
    chain.at_pins = {false, false};
    ASSERT_EQ(against_reference(chain), "") << "seed " << seed;
  }
}

TEST(PinDates, AFifoAtPinsIsThatFifo) {
  for (std::uint64_t seed = 1; seed <= 160; ++seed) {
    Drawn drawn(seed);
    Chain chain = between(150, drawn);
    chain.graph.nodes.push_back(copying(0, 150));
    chain.graph.nodes.push_back(copying(0, 150));
    chain.graph.nodes.push_back(sink(drawn.stalls(150)));
    chain.graph.edges = {drawn.stream(0, (chain.threads & 1u) != 0),
                         link(1, 2).deep(1 + drawn.below(4)).offsets(drawn.below(2), drawn.below(2)),
                         drawn.stream(2, (chain.threads & 2u) != 0)};
    chain.at_pins = {false, true, false};
    ASSERT_EQ(against_reference(chain), "") << "seed " << seed;
  }
}

// The source has another clock than the circuit; the sink has either.
TEST(PinDates, AStreamMayCrossClocksBeforeOrBehindACircuit) {
  for (std::uint64_t seed = 1; seed <= 80; ++seed) {
    Drawn drawn(seed);
    Chain chain = between(150, drawn);
    const std::array<std::int64_t, 4> periods{200, 300, 375, 480};
    chain.graph.periods.push_back(periods[drawn.below(4)]);
    const int pins = static_cast<int>(drawn.below(2));
    chain.graph.nodes.front() = chain.graph.nodes.front().on_clock(1 - pins);
    chain.graph.nodes.push_back(copying(0, 150).on_clock(pins));
    const int behind = static_cast<int>(drawn.below(2));
    chain.graph.nodes.push_back(sink(drawn.stalls(150)).on_clock(behind));
    chain.graph.edges = {drawn.stream(0, true), drawn.stream(1, true)};
    chain.at_pins = {false, false};
    ASSERT_EQ(against_reference(chain), "") << "seed " << seed;
  }
}

// Of a stream between two, a token may be read in the cycle of its writing.
TEST(PinDates, SeveralCircuitsInARowAreInOrder) {
  for (std::uint64_t seed = 1; seed <= 80; ++seed) {
    Drawn drawn(seed);
    Chain chain = between(150, drawn);
    for (int i = 0; i < 3; ++i) chain.graph.nodes.push_back(copying(0, 150));
    chain.graph.nodes.push_back(sink(drawn.stalls(150)));
    chain.graph.edges = {drawn.stream(0, (chain.threads & 1u) != 0),
                         link(1, 2).deep(1 + drawn.below(3)).offsets(drawn.below(2), 1),
                         link(2, 3).deep(1 + drawn.below(3)).offsets(drawn.below(2), 1),
                         drawn.stream(3, (chain.threads & 2u) != 0)};
    chain.at_pins = {false, false, false, false};
    ASSERT_EQ(against_reference(chain), "") << "seed " << seed;
  }
}

}  // namespace pin_dates_test
}  // namespace parallax::test
