// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/exploration_spec.hpp"

#include <gtest/gtest.h>

#include "platform/commands/timed_run.hpp"
#include "platform/explore/point_source.hpp"
#include "tests/platform/error_of.hpp"
#include "tests/platform/temporary_folder.hpp"

namespace parallax::test {
namespace exploration_spec_test {

ExplorationSpec read(const std::string& text) {
  const TemporaryFolder folder;
  return read_exploration_spec(folder.write("s.toml", text), timed_run_options());
}

/// What is wrong, without the folder's name.
std::string fault(const std::string& text) {
  const std::string line = error_of([&] {
    const ExplorationSpec spec = read(text);
    count_points(spec, 1'000'000);
  });
  return line.substr(std::min(line.find("s.toml"), line.size() - 1));
}

TEST(ExplorationSpec, HasItsAxesInTheOrderOfTheFile) {
  const ExplorationSpec spec = read(R"(
[run]
size = "128x64"
rectified = true
[set]
software.response_ns = 0.0
[vary]
streams.default_depth = { from = 4, to = 20, factor = 2 }
clocks.core_hz = "100e6:150e6:25e6"
matching.parallelism = [16, 32]
disparities = [64, "128:192:32"]
[objectives]
"performance/frame_rate" = "most"
"energy/frame_total" = "least"
)");
  ASSERT_EQ(spec.axes.size(), 4U);
  EXPECT_EQ(spec.axes[0].name, "streams.default_depth");
  EXPECT_EQ(spec.axes[0].values, (std::vector<std::string>{"4", "8", "16"}));
  EXPECT_EQ(spec.axes[1].values, (std::vector<std::string>{"100e6", "125e6", "150e6"}));
  EXPECT_EQ(spec.axes[2].values, (std::vector<std::string>{"16", "32"}));
  EXPECT_TRUE(spec.axes[3].option);
  EXPECT_EQ(spec.axes[3].values, (std::vector<std::string>{"64", "128", "160", "192"}));
  EXPECT_EQ(spec.objectives[0].metric, "performance/frame_rate");
  EXPECT_EQ(spec.objectives[1].metric, "energy/frame_total");
  EXPECT_EQ(command_words(spec.run), (std::vector<std::string>{"--size", "128x64", "--rectified"}));
  EXPECT_EQ(spec.assignments, std::vector<std::string>{"software.response_ns=0.0"});
  EXPECT_EQ(count_points(spec, 1000), 72U);
}

TEST(ExplorationSpec, WritesLargeNumbersShort) {
  EXPECT_EQ(read("[vary]\nclocks.core_hz = [150e6, 133333333.0, 133.5e6, 12345.5]").axes[0].values,
            (std::vector<std::string>{"150e6", "133333333.0", "133500e3", "12345.5"}));
}

TEST(PointSource, LinksKeysAndKeepsToConditions) {
  const ExplorationSpec spec = read(R"(
conditions = ["matching.iterations <= 8"]
[vary]
matching.parallelism = [8, 16, 32]
[link]
matching.iterations = "128 / matching.parallelism"
)");
  PointSource source(spec);
  EXPECT_EQ(spec.varied_names(), (std::vector<std::string>{"matching.parallelism", "matching.iterations"}));
  const auto first = source.next();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->number, 0U);
  EXPECT_EQ(first->values, (std::vector<std::string>{"16", "8"}));
  EXPECT_EQ(assignments_of(spec, *first),
            (std::vector<std::string>{"matching.parallelism=16", "matching.iterations=8"}));
  EXPECT_TRUE(source.next());
  EXPECT_FALSE(source.next());
}

TEST(PointSource, KnowsWhatIsTheSameAtEveryPointAndComparisonsAreTruths) {
  const ExplorationSpec spec = read(R"(
conditions = ["clocks.core_hz >= software.response_ns"]
[set]
software.response_ns = 150
[vary]
clocks.core_hz = [100, 200]
[link]
census.enabled = "clocks.core_hz > 2 * software.response_ns"
)");
  PointSource source(spec);
  const auto point = source.next();
  ASSERT_TRUE(point);
  EXPECT_EQ(point->values, (std::vector<std::string>{"200", "false"}));
  EXPECT_FALSE(source.next());
}

TEST(PointSource, DrawsAsManyAsAskedForWhateverTheConditions) {
  const ExplorationSpec spec = read(R"(
conditions = ["streams.default_depth % 2 = 0"]
[vary]
streams.default_depth = { from = 4, to = 400 }
[sampling]
method = "random"
points = 50
)");
  PointSource source(spec);
  for (int i = 0; i < 50; ++i) {
    const auto point = source.next();
    ASSERT_TRUE(point);
    EXPECT_EQ(std::stoi(point->values[0]) % 2, 0);
  }
  EXPECT_FALSE(source.next());
}

struct Wrong {
  const char* text;
  const char* line;
};

void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.text; }

class WrongSpec : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongSpec, IsOneLine) { EXPECT_EQ(fault(GetParam().text), GetParam().line); }

INSTANTIATE_TEST_SUITE_P(
    Of, WrongSpec,
    ::testing::Values(
        Wrong{"", "s.toml: nothing varies; [vary] says what does"},
        Wrong{"[varry]", "s.toml:1: unknown part varry; the nearest is vary"},
        Wrong{"vary = 3", "s.toml:1: vary: must be a table"},
        Wrong{"[vary]\nclock.core_hz = [1]",
              "s.toml:2: clock.core_hz: unknown key; the nearest is clocks.core_hz"},
        Wrong{"[vary]\nsizes = ['1x1']", "s.toml:2: sizes: unknown key; the nearest is size"},
        Wrong{"[vary]\nclocks.core_hz = []", "s.toml:2: clocks.core_hz: has no values"},
        Wrong{"[vary]\nclocks.core_hz = '1:2'",
              "s.toml:2: clocks.core_hz: '1:2' is no range: it must have the form start:stop:step, three "
              "numbers such "
              "as 10:100:5"},
        Wrong{"[vary]\nclocks.core_hz = [[1]]",
              "s.toml:2: clocks.core_hz: must be a number, true, false or text"},
        Wrong{"[vary]\nclocks.core_hz = { from = 1e6 }",
              "s.toml:2: clocks.core_hz: from and to are both needed"},
        Wrong{"[vary]\nclocks.core_hz = { from = 2e6, to = 1e6, factor = 2 }",
              "s.toml:2: clocks.core_hz: from must be below to"},
        Wrong{"[vary]\nclocks.core_hz = { from = 1e6, to = 2e6, steps = 2 }",
              "s.toml:2: steps: unknown; it may have from, to, step, factor and scale"},
        Wrong{"[vary]\nclocks.core_hz = { from = 1e6, to = 2e6, step = 1e5, factor = 2 }",
              "s.toml:2: clocks.core_hz: has one of step, factor and scale"},
        Wrong{"[vary]\nclocks.core_hz = { from = 1e6, to = 2e6, factor = 1 }",
              "s.toml:2: factor: must be above 1"},
        Wrong{"[vary]\nclocks.core_hz = { from = 1e6, to = 'x', factor = 2 }",
              "s.toml:2: to: must be a number"},
        Wrong{"[vary]\nclocks.core_hz = { from = -1.0, to = 2e6, scale = 'log' }",
              "s.toml:2: clocks.core_hz: from must be above 0 where each value is a multiple of another"},
        Wrong{"[vary]\nclocks.core_hz = { from = 1e6, to = 2e6, scale = 'ln' }",
              "s.toml:2: scale: must be \"linear\" or \"log\""},
        Wrong{"[vary]\nmatching.paths = { from = 1, to = 2 }",
              "s.toml:2: matching.paths: from and to are for keys that are numbers; list the values"},
        Wrong{"[vary]\nclocks.core_hz = { from = 1e6, to = 2e6 }",
              "s.toml:2: clocks.core_hz: a grid needs a step or a factor between from and to; or [sampling] "
              "another "
              "method"},
        Wrong{"[vary]\nsize = ['1x1']\n[run]\nsize = '2x2'",
              "s.toml:2: size: is given in line 4 too: a point's value of it has one source"},
        Wrong{"[vary]\nmatching.iterations = [1]\n[run]\ndisparities = 64",
              "s.toml:4: disparities and matching.iterations exclude each other: both set the range"},
        Wrong{"[run]\nsised = '1x1'",
              "s.toml:2: sised: no option of parallax run that bears on the time; the nearest is size"},
        Wrong{"[set]\nclocks.core_hz = 1\n[vary]\nclocks.core_hz = [1e6]",
              "s.toml:4: clocks.core_hz: is given in line 2 too: a point's value of it has one "
              "source"},
        Wrong{"[link]\nsize = '3'",
              "s.toml:2: size: is an option of parallax run, and only keys can be linked"},
        Wrong{"[set]\nclocks.core = 1", "s.toml:2: clocks.core: unknown key; the nearest is clocks.core_hz"},
        Wrong{"[link]\nclocks.core_hz = 5", "s.toml:2: clocks.core_hz: must be text, in quotes"},
        Wrong{"conditions = 'a'", "s.toml:1: conditions: must be an array"},
        Wrong{"conditions = ['a = 1']\n[vary]\nclocks.core_hz = [1e6]",
              "s.toml:1: 'a = 1': a is neither varied nor linked before; the nearest is clocks.core_hz"},
        Wrong{"[sampling]\nmethod = 'sobel'",
              "s.toml:2: method: 'sobel' is none of grid, one-at-a-time, random, latin-hypercube, sobol, "
              "search"},
        Wrong{"[vary]\nclocks.core_hz = [1e8, 2e8]\n[sampling]\nmethod = 'search'\npoints = 9",
              "s.toml: a search needs [objectives], [constraints] or both: what it searches for"},
        Wrong{"[sampling]\nmethod = 'sobol'",
              "s.toml:1: sampling: points = NUMBER is missing: how many to take"},
        Wrong{"[sampling]\npoints = 4",
              "s.toml:1: sampling: a grid has all points, and so has one-at-a-time; points goes with the "
              "others"},
        Wrong{"[sampling]\nmethod = 'sobol'\npoints = 0",
              "s.toml:3: points: must be a whole number from 1 to 1000000"},
        Wrong{"[sampling]\nsed = 4", "s.toml:2: sed: unknown; [sampling] has method, points and seed"},
        Wrong{"[constraints]\n'a/b' = {}", "s.toml:2: a/b: a constraint has at_least, at_most, or both"},
        Wrong{"[constraints]\n'a/b' = { at_least = 1, least = 1 }",
              "s.toml:2: least: unknown; a constraint has at_least, at_most, or both"},
        Wrong{"[constraints]\n'a/b' = { at_least = 2, at_most = 1 }",
              "s.toml:2: a/b: at_least is above at_most: nothing can satisfy that"},
        Wrong{"[vary]\nmatching.p1 = [5, 6]\n[link]\nmatching.p2 = '100 / (matching.p1 - 6)'",
              "s.toml:4: '100 / (matching.p1 - 6)' has no value, for matching.p2, where matching.p1 = 6"},
        Wrong{"[objectives]\n'a/b' = 'max'", "s.toml:2: a/b: must be \"most\" or \"least\""},
        Wrong{"conditions = ['clocks.core_hz > 1e9']\n[vary]\nclocks.core_hz = {from = 1e6, to = 2e6}\n"
              "[sampling]\nmethod = 'random'\npoints = 2",
              "s.toml:1: the conditions leave 0 of 2000 points that were drawn; 2 were asked for"}));

}  // namespace exploration_spec_test
}  // namespace parallax::test
