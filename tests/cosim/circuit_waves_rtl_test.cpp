// SPDX-License-Identifier: Apache-2.0
// What is written of a circuit that differs: waves around the first difference, and an image.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "platform/images/image_codecs.hpp"
#include "tests/cli/program.hpp"
#include "tests/paths.hpp"
#include "tests/traces/tracks.hpp"
#include "tests/traces/wave.hpp"

namespace parallax::test {
namespace circuit_waves_rtl_test {

constexpr const char* kMachine = "run --size 64x48 --no-verdict --timing-frames 1 --json ";

constexpr std::int64_t kSecond = 1'000'000'000'000;  // ps

class CircuitWaves : public ::testing::Test {
 protected:
  // A library of census_5x5.sv with a fault.
  std::string build(const std::string& fault) const {
    std::ifstream in(source_path("tests/rtl/census_5x5.sv"));
    std::ofstream(program / "census.sv") << "`define " << fault << "\n" << in.rdbuf();
    EXPECT_EQ(program("circuit census.sv --out census.so").code, 0);
    return "--circuit census=census.so ";
  }
  // Runs it into a folder.
  nlohmann::json run(const std::string& circuit, const std::string& options) const {
    const Outcome outcome = program(kMachine + circuit + options);
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    return nlohmann::json::parse(outcome.out).at("circuits").at(0);
  }
  // What the model has on an output, in order.
  std::vector<std::int64_t> expected(const std::string& stream) const {
    EXPECT_EQ(program("vectors --stage census --size 64x48 --out vectors").code, 0);
    std::vector<std::int64_t> tokens;
    for (const std::string& line : lines(program.read("vectors/" + stream + ".memh")))
      tokens.push_back(std::stoll(line, nullptr, 16));
    return tokens;
  }

  const Program program;
};

// The dates of the clock's rising edges.
std::vector<std::int64_t> edges(const Wave& wave, const std::string& clock) {
  std::vector<std::int64_t> dates;
  for (const auto& [date, value] : wave.changes.at(clock)) {
    if (value == 1) dates.push_back(date);
  }
  return dates;
}

TEST_F(CircuitWaves, AreThoseAroundTheFirstDifference) {
  SKIP_WITHOUT("vcd2fst", "gtkwave");
  SKIP_WITHOUT("protoc", "protobuf-compiler");
  const nlohmann::json told = run(build("FAULT_LOST"), "--circuit-stall 200 --out out");
  const auto first = told.at("streams").at(0).at("first_difference");
  const std::vector<std::int64_t> model = expected("left_codes");
  const auto clock_hz =
      nlohmann::json::parse(program.read("vectors/manifest.json")).at("clock_hz").get<std::int64_t>();
  const std::int64_t common = std::gcd(clock_hz, kSecond);
  const auto date_of = [&](std::int64_t cycle) { return cycle * (kSecond / common) / (clock_hz / common); };

  const Wave wave = read_wave((program / "out/circuit_census.vcd").string());
  const std::vector<std::int64_t> rising = edges(wave, "census_5x5.clk");
  ASSERT_EQ(rising.size(), 130U) << "64 cycles before, 64 behind, and the edges at both ends";
  const auto cycle = first.at("cycle").get<std::int64_t>();
  for (std::size_t i = 0; i < rising.size(); ++i)
    EXPECT_EQ(rising[i], date_of(cycle - 64 + static_cast<std::int64_t>(i))) << i;

  // A token passes at an edge that sees valid and ready.
  std::int64_t first_wrong = -1;
  std::size_t passed = 0;
  for (std::size_t i = 1; i < rising.size(); ++i) {
    const auto before = [&](const std::string& signal) { return wave.at(signal, rising[i] - 1); };
    const bool passes = before("census_5x5.out_left_valid") == 1 && before("census_5x5.out_left_ready") == 1;
    const auto token = static_cast<std::size_t>(before("model.out_left_token"));
    EXPECT_EQ(before("model.out_left_expected"), model.at(token));
    const bool differs = passes && before("census_5x5.out_left_data") != model.at(token);
    EXPECT_EQ(before("model.out_left_differs"), differs ? 1 : 0) << token;
    if (differs && first_wrong < 0) {
      first_wrong = rising[i - 1];
      EXPECT_EQ(token, first.at("token").get<std::size_t>());
    }
    passed += passes;
  }
  EXPECT_EQ(first_wrong, date_of(cycle));
  EXPECT_GT(passed, 20U);

  const Tracks tracks = read_tracks((program / "out/circuit_census.pftrace").string());
  const std::vector<Tracks::Slice>& happened = tracks.slices.at("what happened");
  ASSERT_EQ(happened.size(), 1U);
  EXPECT_EQ(happened[0].name, "left_codes: token 640 of frame 0 is the first that differs");
  EXPECT_EQ(happened[0].begin, date_of(cycle));
  EXPECT_EQ(happened[0].end, date_of(cycle + 1));
  for (const char* const signal :
       {"census_5x5.out_left_data", "model.out_left_expected", "census_5x5.in_left_data"}) {
    for (const Tracks::Slice& slice : tracks.slices.at(signal))
      EXPECT_TRUE(wave.is(signal, std::stoll(slice.name, nullptr, 16), slice.begin, slice.end)) << signal;
  }
  for (const auto& [date, value] : tracks.counters.at("census_5x5.out_left_ready"))
    EXPECT_EQ(wave.at("census_5x5.out_left_ready", date), static_cast<std::int64_t>(value)) << date;
}

TEST_F(CircuitWaves, OfOneThatHangsAreThoseInWhichItStopped) {
  SKIP_WITHOUT("vcd2fst", "gtkwave");
  const nlohmann::json told = run(build("FAULT_HANGS"), "--circuit-waves 5 --out out");
  const auto given_up = told.at("given_up").get<std::string>();
  EXPECT_NE(given_up.find("since cycle 111025: "), std::string::npos) << given_up;
  const Wave wave = read_wave((program / "out/circuit_census.vcd").string());
  const std::vector<std::int64_t> rising = edges(wave, "census_5x5.clk");
  ASSERT_EQ(rising.size(), 12U) << "five cycles before the last token, five behind, and both ends";
  // The last thing that moves is a token at an input, which is said to be number 1199.
  const std::int64_t last = rising[6] - 1;
  EXPECT_EQ(wave.at("census_5x5.in_left_valid", last), 1);
  EXPECT_EQ(wave.at("census_5x5.in_left_ready", last), 1);
  for (std::size_t i = 7; i < rising.size(); ++i)
    EXPECT_EQ(wave.at("census_5x5.in_left_valid", rising[i] - 1), 0) << i;
}

TEST_F(CircuitWaves, AndAnImageShowWhereItDiffers) {
  const std::string circuit = build("FAULT_BORDER");
  const nlohmann::json told = run(circuit, "--out out");
  const cv::Mat image = read_image((program / "out/circuit_census_left_codes.png").string());
  ASSERT_EQ(image.size(), cv::Size(64, 48));
  std::uint64_t red = 0;
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.cols; ++column) {
      const cv::Vec3b pixel = image.at<cv::Vec3b>(row, column);
      if (pixel == cv::Vec3b(0, 0, 0)) continue;
      EXPECT_EQ(pixel, cv::Vec3b(0, 0, 255));
      ++red;
      const bool at_rim = std::min({row, column, 47 - row, 63 - column}) < 2;
      EXPECT_TRUE(at_rim) << row << ' ' << column;
    }
  }
  EXPECT_EQ(red, told.at("streams").at(0).at("different_tokens").get<std::uint64_t>());

  // Beside the model it sees the same, in the same cycles.
  run(circuit, "--circuit-shadow --out beside");
  for (const char* const name :
       {"circuit_census.vcd", "circuit_census.pftrace", "circuit_census_left_codes.png"})
    EXPECT_EQ(program.read(std::string("out/") + name), program.read(std::string("beside/") + name)) << name;

  // They are results, which go when another run takes the folder.
  ASSERT_EQ(program("run --size 64x48 --no-verdict --timing-frames 1 -q --out out").code, 0);
  const std::vector<std::string> left = program.files("out");
  EXPECT_TRUE(std::none_of(left.begin(), left.end(),
                           [](const std::string& name) { return name.rfind("circuit_", 0) == 0; }));
}

}  // namespace circuit_waves_rtl_test
}  // namespace parallax::test
