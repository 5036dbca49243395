// SPDX-License-Identifier: Apache-2.0
// A run that its user ends, and the progress that the user sees.
#include <gtest/gtest.h>
#include <pty.h>

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "platform/commands/interruption.hpp"
#include "tests/cli/program.hpp"
#include "tests/paths.hpp"

namespace parallax {
namespace interruption_test {

/// Waits until the file is there, at most a minute.
bool appears(const std::filesystem::path& file) {
  for (int i = 0; i < 6000 && !std::filesystem::exists(file); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return std::filesystem::exists(file);
}

/// What was said of the end: a slow computer says before it how long the run will take.
std::string without_forecast(const std::string& err) {
  const bool forecast = err.rfind("parallax: note: about ", 0) == 0;
  return forecast ? err.substr(err.find('\n') + 1) : err;
}

class Interrupted : public ::testing::TestWithParam<int> {};

TEST_P(Interrupted, FinishedFramesStayAndNothingElse) {
  const test::Program program;
  const pid_t child = program.start("run --size 160x128 --disparities 32 --frames 100000 --out out");
  ASSERT_TRUE(appears(program / "out/frame_0002/disparity.png"));
  ::kill(child, GetParam());
  const test::Outcome outcome = program.wait(child);
  EXPECT_EQ(outcome.code, 128 + GetParam()) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  int frames = 0;
  while (std::filesystem::exists(program / fmt::format("out/frame_{:04}", frames))) {
    EXPECT_EQ(program.files(fmt::format("out/frame_{:04}", frames)).size(), 9U);
    ++frames;
  }
  EXPECT_GE(frames, 3);
  EXPECT_EQ(without_forecast(outcome.err), fmt::format("parallax: interrupted after {} frames\n", frames));
  EXPECT_EQ(program.files("out").size(), static_cast<std::size_t>(frames) * 10) << "and no strip.gif";
}

INSTANTIATE_TEST_SUITE_P(By, Interrupted, ::testing::Values(SIGINT, SIGTERM));

TEST(InterruptedPair, LeavesNothing) {
  const test::Program program;
  const pid_t child = program.start("run --size 160x128 --disparities 32 --timing-frames 1000000 --out out");
  ASSERT_TRUE(appears(program / "out"));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  ::kill(child, SIGINT);
  const test::Outcome outcome = program.wait(child);
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_EQ(without_forecast(outcome.err).rfind("parallax: interrupted after ", 0), 0U) << outcome.err;
  EXPECT_EQ(program.files(), std::vector<std::string>{});
}

// Wherever the program is, a signal ends it.
TEST(Interruption, EndsWhatDoesNotLookAtIt) {
  const pid_t child = ::fork();
  if (child == 0) {
    const Interruption interruption;
    ::kill(::getpid(), SIGTERM);
    for (int i = 0; i < 60; ++i) std::this_thread::sleep_for(std::chrono::seconds(1));
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 128 + SIGTERM);
}

/// What the program writes to a terminal.
std::string on_terminal(const test::Program& program, const std::vector<const char*>& arguments) {
  int terminal = -1;
  const pid_t child = ::forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    std::vector<char*> argv;
    std::string name = test::program_path();
    argv.push_back(name.data());
    for (const char* argument : arguments) argv.push_back(const_cast<char*>(argument));
    argv.push_back(nullptr);
    if (::chdir(program.folder().path().c_str()) != 0) ::_exit(126);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  std::string text;
  char buffer[4096];
  for (ssize_t got = 0; (got = ::read(terminal, buffer, sizeof buffer)) > 0;) {
    text.append(buffer, static_cast<std::size_t>(got));
  }
  ::close(terminal);
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0) << text;
  return text;
}

TEST(Progress, IsShownOnATerminalOnly) {
  const test::Program program;
  const std::string shown =
      on_terminal(program, {"run", "--size", "64x48", "--disparities", "32", "--frames", "20"});
  EXPECT_NE(shown.find("20/20 frames"), std::string::npos) << shown;
  EXPECT_NE(shown.find('\r'), std::string::npos);
  // The bar is wiped before the summary.
  EXPECT_GT(shown.rfind("image "), shown.rfind("20/20 frames"));
  const std::string quiet =
      on_terminal(program, {"run", "--size", "64x48", "--disparities", "32", "--frames", "20", "-q"});
  EXPECT_EQ(quiet, "");
  const test::Outcome piped = program("run --size 64x48 --disparities 32 --frames 20");
  EXPECT_EQ(piped.err, "");
  EXPECT_EQ(piped.out.find('\r'), std::string::npos);
}

}  // namespace interruption_test
}  // namespace parallax
