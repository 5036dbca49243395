// SPDX-License-Identifier: Apache-2.0
// Where paths of the pipeline fork and meet again its FIFOs are as deep as a formula by hand said.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/modules/random_maps.hpp"
#include "tests/paths.hpp"
#include "tests/timing/in_child.hpp"
#include "tests/timing/machine_bench.hpp"
#include "tests/timing/pipeline_simulation.hpp"

namespace parallax::test {
namespace pipeline_depths_test {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> parts;
  std::istringstream in(line);
  for (std::string part; std::getline(in, part, ';');) {
    parts.push_back(part.substr(std::min(part.size(), part.find_first_not_of(' '))));
  }
  return parts;
}

std::string depths_of(const PipelineSimulation& simulation) {
  std::ostringstream text;
  for (const char* name :
       {"left_texture", "left_output", "costs_uniqueness", "costs_consistency", "consistent"}) {
    for (const StreamBase* stream : simulation.dataflow().streams()) {
      if (stream->basename() == std::string(name)) text << stream->depth() << " ";
    }
  }
  return text.str();
}

TEST(PipelineDepths, AreThoseOfTheFormulaByHand) {
  std::ifstream table(source_path("tests/timing/pipeline_depths.txt"));
  int rows = 0;
  for (std::string line; std::getline(table, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::vector<std::string> parts = split(line);
    int width = 0;
    int height = 0;
    char times = 0;
    std::istringstream(parts.front()) >> width >> times >> height;
    const std::string expected = parts.back() + " ";
    const std::vector<std::string> assignments(parts.begin() + 1, parts.end() - 1);
    const std::string actual = in_child([&] {
      PipelineCase c;
      c.config = preset(assignments);
      c.map = encode(identity_map(width, height, c.config.rectification.range));
      c.tiles = one_tile(width);
      return depths_of(PipelineSimulation(c));
    });
    EXPECT_EQ(actual, expected) << line;
    ++rows;
  }
  EXPECT_EQ(rows, 90);
}

}  // namespace pipeline_depths_test
}  // namespace parallax::test
