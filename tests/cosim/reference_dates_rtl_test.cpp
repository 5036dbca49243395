// SPDX-License-Identifier: Apache-2.0
// The reference circuits (modules/rtl) against the stages that they are circuits of: the same stalls on both
// sides, every date of every FIFO, every value.
#include <CensusCircuit.h>
#include <MatchingCircuit.h>
#include <MedianCircuit.h>
#include <NoiseReductionCircuit.h>
#include <RectificationCircuit.h>
#include <SlowCensusCircuit.h>
#include <SlowMatchingCircuit.h>
#include <SubpixelCircuit.h>
#include <UniquenessCircuit.h>
#include <gtest/gtest.h>

#include "modules/census_stage.hpp"
#include "modules/matching_stage.hpp"
#include "modules/noise_reduction_stage.hpp"
#include "modules/rectification_stage.hpp"
#include "modules/subpixel_stage.hpp"
#include "modules/uniqueness_stage.hpp"
#include "tests/cli/program.hpp"
#include "tests/cosim/circuit_bench.hpp"
#include "tests/cosim/rtl_bench.hpp"

namespace parallax::test {
namespace reference_dates_rtl_test {

constexpr int kWidth = 32, kHeight = 16;
constexpr int kCodeBits = 24;

// The schedule and latency of a stage that `make(name, context)` makes, as a node of a graph. A process has
// one simulation, and a stage without streams cannot be simulated: it is made in a process of its own, which
// ends without taking it down.
template <class Make>
GraphNode node_of(const Make& make) {
  const std::string told = in_child([&] {
    const auto* const clock = new ClockDomain("clock", Hertz(100'000'000));
    auto* const dataflow = new Dataflow("dataflow");
    const Stage* const made = make("stage", StageContext{*clock, *dataflow, kWidth, kHeight}).release();
    std::string text = std::to_string(made->latency());
    for (const Schedule::Segment& segment : made->schedule().segments()) {
      text += fmt::format(" {} {}", segment.repeat, segment.phase_count);
      for (std::uint32_t i = 0; i < segment.phase_count; ++i) {
        const Phase& phase = made->schedule().phases()[segment.first_phase + i];
        text +=
            fmt::format(" {} {} {} {}", phase.count, phase.interval, int{phase.consume}, int{phase.produce});
      }
    }
    return text;
  });
  std::istringstream numbers(told);
  GraphNode node;
  numbers >> node.latency;
  std::uint32_t phases = 0;
  for (GraphPart part; numbers >> part.repeat >> phases; node.parts.push_back(part)) {
    part.phases.clear();
    for (; phases > 0; --phases) {
      std::uint64_t count = 0;
      std::uint32_t interval = 0;
      unsigned consume = 0, produce = 0;
      numbers >> count >> interval >> consume >> produce;
      part.phases.push_back(fires(count).reads(consume).writes(produce).every(interval));
    }
  }
  return node;
}

struct Run {
  std::uint32_t seed;  // 0: no stalls
  std::uint32_t depth;
};

// What differs; empty if nothing. `ports(top)`: in the stage's order; `files`: their vectors.
template <class Top, class Ports, class Make>
std::string against_stage(const std::string& vectors, const std::vector<const char*>& files,
                          const Ports& ports_of, const Make& make) {
  const Program program;
  const Outcome written =
      program(fmt::format("vectors {} --size {}x{} --frames 2 --out v -q", vectors, kWidth, kHeight));
  if (written.code != 0) return written.err;
  const GraphNode node = node_of(make);
  std::string text;
  for (const Run run :
       {Run{0, 2}, Run{0, 1}, Run{1, 2}, Run{2, 1}, Run{3, 3}, Run{4, 7}, Run{5, 40}, Run{6, 2}}) {
    text += in_child([&] {
      Top top;
      std::vector<CircuitPort> ports = ports_of(top);
      Graph graph;
      graph.periods = {1};
      graph.nodes = {node};
      int inputs = 0, outputs = 0;
      for (std::size_t i = 0; i < ports.size(); ++i) {
        CircuitPort& port = ports[i];
        port.tokens = tokens_of(program.read("v/" + std::string(files[i]) + ".memh"));
        port.stalls = run.seed == 0
                          ? no_stalls(port.tokens.size())
                          : rtl_stalls(port.tokens.size(), 31 * run.seed + static_cast<std::uint32_t>(i));
        const int end = static_cast<int>(i) + 1;
        graph.nodes.push_back(port.offer ? source(port.stalls) : sink(port.stalls));
        GraphEdge edge = port.offer ? link(end, 0).into(inputs++) : link(0, end).out_of(outputs++);
        graph.edges.push_back(edge.deep(run.depth).of_kind(FifoKind::kRegistered));
      }
      std::string found = run_circuit(top, ports, run.depth);
      const std::vector<EdgeDates> model = ModelSimulation(graph, 0, 10).run();
      std::vector<EdgeDates> circuit;
      for (std::size_t i = 0; i < ports.size(); ++i) {
        circuit.push_back(ports[i].dates);
        circuit.back().high_water = model[i].high_water;  // ports tell transfers only
        if (model[i].written.size() != ports[i].tokens.size()) found += "the model's tokens are others\n";
      }
      return found + differences(model, circuit);
    });
    if (!text.empty()) return fmt::format("seed {}, depth {}: {}", run.seed, run.depth, text);
  }
  return text;
}

template <class Top>
std::vector<CircuitPort> pair_to_pair(Top& top) {
  return {circuit_input(top.in_left_data, top.in_left_valid, top.in_left_ready),
          circuit_input(top.in_right_data, top.in_right_valid, top.in_right_ready),
          circuit_output(top.out_left_data, top.out_left_valid, top.out_left_ready),
          circuit_output(top.out_right_data, top.out_right_valid, top.out_right_ready)};
}

const std::vector<const char*> kCensusFiles{"left_rectified", "right_rectified", "left_codes", "right_codes"};

std::string census(const StageTiming& timing) {
  return against_stage<CensusCircuit>("--stage census -d 32", kCensusFiles, pair_to_pair<CensusCircuit>,
                                      [&](const char* name, const StageContext& context) {
                                        return std::make_unique<CensusStage>(name, CensusConfig{}, timing,
                                                                             context);
                                      });
}

TEST(ReferenceDatesRtl, Census) { EXPECT_EQ(census({1, 4}), ""); }

TEST(ReferenceDatesRtl, AnotherLatencyOrIntervalShows) {
  EXPECT_NE(census({1, 5}).find("edge 2 written token 0: expected "), std::string::npos);
  EXPECT_NE(census({2, 4}).find("edge 0 read token 1: expected "), std::string::npos);
}

TEST(ReferenceDatesRtl, CensusOfOtherWindowAndPace) {
  CensusConfig config;
  config.window_width = 3;
  config.window_height = 7;
  EXPECT_EQ(against_stage<SlowCensusCircuit>(
                "--stage census -d 32 -s census.window_width=3 -s census.window_height=7", kCensusFiles,
                pair_to_pair<SlowCensusCircuit>,
                [&](const char* name, const StageContext& context) {
                  return std::make_unique<CensusStage>(name, config, StageTiming{3, 9}, context);
                }),
            "");
}

template <class Top>
std::string matching(int parallelism, int iterations, const StageTiming& timing) {
  MatchingConfig config;
  config.parallelism = parallelism;
  config.iterations = iterations;
  return against_stage<Top>(
      fmt::format("--stage matching -s matching.parallelism={} -s matching.iterations={}", parallelism,
                  iterations),
      {"left_codes", "right_codes", "costs_subpixel"},
      [](Top& top) -> std::vector<CircuitPort> {
        return {circuit_input(top.in_left_data, top.in_left_valid, top.in_left_ready),
                circuit_input(top.in_right_data, top.in_right_valid, top.in_right_ready),
                circuit_output(top.out_costs_data, top.out_costs_valid, top.out_costs_ready)};
      },
      [&](const char* name, const StageContext& context) {
        return std::make_unique<MatchingStage>(name, config, kCodeBits, timing, context);
      });
}

TEST(ReferenceDatesRtl, Matching) { EXPECT_EQ(matching<MatchingCircuit>(4, 3, {1, 24}), ""); }

TEST(ReferenceDatesRtl, MatchingOfOtherPace) { EXPECT_EQ(matching<SlowMatchingCircuit>(6, 2, {2, 5}), ""); }

constexpr const char* kTwelveDisparities = "-s matching.parallelism=4 -s matching.iterations=3";
constexpr DisparityRange kRange{0, 12};
constexpr CostGroups kGroups{3, 1};

TEST(ReferenceDatesRtl, Subpixel) {
  EXPECT_EQ(
      against_stage<SubpixelCircuit>(
          fmt::format("--stage subpixel {}", kTwelveDisparities), {"costs_subpixel", "winners"},
          [](SubpixelCircuit& top) -> std::vector<CircuitPort> {
            return {circuit_input(top.in_costs_data, top.in_costs_valid, top.in_costs_ready),
                    circuit_output(top.out_disparity_data, top.out_disparity_valid, top.out_disparity_ready)};
          },
          [](const char* name, const StageContext& context) {
            return std::make_unique<SubpixelStage>(name, SubpixelConfig{}, kRange, kGroups,
                                                   StageTiming{1, 16}, context);
          }),
      "");
}

TEST(ReferenceDatesRtl, Uniqueness) {
  EXPECT_EQ(
      against_stage<UniquenessCircuit>(
          fmt::format("--stage uniqueness {}", kTwelveDisparities), {"costs_uniqueness", "winners", "unique"},
          [](UniquenessCircuit& top) -> std::vector<CircuitPort> {
            return {circuit_input(top.in_costs_data, top.in_costs_valid, top.in_costs_ready),
                    circuit_input(top.in_disparity_data, top.in_disparity_valid, top.in_disparity_ready),
                    circuit_output(top.out_disparity_data, top.out_disparity_valid, top.out_disparity_ready)};
          },
          [](const char* name, const StageContext& context) {
            return std::make_unique<UniquenessStage>(name, UniquenessConfig{}, kRange, kGroups,
                                                     StageTiming{1, 4}, context);
          }),
      "");
}

TEST(ReferenceDatesRtl, Rectification) {
  RectificationConfig config;
  config.range.window = 9;
  EXPECT_EQ(against_stage<RectificationCircuit>(
                "--stage rectification -d 32 -s rectification.window=9",
                {"left_pixels", "right_pixels", "map_entries", "left_rectified", "right_rectified"},
                [](RectificationCircuit& top) {
                  std::vector<CircuitPort> ports = pair_to_pair(top);
                  ports.insert(ports.begin() + 2,
                               circuit_input(top.in_map_data, top.in_map_valid, top.in_map_ready));
                  return ports;
                },
                [&](const char* name, const StageContext& context) {
                  return std::make_unique<RectificationStage>(name, config, StageTiming{1, 10}, context);
                }),
            "");
}

template <class Top>
std::string noise_reduction(const std::string& vectors, const NoiseReductionConfig& config) {
  return against_stage<Top>(
      "--stage noise_reduction -d 32 " + vectors, {"interpolated", "smoothed"},
      [](Top& top) -> std::vector<CircuitPort> {
        return {circuit_input(top.in_disparity_data, top.in_disparity_valid, top.in_disparity_ready),
                circuit_output(top.out_disparity_data, top.out_disparity_valid, top.out_disparity_ready)};
      },
      [&](const char* name, const StageContext& context) {
        return std::make_unique<NoiseReductionStage>(name, config, StageTiming{1, 8}, context);
      });
}

TEST(ReferenceDatesRtl, NoiseReduction) { EXPECT_EQ(noise_reduction<NoiseReductionCircuit>("", {}), ""); }

TEST(ReferenceDatesRtl, Median) {
  NoiseReductionConfig config;
  config.kind = NoiseReductionKind::kMedian3x3;
  EXPECT_EQ(noise_reduction<MedianCircuit>("-s noise_reduction.kind=median_3x3 -s subpixel.mask_border=false",
                                           config),
            "");
}

}  // namespace reference_dates_rtl_test
}  // namespace parallax::test
