// SPDX-License-Identifier: Apache-2.0
// Explorations from the command line: what they find, and what survives an end at any moment.
#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "tests/cli/program.hpp"

namespace parallax {
namespace explore_test {

constexpr const char* kSpec = R"(
[run]
preset = "core-alone"
rectified = true
size = "64x48"
timing-frames = 2
[vary]
clocks.core_hz = { from = 100e6, to = 160e6, step = 20e6 }
streams.default_depth = [4, 8]
matching.parallelism = [16, 32]
[link]
matching.iterations = "64 / matching.parallelism"
[constraints]
"performance/frame_rate" = { at_least = 3000 }
[objectives]
"performance/frame_rate" = "most"
"energy/frame_total" = "least"
)";

nlohmann::json json_of(const test::Outcome& outcome) {
  return nlohmann::json::parse(outcome.out, nullptr, false);
}

int count(const test::Program& program, const std::string& query) {
  SQLite::Database database((program / "out/results.db").string());
  return database.execAndGet(query).getInt();
}

TEST(Explore, FindsTheFrontAndKnowsItsPointsNextTime) {
  const test::Program program;
  program.folder().write("s.toml", kSpec);
  const test::Outcome first = program("explore s.toml --out out --json");
  ASSERT_EQ(first.code, 0) << first.err;
  const nlohmann::json tree = json_of(first);
  EXPECT_EQ(tree["points"], 16);
  EXPECT_EQ(tree["evaluated"], 16);
  EXPECT_EQ(tree["statuses"]["done"], 16);
  EXPECT_EQ(program.files("out"), (std::vector<std::string>{"front.csv", "points.csv", "results.db"}));
  // A point is what the program measures when it runs it alone.
  const nlohmann::json point = tree["front"][0];
  const std::string command = point["command"];
  const test::Outcome alone = program(command.substr(command.find("run")) + " --json -q");
  const nlohmann::json timing = json_of(alone);
  EXPECT_EQ(timing["performance"]["frame_rate"]["value"],
            point["metrics"]["performance/frame_rate"]["value"]);
  EXPECT_EQ(timing["schema"]["configuration"]["value"], point["configuration"]);

  const nlohmann::json again = json_of(program("explore s.toml --out out --json"));
  EXPECT_EQ(again["evaluated"], 0);
  EXPECT_EQ(again["front"], tree["front"]);
  // Another exploration that meets some of the same points evaluates the others only.
  std::string other = kSpec;
  other.replace(other.find("[4, 8]"), 6, "[8, 12]");
  program.folder().write("s.toml", other);
  EXPECT_EQ(json_of(program("explore s.toml --out out --json"))["evaluated"], 8);
  // A number that was not kept is measured.
  other += "\"memory/row_hits\" = \"most\"\n";
  program.folder().write("s.toml", other);
  EXPECT_EQ(json_of(program("explore s.toml --out out --json"))["evaluated"], 16);
  EXPECT_EQ(count(program, "SELECT count(*) FROM result"), 24);
}

/// The specification with so many frames a point.
std::string with_frames(const std::string& frames) {
  std::string spec = kSpec;
  const std::string given = "timing-frames = 2";
  return spec.replace(spec.find(given), given.size(), "timing-frames = " + frames);
}

/// An exploration that takes minutes, once it has its database.
pid_t begin_long_one(const test::Program& program, const std::string& arguments) {
  program.folder().write("s.toml", with_frames("3000"));
  const pid_t child = program.start("explore s.toml --out out" + arguments);
  for (int i = 0; i < 500 && !std::filesystem::exists(program / "out/results.db"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return child;
}

// Ended at any moment, an exploration goes on where it was: all points come, none twice, and the tables are
// the same.
void end_at_any_moment(const std::string& spec) {
  const test::Program whole;
  whole.folder().write("s.toml", spec);
  const test::Outcome at_once = whole("explore s.toml --out out --json");
  ASSERT_EQ(at_once.code, 0) << at_once.err;
  std::mt19937 random(11);
  const test::Program program;
  program.folder().write("s.toml", spec);
  const auto known = [&program] {
    return std::filesystem::exists(program / "out/results.db") &&
                   count(program, "SELECT count(*) FROM sqlite_master") != 0
               ? count(program, "SELECT count(*) FROM result")
               : 0;
  };
  int before = 0;
  for (int round = 0; round < 6; ++round) {
    const pid_t child = program.start("explore s.toml --out out");
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 300));
    ::kill(child, SIGKILL);
    program.wait(child);
    EXPECT_GE(known(), before) << "nothing is lost";
    before = known();
  }
  const test::Outcome last = program("explore s.toml --out out --json");
  EXPECT_EQ(last.code, 0) << last.err;
  EXPECT_EQ(json_of(last)["evaluated"], json_of(at_once)["evaluated"].get<int>() - before)
      << "what is known is not evaluated again";
  EXPECT_EQ(program.read("out/points.csv"), whole.read("out/points.csv"));
  EXPECT_EQ(program.read("out/front.csv"), whole.read("out/front.csv"));
}

TEST(Explore, SurvivesItsEndAtAnyMoment) { end_at_any_moment(with_frames("12")); }

constexpr const char* kLargeSpace = R"(
[run]
preset = "core-alone"
rectified = true
size = "64x48"
timing-frames = 2
[vary]
clocks.core_hz = "50e6:200e6:10e6"
matching.parallelism = [4, 8, 16, 32]
streams.default_depth = [4, 8, 16, 32]
[link]
matching.iterations = "64 / matching.parallelism"
[constraints]
"performance/frame_rate" = { at_least = 3000 }
[objectives]
"resources/lut" = "least"
)";

TEST(Explore, SearchSurvivesItsEndAtAnyMoment) {
  end_at_any_moment(std::string(kLargeSpace) + "[sampling]\nmethod = 'search'\npoints = 40\n");
}

// The same least as all of the space has, from a quarter of it.
TEST(Explore, SearchesALargeSpace) {
  const test::Program program;
  program.folder().write("all.toml", kLargeSpace);
  program.folder().write("some.toml",
                         std::string(kLargeSpace) + "[sampling]\nmethod = 'search'\npoints = 64\n");
  const nlohmann::json all = json_of(program("explore all.toml --out all --json"));
  const test::Outcome outcome = program("explore some.toml --out some --json");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json some = json_of(outcome);
  EXPECT_EQ(all["points"], 256);
  EXPECT_EQ(some["points"], 64);
  EXPECT_EQ(some["machines"], 256);
  const auto least = [](const nlohmann::json& tree) { return tree["front"][0]["metrics"]["resources/lut"]; };
  EXPECT_EQ(least(some), least(all));
  EXPECT_GT(least(all)["value"], 0);
  EXPECT_NE(program("explore some.toml --out some")
                .out.find("\nchosen from         256 machines, conditions aside\n"),
            std::string::npos);
}

// Each number beside the runs themselves.
TEST(Explore, ShowsWhatMovesANumberMost) {
  const test::Program program;
  program.folder().write("s.toml", R"(
metrics = ["performance/frame_rate"]
[run]
preset = "core-alone"
rectified = true
size = "64x48"
timing-frames = 2
[vary]
clocks.core_hz = [100e6, 50e6, 200e6]
streams.default_depth = [16, 8]
matching.latency = [9, -1]
[sampling]
method = "one-at-a-time"
)");
  const test::Outcome outcome = program("explore s.toml --out out --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json tree = json_of(outcome);
  EXPECT_EQ(tree["points"], 5);
  const auto rate = [&program](const std::string& change) {
    return json_of(program(
        "run --timing-only -q --json --preset core-alone --rectified --size 64x48 --timing-frames 2 "
        "--set matching.latency=9 " +
        change))["performance"]["frame_rate"]["value"]
        .get<double>();
  };
  const double base = rate("--set clocks.core_hz=100e6 --set streams.default_depth=16");
  ASSERT_EQ(tree["sensitivities"].size(), 3U);
  const nlohmann::json clock = tree["sensitivities"][0];
  EXPECT_EQ(clock["varies"], "clocks.core_hz");
  EXPECT_EQ(clock["base"], base);
  EXPECT_EQ(clock["least"], rate("--set clocks.core_hz=50e6 --set streams.default_depth=16"));
  EXPECT_EQ(clock["at_least"], "50e6");
  EXPECT_EQ(clock["most"], rate("--set clocks.core_hz=200e6 --set streams.default_depth=16"));
  EXPECT_EQ(clock["at_most"], "200e6");
  for (const nlohmann::json& one : tree["sensitivities"]) {
    if (one["varies"] == "matching.latency") {
      EXPECT_EQ(one["least"], one["most"]) << "its other value is none";
    }
    if (one["varies"] != "streams.default_depth") continue;
    const double other = rate("--set clocks.core_hz=100e6 --set streams.default_depth=8");
    EXPECT_EQ(one["least"], std::min(base, other));
    EXPECT_EQ(one["most"], std::max(base, other));
  }
  EXPECT_NE(program("explore s.toml --out out").out.find("\n                number  "), std::string::npos);
  EXPECT_EQ(program.read("out/sensitivity.csv")
                .rfind("number,unit,varies,base,least,at_least,most,at_most\r\n"
                       "performance/frame_rate,frames/s,clocks.core_hz,",
                       0),
            0U);
}

TEST(Explore, StopsInAnOrderlyWay) {
  const test::Program program;
  const pid_t child = begin_long_one(program, " --json");
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  ::kill(child, SIGINT);
  const test::Outcome outcome = program.wait(child);
  EXPECT_EQ(outcome.code, 130);
  const nlohmann::json tree = json_of(outcome);
  ASSERT_TRUE(tree.is_object()) << outcome.out;
  EXPECT_LT(tree["there"], 16);
  EXPECT_NE(outcome.err.find(fmt::format("interrupted after {} of 16 points", tree["there"].get<int>())),
            std::string::npos)
      << outcome.err;
}

TEST(Explore, KeepsASecondOneOut) {
  const test::Program program;
  const pid_t child = begin_long_one(program, "");
  test::Program other;
  const test::Outcome second =
      other(fmt::format("explore {} --out {}", (program / "s.toml").string(), (program / "out").string()));
  ::kill(child, SIGINT);
  program.wait(child);
  EXPECT_EQ(second.code, 2);
  EXPECT_NE(second.err.find("another"), std::string::npos) << second.err;
}

TEST(Explore, ShowsTheNearestMiss) {
  const test::Program program;
  std::string spec = kSpec;
  spec.replace(spec.find("3000"), 4, "1e9 ");
  program.folder().write("s.toml", spec);
  const test::Outcome outcome = program("explore s.toml --out out");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.out.find("satisfied           0\nnearest             point "), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find(": performance/frame_rate is "), std::string::npos);
  EXPECT_NE(outcome.out.find(" fps, at least 1000000000 fps asked for\n"), std::string::npos) << outcome.out;
}

TEST(Explore, KeepsWhatCannotBeMeasuredAsRows) {
  const test::Program program;
  program.folder().write("s.toml", R"(
[run]
preset = "core-alone"
rectified = true
size = "64x48"
timing-frames = 2
[vary]
matching.iterations = [2, 100000]
streams.left_texture.depth = [4, 0]
)");
  const test::Outcome outcome = program("explore s.toml --out out --json");
  const nlohmann::json tree = json_of(outcome);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(tree["statuses"]["done"], 1) << outcome.out;
  EXPECT_EQ(tree["statuses"]["stuck"], 1);
  EXPECT_EQ(tree["statuses"]["invalid"], 2);
  EXPECT_EQ(tree["first_fault"]["point"], 0);
  EXPECT_NE(program("explore s.toml --out out")
                .out.find("\nnot measured        3; the first, point 0: streams.left_texture"),
            std::string::npos);
  const std::string table = program.read("out/points.csv");
  EXPECT_NE(table.find("would free it (now 4)"), std::string::npos) << table;
  EXPECT_NE(table.find("matching.iterations = 100000"), std::string::npos) << table;
}

// What a device has room for is a constraint like any other; its numbers are those of `parallax estimate`.
TEST(Explore, KnowsWhatFitsADevice) {
  const test::Program program;
  program.folder().write("s.toml", R"(
device = "zynq-7020"
[run]
preset = "core-alone"
rectified = true
size = "64x48"
timing-frames = 2
[set]
matching.iterations = 1
[vary]
matching.parallelism = [8, 32, 256]
[constraints]
"devices/zynq_7020/fits" = { at_least = 1 }
[objectives]
"resources/lut" = "least"
)");
  const test::Outcome outcome = program("explore s.toml --out out --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json point = json_of(outcome)["front"][0];
  EXPECT_EQ(point["settings"]["matching.parallelism"], "8");
  EXPECT_EQ(json_of(outcome)["satisfied"], 2) << "256 lanes do not";
  const nlohmann::json estimate =
      json_of(program("estimate --preset core-alone --size 64x48 --set matching.iterations=1 --set "
                      "matching.parallelism=8 --json"));
  EXPECT_EQ(estimate["resources"]["lut"]["value"], point["metrics"]["resources/lut"]["value"]);
}

TEST(Explore, KnowsTheDeviceNearestToAName) {
  const test::Program program;
  program.folder().write("s.toml", "device = 'zynq-7021'\n" + std::string(kSpec));
  const test::Outcome outcome = program("explore s.toml --out out");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("; the nearest is zynq-7020\n"), std::string::npos) << outcome.err;
}

struct Wrong {
  const char* replaced;
  const char* by;
  const char* line;
};

void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.by; }

class WrongExploration : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongExploration, IsOneLineAndLeavesNothing) {
  const test::Program program;
  std::string spec = kSpec;
  const std::string replaced = GetParam().replaced;
  spec.replace(spec.find(replaced), replaced.size(), GetParam().by);
  program.folder().write("s.toml", spec);
  const test::Outcome outcome = program("explore s.toml --out out");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err, std::string("parallax: error: ") + GetParam().line + "\n");
  EXPECT_EQ(program.files(), std::vector<std::string>{"s.toml"});
}

INSTANTIATE_TEST_SUITE_P(
    Of, WrongExploration,
    ::testing::Values(
        Wrong{"\"energy/frame_total\"", "\"energy/total\"",
              "s.toml:17: no number of a run or an estimate is called energy/total, and no key that varies; "
              "the "
              "nearest is energy/power_total (parallax glossary)"},
        Wrong{"\"64x48\"", "\"64by48\"", "s.toml: --size: '64by48' is not a size such as 640x480"},
        Wrong{"timing-frames = 2", "timing-frames = \"two\"",
              "s.toml: Could not convert: --timing-frames = two"},
        Wrong{"rectified = true", "left = \"no.png\"",
              "s.toml: --right is missing: a pair needs --left and --right"},
        Wrong{"\"energy/frame_total\"", "\"quality/bad_1\"",
              "s.toml:17: quality/bad_1 needs images, and none are computed"},
        Wrong{"\"energy/frame_total\"", "\"limit/part\"",
              "s.toml:17: limit/part is a word, and has no least or most"},
        Wrong{"\"energy/frame_total\"", "\"devices/zynq_7045/fits\"",
              "s.toml:17: devices/zynq_7045/fits needs a device, and none is named"},
        Wrong{"[vary]", "[set]", "s.toml:8: clocks.core_hz: must be a number, true, false or text"}));

TEST(Explore, SaysWhatIsWrongWithItsDatabase) {
  const test::Program program;
  program.folder().write("s.toml", kSpec);
  program.folder().write("out/results.db", std::string(3000, '?'));
  const test::Outcome outcome = program("explore s.toml --out out");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err, "parallax: error: out/results.db: file is not a database\n");
  EXPECT_EQ(program.read("out/results.db"), std::string(3000, '?'));
}

// A disk that is full: the line says so, and what was there can be gone on with.
TEST(Explore, SurvivesAFullDisk) {
  const test::Program program;
  program.folder().write("s.toml", kSpec);
  const test::Outcome full = program("explore s.toml --out out", [] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{60'000, 60'000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  });
  EXPECT_EQ(full.code, 2) << full.out;
  EXPECT_NE(full.err.find("out/results.db: "), std::string::npos) << full.err;
  const test::Outcome after = program("explore s.toml --out out --json");
  EXPECT_EQ(after.code, 0) << after.err;
  EXPECT_EQ(json_of(after)["statuses"]["done"], 16);
}

}  // namespace explore_test
}  // namespace parallax
