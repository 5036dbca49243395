// SPDX-License-Identifier: Apache-2.0
// The streams that the estimate plans are those of the pipeline that is built: names, depths and widths.
#include "platform/estimate/pipeline_plan.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "tests/modules/random_maps.hpp"
#include "tests/paths.hpp"
#include "tests/timing/in_child.hpp"
#include "tests/timing/machine_bench.hpp"
#include "tests/timing/pipeline_simulation.hpp"

namespace parallax::test {
namespace pipeline_plan_test {

std::string line_of(const std::string& name, std::int64_t depth, std::int64_t bits) {
  return name + " " + std::to_string(depth) + " x " + std::to_string(bits) + "\n";
}

std::string text(const std::set<std::string>& lines) {
  std::string all;
  for (const std::string& line : lines) all += line;
  return all;
}

std::string planned(const MachineConfig& config, int width, int height) {
  std::set<std::string> lines;
  for (const PlannedStream& stream : plan_streams(config, width, height))
    lines.insert(line_of(stream.name, stream.depth, stream.bits));
  return text(lines);
}

// But for those between the stages and the memory, and within a stage.
std::string built(const MachineConfig& config, int width, int height) {
  return in_child([&] {
    PipelineCase c;
    c.config = config;
    c.map = encode(identity_map(width, height, config.rectification.range));
    c.tiles = one_tile(width);
    std::set<std::string> names;
    for (const StreamDepth& stream : config.streams.depths) names.insert(stream.name);
    const PipelineSimulation simulation(c);
    std::set<std::string> lines;
    for (const StreamBase* stream : simulation.dataflow().streams()) {
      if (names.count(stream->basename()) == 0) continue;
      lines.insert(line_of(stream->basename(), stream->depth(), stream->width().count()));
    }
    return text(lines);
  });
}

void expect_as_built(const std::vector<std::string>& assignments, int width, int height) {
  const MachineConfig config = preset(assignments);
  const std::string machine = built(config, width, height);
  EXPECT_NE(machine.find("left_output"), std::string::npos) << machine;
  EXPECT_EQ(planned(config, width, height), machine) << testing::PrintToString(assignments);
}

TEST(PipelinePlan, HasTheStreamsThatAreBuilt) {
  expect_as_built({}, 64, 48);
  expect_as_built({"pipeline.overlap_frames=true"}, 64, 48);
  expect_as_built({"pipeline.pixels_per_token=4"}, 64, 48);
  expect_as_built({"matching.paths=\"w, nw, n, ne, e, sw, s, se\"", "matching.path_storage=memory"}, 64, 48);
}

TEST(PipelinePlan, HasThemInManyMachines) {
  constexpr int kEvery = 9;  // a row of the table
  std::ifstream table(source_path("tests/timing/pipeline_depths.txt"));
  int row = 0;
  for (std::string line; std::getline(table, line);) {
    if (line.empty() || line.front() == '#' || row++ % kEvery != 0) continue;
    std::istringstream parts(line);
    int width = 0;
    int height = 0;
    char times = 0;
    parts >> width >> times >> height;
    std::vector<std::string> assignments;
    std::getline(parts, line, ';');
    for (std::string part; std::getline(parts, part, ';');) {
      if (part.find('=') != std::string::npos) assignments.push_back(part.substr(1));
    }
    expect_as_built(assignments, width, height);
  }
  EXPECT_GT(row, 80);
}

}  // namespace pipeline_plan_test
}  // namespace parallax::test
