// SPDX-License-Identifier: Apache-2.0
// What is the user's stays, wherever results are written to.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <thread>

#include "tests/cli/program.hpp"
#include "tests/fuzz/calibration_seeds.hpp"

namespace parallax {
namespace kept_files_test {

namespace fs = std::filesystem;

class KeptFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(program_("scene --rectified --size 64x48 --disparities 32 --out g").code, 0);
  }

  using Contents = std::map<std::string, std::string>;
  Contents contents() const {
    Contents all;
    for (const std::string& name : program_.files()) {
      if (name.back() != '/') all[name] = program_.read(name);
    }
    return all;
  }

  /// The one line with which a command refuses, having touched nothing.
  std::string refusal(const std::string& arguments) const {
    const Contents before = contents();
    const test::Outcome outcome = program_(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments << '\n' << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(contents(), before) << arguments;
    EXPECT_EQ(test::lines(outcome.err).size(), 1U) << outcome.err;
    return outcome.err;
  }
  void rename(const std::string& from, const std::string& to) const {
    fs::rename(program_ / from, program_ / to);
  }

  test::Program program_;
};

constexpr const char* kRun = "run -d 32 --no-verdict --timing-frames 1 ";

TEST_F(KeptFiles, AnInputIsNotReplacedByAResult) {
  rename("g/disp_gt.png", "g/disparity.png");
  const std::string pair = std::string(kRun) + "--left g/left.png --right g/right.png ";
  const std::string line =
      "parallax: error: --out g would replace or remove --ground-truth g/disparity.png, which is read: "
      "g/disparity.png is the name of a result; choose another folder\n";
  EXPECT_EQ(refusal(pair + "--ground-truth g/disparity.png --out g"), line);
  fs::create_symlink("g", program_ / "link");
  EXPECT_NE(refusal(pair + "--ground-truth link/disparity.png --out ./g/../g"), "");
  EXPECT_NE(refusal(pair + "--ground-truth g/disparity.png --out link"), "");
  EXPECT_EQ(program_(pair + "--ground-truth g/disparity.png --out other").code, 0);
}

TEST_F(KeptFiles, NoFileOfAnInputInSeveralIsReplaced) {
  const std::string pair = std::string(kRun) + "--left g/left.png --right g/right.png ";
  program_.folder().write("left.yaml", test::ros_camera("0."));
  program_.folder().write("g/timing.json", test::ros_camera("-4.5"));
  EXPECT_NE(refusal(pair + "--calibration left.yaml g/timing.json --out g")
                .find("would replace or remove --calibration g/timing.json"),
            std::string::npos);
  EXPECT_NE(refusal("map encode --calibration left.yaml g/timing.json -o g/timing.json")
                .find("would replace --calibration g/timing.json"),
            std::string::npos);
  fs::remove(program_ / "g/timing.json");
  program_.folder().write("g/disparity.bin", "Pf\n64 48\n-1\n" + std::string(std::size_t{64} * 48 * 4, '@'));
  EXPECT_NE(refusal(pair + "--ground-truth g/disparity.bin --out g")
                .find("would replace or remove --ground-truth g/disparity.bin"),
            std::string::npos);
}

TEST_F(KeptFiles, TheFilesOfAListAreNotReplaced) {
  rename("g/left.png", "g/disparity.png");
  rename("g/right.png", "g/error.png");
  program_.folder().write("g/list.txt", "disparity.png error.png\n");
  EXPECT_NE(refusal(std::string(kRun) + "--input g/list.txt --out g").find("of --input g/list.txt"),
            std::string::npos);
}

TEST_F(KeptFiles, ATimingOnlyRunLeavesWhatItDoesNotWrite) {
  for (const char* name : {"g/error.png", "g/report.html", "g/trace.json", "g/points.ply", "g/strip.gif",
                           "g/frame_0000/disparity.png", "g/point_0000/timing.json"}) {
    program_.folder().write(name, "mine");
  }
  const Contents before = contents();
  EXPECT_EQ(before.size(), 12U);
  ASSERT_EQ(program_("run --timing-only --size 64x48 -d 32 --no-verdict --out g").code, 0);
  const Contents after = contents();
  for (const auto& [name, content] : before) EXPECT_EQ(after.at(name), content) << name;
  EXPECT_EQ(after.count("g/timing.json"), 1U);
}

TEST_F(KeptFiles, EachCommandRefusesToReplaceWhatItDidNotWrite) {
  const std::string timing = "run --timing-only --size 64x48 -d 32 ";
  const std::vector<std::pair<std::string, std::string>> cases{
      {"timing.json", timing + "--no-verdict --out g"},
      {"report.html", timing + "--report --out g"},
      {"trace.vcd", timing + "--no-verdict --trace vcd --out g"},
      {"trace_ports.csv", timing + "--no-verdict --trace csv --out g"},
      {"relaxations.json", timing + "--relax --out g"},
      {"point_0001/timing.json", timing + "--vary clocks.core_hz=1e8,2e8 --out g"},
      {"disparity.png", std::string(kRun) + "--size 64x48 --out g"},
      {"points.ply", std::string(kRun) + "--size 64x48 --out g"},
      {"frame_0001/causes.png", std::string(kRun) + "--size 64x48 --frames 2 --out g"},
      {"strip.gif", std::string(kRun) + "--size 64x48 --frames 2 --out g"},
      {"left_00.png", "scene --size 64x48 --disparities 32 --frames 2 --out g"},
      {"validation.json", "validate --out g"}};
  for (const auto& [name, command] : cases) {
    program_.folder().write("g/" + name, "mine");
    EXPECT_NE(refusal(command).find("parallax: error: g/" + name + " would be replaced"), std::string::npos)
        << command;
    fs::remove(program_ / ("g/" + name));
  }
}

TEST_F(KeptFiles, AResultIsReplacedUnlessItWasChanged) {
  const std::string run = std::string(kRun) + "--size 64x48 --out out";
  ASSERT_EQ(program_(run).code, 0);
  ASSERT_EQ(program_(run + " --set matching.p1=5").code, 0);
  ASSERT_EQ(program_("run --timing-only --no-verdict --size 64x48 -d 32 --out out").code, 0);
  EXPECT_FALSE(fs::exists(program_ / "out/disparity.png"));
  ASSERT_EQ(program_("report out").code, 0);
  ASSERT_EQ(program_("report out").code, 0);
  program_.folder().write("out/report.html", "edited");
  EXPECT_NE(refusal("report out").find("out/report.html would be replaced"), std::string::npos);
  fs::copy(program_ / "out", program_ / "copy", fs::copy_options::recursive);
  fs::remove(program_ / "copy/report.html");
  EXPECT_EQ(program_("report copy").code, 0);
  EXPECT_EQ(program_("scene --size 64x48 --disparities 32 --out g").code, 0) << "over its own scene";
}

TEST_F(KeptFiles, AFileThatIsWrittenIsNotTheOneThatIsRead) {
  ASSERT_EQ(program_("map encode --identity 64x48 -o a.map").code, 0);
  ASSERT_EQ(program_("map decode a.map -o raw.yml").code, 0);
  fs::create_hard_link(program_ / "a.map", program_ / "b.yml");
  EXPECT_EQ(refusal("map decode a.map -o b.yml"),
            "parallax: error: --out b.yml would replace a.map, which is read: b.yml is the same file; choose "
            "another "
            "name\n");
  EXPECT_NE(refusal("map encode --maps raw.yml -o ./raw.yml").find("would replace --maps raw.yml"),
            std::string::npos);
  EXPECT_NE(refusal("map encode --calibration g/calib.yml -o g/calib.yml").find("would replace"),
            std::string::npos);
  ASSERT_EQ(program_("map decode a.map -o raw.tif").code, 0);
  ASSERT_EQ(program_("map decode a.map -o raw.tif").code, 0) << "the same content";
  program_.folder().write("raw_right_x.tif", "mine");
  EXPECT_EQ(refusal("map decode a.map -o raw.tif"),
            "parallax: error: raw_right_x.tif exists and holds something else; move it away, or choose "
            "another name "
            "than raw.tif\n");
  ASSERT_EQ(program_("run --timing-only --no-verdict --size 64x48 -d 32 --out out").code, 0);
  EXPECT_NE(refusal("compare-runs out out/timing.json --html out/profile.json").find("would replace"),
            std::string::npos);
}

TEST_F(KeptFiles, AnInterruptedGridKeepsItsPoints) {
  const pid_t child = program_.start(
      "run --timing-only --size 64x48 -d 32 --timing-frames 2000 --json --out out --vary "
      "clocks.core_hz=1e8,1.1e8,1.2e8,1.3e8,1.4e8,1.5e8,1.6e8,1.7e8,1.8e8,1.9e8,2e8,2.1e8,2.2e8,2.3e8,2.4e8");
  for (int i = 0; i < 3000 && !fs::exists(program_ / "out/point_0001/timing.json"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ::kill(child, SIGTERM);
  const test::Outcome outcome = program_.wait(child);
  EXPECT_EQ(outcome.code, 143) << outcome.err;
  EXPECT_TRUE(fs::exists(program_ / "out/point_0001/timing.json"));
  EXPECT_EQ(outcome.out.substr(0, 1), "[") << "and prints them";
}

}  // namespace kept_files_test
}  // namespace parallax
