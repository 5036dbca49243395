// SPDX-License-Identifier: Apache-2.0
// The depths said to free a stuck graph are enough, and the least that are: the model itself runs with them,
// and is stuck with one token less.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <map>
#include <sstream>
#include <string>

#include "platform/results/deadlock_report.hpp"
#include "tests/timing/graph_classes.hpp"
#include "tests/timing/in_child.hpp"
#include "tests/timing/machine_bench.hpp"
#include "tests/timing/model_simulation.hpp"
#include "tests/timing/random_graph.hpp"
#include "tests/timing/random_pipeline.hpp"
#include "tlm/deadlock.hpp"

namespace parallax::test {
namespace deadlock_remedy_test {

constexpr std::uint32_t kDeep = 100'000;  // holds all tokens that pass in these tests

using DepthOf = std::map<std::string, std::uint32_t>;  // by the stream's own name

// What a simulation found. It ran in a process of its own, so this travels as text.
struct Found {
  bool stuck = false;
  bool named = false;  // the circle of waits that is named is one that the remedy breaks
  std::string obstacle;
  DepthOf remedy;
  DepthOf depths;  // as they were
  std::map<std::string, std::int64_t> bits;
};

std::string text(bool stuck, const Dataflow& dataflow, std::uint64_t frames) {
  const Remedy remedy = smallest_remedy(dataflow, frames);
  bool named = false;
  for (const Remedy::Depth& depth : remedy.depths) {
    for (const Wait& wait : dataflow.deadlock()) named |= wait.on_full && wait.stream == depth.stream;
  }
  std::ostringstream out;
  out << stuck << " " << named << "\n" << remedy.obstacle << "\n" << remedy.depths.size();
  for (const Remedy::Depth& depth : remedy.depths)
    out << " " << depth.stream->basename() << " " << depth.tokens;
  for (const StreamBase* stream : dataflow.streams()) {
    if (stream->inside_stage()) continue;  // has no depth to choose
    out << " " << stream->basename() << " " << stream->depth() << " " << stream->width().count();
  }
  return out.str();
}

Found parse(const std::string& text) {
  Found found;
  std::istringstream in(text);
  std::size_t raised = 0;
  std::string name;
  std::uint32_t depth = 0;
  in >> found.stuck >> found.named;
  in.ignore();
  std::getline(in, found.obstacle);
  for (in >> raised; raised > 0 && in >> name >> depth; --raised) found.remedy[name] = depth;
  while (in >> name >> depth >> found.bits[name]) found.depths[name] = depth;
  found.bits.erase("");
  return found;
}

struct Counts {
  int cases = 0, stuck = 0, several = 0;
};

// Checks what was found; `run(depths)` simulates the same with other depths.
template <class Run>
void check(const Found& found, Counts& counts, const Run& run) {
  ++counts.cases;
  RC_ASSERT(found.obstacle == "");
  RC_ASSERT(found.stuck != found.remedy.empty());
  if (!found.stuck) return;
  ++counts.stuck;
  RC_ASSERT(found.named);
  RC_ASSERT(!run(found.remedy).stuck);
  for (const auto& [stream, tokens] : found.remedy) {
    RC_ASSERT(tokens > found.depths.at(stream));
    DepthOf less = found.remedy;
    less[stream] = tokens - 1;
    RC_ASSERT(run(less).stuck);
  }
  // No other stream frees it alone, or only for as many bits or more.
  const bool alone = found.remedy.size() == 1;
  counts.several += alone ? 0 : 1;
  for (const auto& [other, depth] : found.depths) {
    if (alone && found.remedy.count(other) != 0) continue;
    std::uint32_t raised = kDeep;
    if (alone) {
      const auto& [stream, tokens] = *found.remedy.begin();
      const std::int64_t cost = (tokens - found.depths.at(stream)) * found.bits.at(stream);
      raised = depth + static_cast<std::uint32_t>((cost - 1) / found.bits.at(other));
    }
    if (raised > depth) RC_ASSERT(run({{other, raised}}).stuck);
  }
}

// Runs `property` on so many times as many samples as usual; says what they were.
template <class Property>
void check_often(const char* what, int times, Counts& counts, const Property& property) {
  rc::detail::TestParams params = rc::detail::configuration().testParams;
  params.maxSuccess *= times;
  const auto result = rc::detail::checkTestable(property, rc::detail::TestMetadata{}, params);
  std::ostringstream report;
  rc::detail::printResultMessage(result, report);
  std::cout << report.str() << "\nof " << counts.cases << " " << what << " " << counts.stuck << " deadlock, "
            << counts.several << " need more than one stream\n";
  ASSERT_TRUE(result.template is<rc::detail::SuccessResult>()) << report.str();
}

// Frames that the sources bring.
std::uint64_t frames(const Graph& graph) {
  for (const GraphEdge& edge : graph.edges) {
    const GraphNode& from = graph.nodes[static_cast<std::size_t>(edge.from)];
    const GraphNode& to = graph.nodes[static_cast<std::size_t>(edge.to)];
    if (from.kind != GraphNode::Kind::kSource || to.kind != GraphNode::Kind::kStage) continue;
    return from.stalls.size() / schedule_of(to).consumed(static_cast<unsigned>(edge.to_port));
  }
  return 1;
}

TEST(DeadlockRemedy, RandomGraphs) {
  Counts counts;
  check_often("graphs", 10, counts, [&counts] {
    const Graph graph = RandomGraph::make();
    const auto threads = *rc::gen::arbitrary<std::uint64_t>();
    const auto run = [&](const DepthOf& depths) {
      Graph other = graph;
      for (const auto& [name, depth] : depths) other.edges[std::stoul(name.substr(1))].depth = depth;
      return parse(in_child([&] {
        ModelSimulation model(other, threads);
        const bool stuck = is_stuck(other, model.run());
        return text(stuck, model.dataflow(), frames(other));
      }));
    };
    check(run({}), counts, run);
  });
  if (counts.cases >= 500) {  // else too few to tell
    EXPECT_GT(counts.stuck, counts.cases / 30);
  }
}

// The machine's pipeline, with one or more of the FIFOs that bridge a look-ahead made shallow.
TEST(DeadlockRemedy, RandomPipelines) {
  constexpr std::uint64_t kFrames = 2;
  Counts counts;
  check_often("pipelines", 3, counts, [&counts] {
    PipelineCase c = random_pipeline(Depths::kRandom, kFrames);
    const auto set = [](MachineConfig& config, const DepthOf& depths) {
      for (StreamDepth& stream : config.streams.depths) {
        if (const auto depth = depths.find(stream.name); depth != depths.end()) stream.tokens = depth->second;
      }
    };
    DepthOf shallow;
    for (const char* name :
         {"left_texture", "left_output", "costs_uniqueness", "costs_consistency", "consistent"}) {
      if (number(0, 2) == 0) shallow[name] = count(1, 40);
    }
    set(c.config, shallow);
    const auto run = [&](const DepthOf& depths) {
      PipelineCase other = c;
      set(other.config, depths);
      Found found = parse(in_child([&] {
        PipelineSimulation simulation(other);
        const std::vector<EdgeDates> dates = simulation.run();
        return text(is_stuck(simulation.graph(), dates), simulation.dataflow(), kFrames);
      }));
      for (const char* end : {"left_bursts", "right_bursts", "map_bursts", "output_bursts"}) {
        found.depths.erase(end);  // has no key of its own, and lies on no circle
      }
      return found;
    };
    check(run({}), counts, run);
  });
  if (counts.cases >= 200) {
    EXPECT_GT(counts.stuck, counts.cases / 4);
    EXPECT_GT(counts.several, 0);
  }
}

// What Pipeline computes for FIFOs that bridge a look-ahead is never too little: no model has to run for
// that, so images and look-aheads can be larger than elsewhere.
RC_GTEST_PROP(DeadlockRemedy, AutomaticDepthsNeedNone, ()) {
  PipelineCase c = random_pipeline(Depths::kAutomatic, 0);
  MachineConfig& config = c.config;
  const int pixels = config.timing.pixels_per_token;
  const int width = pixels * number(1, 300 / pixels);
  const int height = number(1, 100);
  config.census.window_height = 2 * number(0, (64 / config.census.window_width - 1) / 2) + 1;
  config.texture.window = 2 * number(1, 7) + 1;
  const int noise_window = 2 * number(1, 3) + 1;
  if (config.noise_reduction.kind == NoiseReductionKind::kMean) config.noise_reduction.window = noise_window;
  config.gap_interpolation.l_max = number(0, 20);
  config.matching.parallelism = number(1, 32);
  config.matching.iterations = number(1, 8);
  if (config.matching.parallel_rows > 1)
    config.matching.parallel_rows = random_rows(config.matching.iterations, pixels);
  PipelineTiming& time = config.timing;
  for (StageTiming* timing :
       {&time.rectification, &time.census, &time.matching, &time.subpixel, &time.uniqueness,
        &time.consistency, &time.texture, &time.speckle, &time.gap_interpolation, &time.noise_reduction}) {
    if (number(0, 3) == 0) timing->latency = count(0, 1000);
  }
  c.tiles = random_tiles(width, 3);
  const int rows = height * static_cast<int>(c.tiles.tiles.size());
  c.map = encode(identity_map(width, rows, config.rectification.range));
  const std::string needed = in_child([&] {
    PipelineSimulation simulation(c);
    sc_core::sc_start(sc_core::SC_ZERO_TIME);
    return text(false, simulation.dataflow(), 3);
  });
  const Found found = parse(needed);
  if (found.depths.empty() || found.obstacle != "" || !found.remedy.empty()) RC_FAIL(needed);
}

// The whole machine at its largest image and 256 disparities.
struct Large {
  const char* stream;
  std::uint32_t depth;
  std::uint32_t needed;
};
class LargeMachine : public testing::TestWithParam<Large> {
 protected:
  /// What `action` returns for the machine, stuck or through with one frame, when the stream has that depth.
  template <class Action>
  std::string run(std::uint32_t tokens, const Action& action) {
    MachineConfig config = preset({"matching.iterations=8", "tiles.limit=1856"});
    for (StreamDepth& stream : config.streams.depths) {
      if (stream.name == GetParam().stream) stream.tokens = tokens;
    }
    return in_child([&] {
      const EncodedMap map = encode(identity_map(1856, 1856, config.rectification.range));
      MachineInput input;
      input.width = 1856;
      input.height = 1856;
      input.map = &map;
      input.expose = [](std::int64_t) { return StereoFrame{}; };
      const Machine machine("machine", config, input);
      sc_core::sc_start();
      return action(machine);
    });
  }
};

TEST_P(LargeMachine, TellsWhatFreesItInUnderASecond) {
  const std::string said = run(GetParam().depth, [](const Machine& machine) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    std::string text = message(find_deadlock(machine));
    const double ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    std::cerr << text << "told in " << ms << " ms\n";
    if (ms > 1000) text += "slow";
    return text.substr(text.rfind("\n  ") + 1);
  });
  const Large& large = GetParam();
  EXPECT_EQ(said, fmt::format("  streams.{}.depth = {} would free it (now {})\n", large.stream, large.needed,
                              large.depth));
}

TEST_P(LargeMachine, GetsThroughWithThatAndNotWithLess) {
  const auto finishes = [](const Machine& machine) { return std::string(machine.finished() ? "yes" : "no"); };
  EXPECT_EQ(run(GetParam().needed - 1, finishes), "no");
  EXPECT_EQ(run(GetParam().needed, finishes), "yes");
}

INSTANTIATE_TEST_SUITE_P(Streams, LargeMachine,
                         testing::Values(Large{"left_output", 16, 35527}, Large{"left_texture", 4, 256}));

}  // namespace deadlock_remedy_test
}  // namespace parallax::test
