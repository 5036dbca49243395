// SPDX-License-Identifier: Apache-2.0
// The dates of the real machine's pipeline, all streams and all tokens, against the per-token reference.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <sstream>

#include "tests/timing/graph_classes.hpp"
#include "tests/timing/in_child.hpp"
#include "tests/timing/random_pipeline.hpp"
#include "tests/timing/reference_simulation.hpp"

namespace parallax::test {
namespace pipeline_reference_test {

constexpr std::uint64_t kFrames = 2;

struct Outcome {
  bool stuck = false;
  std::string differences;
};

Outcome compare(Depths depths) {
  const PipelineCase c = random_pipeline(depths, kFrames);
  const auto leap_interval =
      *rc::gen::element<std::uint64_t>(1, 50, Dataflow::kLeapInterval, std::uint64_t{1} << 40);
  Outcome outcome;
  outcome.differences = in_child([&] {
    PipelineSimulation simulation(c, leap_interval);
    const std::vector<EdgeDates> actual = simulation.run();
    const Graph graph = simulation.graph();
    const std::vector<EdgeDates> expected = ReferenceSimulation(graph).run();
    std::string text = differences(expected, actual);
    const bool stuck = is_stuck(graph, expected);
    if (stuck && simulation.dataflow().deadlock().empty()) text += "no cycle of waits is named\n";
    if (!stuck && !simulation.dataflow().deadlock().empty()) text += "a cycle of waits without deadlock\n";
    if (!text.empty() || (stuck && depths == Depths::kAutomatic)) {
      std::ostringstream description;
      description << text << describe(simulation.dataflow().deadlock()) << graph;
      text = description.str();
    }
    return (stuck ? "!" : " ") + text;
  });
  outcome.stuck = outcome.differences.substr(0, 1) == "!";
  outcome.differences.erase(0, 1);
  return outcome;
}

// When the last bursts left.
std::string last_dates(const PipelineSimulation& simulation) {
  std::ostringstream text;
  for (std::size_t i = 0; i < simulation.dates().size(); ++i) {
    if (std::string(simulation.dataflow().streams()[i]->basename()) != "output_bursts") continue;
    for (const std::int64_t date : simulation.dates()[i].read) text << date << " ";
  }
  return text.str();
}
std::string last_dates(const PipelineCase& c) {
  PipelineSimulation simulation(c);
  simulation.run();
  return last_dates(simulation);
}

RC_GTEST_PROP(PipelineReference, EveryDateWithAutomaticDepthsAndNeverADeadlock, ()) {
  const Outcome outcome = compare(Depths::kAutomatic);
  if (outcome.stuck || outcome.differences != "") RC_FAIL(outcome.differences);
}

RC_GTEST_PROP(PipelineReference, EveryDateWithAnyDepthsAndTheSameDeadlocks, ()) {
  const Outcome outcome = compare(Depths::kRandom);
  RC_CLASSIFY(outcome.stuck, "deadlock");
  RC_ASSERT(outcome.differences == "");
}

// Where nothing stalls, deeper FIFOs on the paths that meet again would not let a frame leave any earlier.
// (They could let the next one, or the next tile, begin while this one is flushed.)
RC_GTEST_PROP(PipelineReference, AutomaticDepthsCostNoCycle, ()) {
  PipelineCase c = random_pipeline(Depths::kAutomatic, 1, 1, 1);
  // A token a cycle needs slots for the way there and back.
  for (const StreamKind& stream : c.config.streams.kinds) {
    const FifoOffsets offsets = c.config.streams.offsets(stream.name);
    c.config.streams.default_depth =
        std::max(offsets.write_to_read + offsets.read_to_write, c.config.streams.default_depth);
  }
  for (auto* stalls : {&c.left, &c.right, &c.map_stalls, &c.output}) {
    std::fill(stalls->begin(), stalls->end(), 0u);
  }
  PipelineTiming& time = c.config.timing;
  for (StageTiming* timing : {&time.map_decoder, &time.rectification, &time.census, &time.matching,
                              &time.subpixel, &time.uniqueness, &time.consistency, &time.texture,
                              &time.speckle, &time.gap_interpolation, &time.noise_reduction}) {
    *timing = {1, timing->latency, 0, 0};
  }
  PipelineCase deep = c;
  for (StreamDepth& stream : deep.config.streams.depths) {
    for (const char* name :
         {"left_texture", "left_output", "costs_uniqueness", "costs_consistency", "consistent"}) {
      if (stream.name == name) stream.tokens = 100000;
    }
  }
  const std::string text = in_child([&] {
    const std::string other = in_child([&] { return last_dates(deep); });
    PipelineSimulation simulation(c);
    simulation.run();
    const std::string own = last_dates(simulation);
    std::ostringstream description;
    if (own != other) description << simulation.graph() << "\n" << own << "\n" << other;
    return description.str();
  });
  if (!text.empty()) RC_FAIL(text);
}

}  // namespace pipeline_reference_test
}  // namespace parallax::test
