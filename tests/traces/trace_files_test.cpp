// SPDX-License-Identifier: Apache-2.0
// The files of a trace: whole or not there, the same for the same run, and of a machine that is stuck as
// well.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/cli/program.hpp"

namespace parallax::test {
namespace trace_files_test {

constexpr const char* kAll = "--trace perfetto,vcd,csv,json ";
const std::vector<std::string> kFiles{"trace.json",      "trace.pftrace",    "trace.vcd",
                                      "trace_fifos.csv", "trace_frames.csv", "trace_ports.csv",
                                      "trace_rows.csv"};

TEST(TraceFiles, OfTwoRunsAreTheSameBytes) {
  const Program program;
  const std::string run = std::string("run --size 96x64 --disparities 32 --timing-only -q ") + kAll;
  for (const char* options :
       {"--timing-frames 3", "--timing-frames 2 --trace-level tokens --trace-from 2:3 --trace-to 2:9"}) {
    ASSERT_EQ(program(run + options + " --out a").code, 0);
    ASSERT_EQ(program(run + options + " --out b").code, 0);
    for (const std::string& file : kFiles) {
      EXPECT_FALSE(program.read("a/" + file).empty()) << file;
      EXPECT_EQ(program.read("a/" + file), program.read("b/" + file)) << file;
    }
  }
}

TEST(TraceFiles, OfASequenceHoldAllOfItsFrames) {
  const Program program;
  const Outcome outcome = program(
      std::string("run --size 96x64 --disparities 32 --frames 3 --timing-frames 3 -q --out out ") + kAll);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(lines(program.read("out/trace_frames.csv")).size(), 1u + 3);
  for (const std::string& file : kFiles) EXPECT_FALSE(program.read("out/" + file).empty()) << file;
  EXPECT_TRUE(nlohmann::json::accept(program.read("out/trace.json")));
}

TEST(TraceFiles, AreNotThereAfterAnInterruption) {
  const Program program;
  const pid_t child = program.start(
      std::string("run --size 160x128 --disparities 32 --timing-only --timing-frames 1000000 --out out ") +
      kAll);
  const auto is_written = [&] {  // some of it, under a hidden name
    for (const std::string& file : program.files("out")) {
      std::error_code gone;
      if (file.find("trace_rows") != std::string::npos &&
          std::filesystem::file_size(program / "out" / file, gone) > 0)
        return true;
    }
    return false;
  };
  for (int i = 0; i < 3000 && !is_written(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(is_written());
  ::kill(child, SIGINT);
  const Outcome outcome = program.wait(child);
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_EQ(outcome.err.rfind("parallax: interrupted after ", 0), 0u) << outcome.err;
  EXPECT_EQ(lines(outcome.err).size(), 1u) << outcome.err;
  EXPECT_EQ(program.files(), std::vector<std::string>{});
}

TEST(TraceFiles, ADiskThatFillsUpLeavesNone) {
  const Program program;
  const Outcome outcome = program(
      std::string("run --size 96x64 --disparities 32 --timing-only --timing-frames 20 --out out ") + kAll,
      [] {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit small{300'000, 300'000};  // bytes of a file: stops the write as a full disk does
        ::setrlimit(RLIMIT_FSIZE, &small);
      });
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_EQ(lines(outcome.err).size(), 1u) << outcome.err;
  EXPECT_EQ(outcome.err.rfind("parallax: error: cannot write out/trace", 0), 0u) << outcome.err;
  EXPECT_EQ(program.files(), std::vector<std::string>{});
}

TEST(TraceFiles, OfAStuckMachineEndWithWhoWaits) {
  const Program program;
  const Outcome outcome = program(
      std::string(
          "run --size 96x64 --disparities 32 --timing-only --set streams.left_output.depth=1 --out out ") +
      kAll);
  EXPECT_EQ(outcome.code, 1);
  for (const std::string& file : kFiles) EXPECT_FALSE(program.read("out/" + file).empty()) << file;
  const auto trace = nlohmann::json::parse(program.read("out/trace.json"));
  EXPECT_FALSE(trace.at("events").empty());
  const auto waits = trace.at("waits");
  const auto on_left_output = std::find_if(waits.begin(), waits.end(), [](const auto& wait) {
    return wait.at("stream") == "left_output" && wait.at("state") == "full" && wait.at("depth_tokens") == 1;
  });
  ASSERT_NE(on_left_output, waits.end()) << waits.dump();
  const std::string waiter = on_left_output->at("waiter");
  EXPECT_NE(outcome.err.find(waiter.substr(waiter.rfind('.') + 1)), std::string::npos) << outcome.err;
  // In VCD, its state is 2, downstream full, at the end.
  const std::string vcd = program.read("out/trace.vcd");
  EXPECT_NE(vcd.find("b10 ", vcd.rfind('#')), std::string::npos);
  EXPECT_NE(program.read("out/trace.pftrace").find("stuck: downstream full"), std::string::npos);
}

}  // namespace trace_files_test
}  // namespace parallax::test
