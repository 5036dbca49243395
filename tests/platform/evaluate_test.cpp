// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/evaluate.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "platform/machine/steady_state.hpp"
#include "tests/paths.hpp"
#include "tests/timing/machine_bench.hpp"

namespace parallax::test {
namespace evaluate_test {

using Status = EvaluationResult::Status;

class Evaluate : public ::testing::Test {
 protected:
  Evaluate() {
    input_.width = 60;  // padded to 64
    input_.height = 48;
    input_.map = &map_;
  }
  ~Evaluate() override { EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "a process is left"; }

  static double number(const EvaluationResult& result, const char* path) {
    return result.metrics.number(path);
  }

  MachineConfig config(std::vector<std::string> assignments = {}) const {
    assignments.insert(assignments.begin(), {"rectification.window=9", "matching.iterations=1"});
    return preset(assignments);
  }

  const EncodedMap map_ = encode(lens_map(64, 48, {9, 5}));
  EvaluationInput input_;
};

TEST_F(Evaluate, MeasuresOneMachineAfterTheOther) {
  const MachineConfig slow = config({"link.host_pixel_rate=1000000"});
  const MachineConfig fast = config({"link.host_pixel_rate=2000000"});
  const EvaluationResult first = evaluate(slow, input_);
  ASSERT_EQ(first.status, Status::kDone) << first.message;
  EXPECT_EQ(first.message, "");
  // 64 x 48 pixels at the host's rate; the link's clock rounds each packet.
  EXPECT_NEAR(number(first, "performance/frame_rate"), 1e6 / (64 * 48), 0.5);
  EXPECT_EQ(first.rate, number(first, "performance/frame_rate"));
  EXPECT_EQ(first.latency.first_pixel, number(first, "latency/first_pixel_mean"));
  EXPECT_EQ(first.latency.last_pixel, number(first, "latency/last_pixel_mean"));
  EXPECT_EQ(first.latency.exposure_to_host, number(first, "latency/exposure_to_host_mean"));
  EXPECT_EQ(first.limit.part, "host");
  EXPECT_EQ(first.limit.utilisation, number(first, "limit/utilisation"));
  EXPECT_EQ(static_cast<double>(first.disparities), number(first, "input/disparity_range"));
  EXPECT_EQ(number(first, "input/width"), 60);
  EXPECT_EQ(number(first, "input/processed_width"), 64);
  EXPECT_EQ(number(first, "input/frames"), static_cast<double>(warm_up_frames(slow) + 3));
  const EvaluationResult second = evaluate(fast, input_);
  ASSERT_EQ(second.status, Status::kDone) << second.message;
  EXPECT_NEAR(number(second, "performance/frame_rate"), 2e6 / (64 * 48), 1.0);
  // The first machine again: the evaluation leaves nothing behind.
  EXPECT_EQ(to_json(evaluate(slow, input_).metrics.group_at("streams")),
            to_json(first.metrics.group_at("streams")));
}

TEST_F(Evaluate, SimulatesAllFramesOfTheInputAndAsManyAsAreAskedFor) {
  input_.timing_frames = 2;
  input_.command = "a command";
  input_.scene_seed = 7;
  EvaluationResult result = evaluate(config(), input_);
  ASSERT_EQ(result.status, Status::kDone) << result.message;
  EXPECT_EQ(number(result, "input/frames"), 2);
  EXPECT_EQ(result.metrics.word("run/command"), "a command");
  EXPECT_EQ(result.metrics.word("run/seed"), "7");
  input_.frames = 3;
  result = evaluate(config(), input_);
  EXPECT_EQ(number(result, "input/frames"), 3);
}

TEST_F(Evaluate, AConfigurationThatIsNotPossibleIsInvalid) {
  MachineConfig wrong = config();
  wrong.matching.p1 = wrong.matching.p2;
  EvaluationResult result = evaluate(wrong, input_);
  EXPECT_EQ(result.status, Status::kInvalid);
  EXPECT_EQ(result.message, "matching.p1 = 42: must be below matching.p2 = 42");
  EXPECT_TRUE(result.metrics.groups.empty());
  // Found in the child, when the machine is built.
  MachineConfig small = config();
  small.memory.size_bytes = 4096;
  result = evaluate(small, input_);
  EXPECT_EQ(result.status, Status::kInvalid);
  EXPECT_EQ(result.message.rfind("memory.size_bytes = 4096 is too small: ", 0), 0U) << result.message;
}

TEST_F(Evaluate, AMapForAnotherMachineIsInvalid) {
  EvaluationResult result = evaluate(config({"rectification.window=11"}), input_);
  EXPECT_EQ(result.status, Status::kInvalid);
  EXPECT_EQ(result.message,
            "rectification.window is 11 and rectification.fraction_bits 5, but the map has 9 and 5");
  result = evaluate(config({"image.width_granularity=60"}), input_);
  EXPECT_EQ(result.status, Status::kInvalid);
  EXPECT_EQ(result.message, "images of 60x48 are processed as 60x48, but the map has 64x48");
}

TEST_F(Evaluate, AMachineThatGetsStuckSaysWhoWaits) {
  const EvaluationResult result = evaluate(config({"streams.left_texture.depth=8"}), input_);
  EXPECT_EQ(result.status, Status::kStuck);
  EXPECT_EQ(result.message.rfind("the machine is deadlocked; nobody in this circle can go on:\n", 0), 0U)
      << result.message;
  EXPECT_NE(result.message.find("machine.core.pipeline.left_texture (full, depth 8)"), std::string::npos)
      << result.message;
  EXPECT_TRUE(result.metrics.groups.empty());
}

TEST_F(Evaluate, AFaultOfTheComputerIsAFailure) {
  if (sanitized()) GTEST_SKIP() << "the sanitizer reserves more than any limit";
  rlimit before{};
  ::getrlimit(RLIMIT_AS, &before);
  std::ifstream pages("/proc/self/statm");
  rlim_t size = 0;
  pages >> size;
  const MachineConfig large =
      config({"streams.left_output.depth=16000000"});  // the dates of its tokens: 512 MB
  const rlimit small{size * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + (64U << 20U), before.rlim_max};
  ::setrlimit(RLIMIT_AS, &small);
  const EvaluationResult result = evaluate(large, input_);
  ::setrlimit(RLIMIT_AS, &before);
  EXPECT_EQ(result.status, Status::kFailed);
  EXPECT_EQ(result.message, "out of memory");
}

TEST_F(Evaluate, ACrashIsAFailure) {
  // Processor time runs out: the kernel ends the child, and it alone.
  rlimit before{};
  ::getrlimit(RLIMIT_CPU, &before);
  input_.timing_frames = 1'000'000;
  const rlimit second{1, before.rlim_max};
  ::setrlimit(RLIMIT_CPU, &second);
  std::signal(SIGXCPU, SIG_DFL);
  const EvaluationResult result = evaluate(config(), input_);
  ::setrlimit(RLIMIT_CPU, &before);
  EXPECT_EQ(result.status, Status::kFailed);
  EXPECT_EQ(result.message.rfind("the simulation was ended by signal 24 (", 0), 0U) << result.message;
}

TEST_F(Evaluate, EndsEarlyWhenTheCallerSaysSo) {
  input_.timing_frames = 1'000'000'000;
  int asked = 0;
  const EvaluationResult result = evaluate(config(), input_, [&asked] { return ++asked >= 2; });
  EXPECT_EQ(result.status, Status::kInterrupted);
  EXPECT_EQ(result.message, "interrupted");
}

}  // namespace evaluate_test
}  // namespace parallax::test
