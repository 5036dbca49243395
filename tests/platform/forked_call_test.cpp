// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/forked_call.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <system_error>

namespace parallax {
namespace {

const auto kNever = [] { return false; };

std::ptrdiff_t open_descriptors() {
  const std::filesystem::directory_iterator entries("/proc/self/fd");
  return std::distance(begin(entries), end(entries));
}

bool has_children() { return ::waitpid(-1, nullptr, WNOHANG) != -1 || errno != ECHILD; }

TEST(ForkedCall, BringsBackWhatTheFunctionReturns) {
  int here = 0;
  const ForkedCall small = call_in_fork([&] { return "value " + std::to_string(++here); }, kNever);
  EXPECT_EQ(small.output, "value 1");
  EXPECT_EQ(small.signal, 0);
  EXPECT_FALSE(small.interrupted);
  EXPECT_EQ(here, 0) << "it ran in a copy of this process";
  // More than a pipe holds.
  EXPECT_EQ(call_in_fork([] { return std::string(5'000'000, 'x'); }, kNever).output,
            std::string(5'000'000, 'x'));
  EXPECT_EQ(call_in_fork([] { return std::string(); }, kNever).output, "");
}

TEST(ForkedCall, SaysWhichSignalEndedIt) {
  for (const int signal : {SIGKILL, SIGTERM, SIGINT}) {
    const ForkedCall call = call_in_fork(
        [signal] {
          ::raise(signal);
          return std::string("alive");
        },
        kNever);
    EXPECT_EQ(call.signal, signal);
    EXPECT_FALSE(call.interrupted);
    EXPECT_EQ(call.output, "");
  }
}

TEST(ForkedCall, IsGivenUpWhenTheCallerSaysSo) {
  int asked = 0;
  const ForkedCall call = call_in_fork(
      [] {
        ::pause();
        return std::string();
      },
      [&asked] { return ++asked == 3; });
  EXPECT_TRUE(call.interrupted);
  EXPECT_EQ(call.signal, SIGKILL);
  EXPECT_EQ(asked, 3);
}

TEST(ForkedCall, LeavesNeitherDescriptorsNorProcesses) {
  const std::ptrdiff_t before = open_descriptors();
  for (int i = 0; i < 20; ++i) {
    call_in_fork([] { return std::string("x"); }, kNever);
    call_in_fork(
        []() -> std::string {
          ::raise(SIGKILL);
          return "";
        },
        kNever);
    call_in_fork(
        []() -> std::string {
          ::pause();
          return "";
        },
        [] { return true; });
  }
  EXPECT_EQ(open_descriptors(), before);
  EXPECT_FALSE(has_children());
}

TEST(ForkedCall, WritesNothingOfWhatTheCallerHasBuffered) {
  const ForkedCall outer = call_in_fork(
      [] {
        std::array<int, 2> ends{};
        if (::pipe(ends.data()) != 0 || ::dup2(ends[1], STDOUT_FILENO) < 0) return std::string("no pipe");
        std::cout << "once";
        call_in_fork([] { return std::string(); }, kNever);
        std::cout << std::flush;
        std::fflush(stdout);
        std::array<char, 64> read{};
        const ssize_t count = ::read(ends[0], read.data(), read.size());
        return std::string(read.data(), static_cast<std::size_t>(count));
      },
      kNever);
  EXPECT_EQ(outer.output, "once");
}

TEST(ForkedCall, FailsWhereNoPipeCanBeMade) {
  const rlimit none{3, 3};
  const ForkedCall call = call_in_fork(
      [&] {
        ::setrlimit(RLIMIT_NOFILE, &none);
        try {
          call_in_fork([] { return std::string(); }, kNever);
        } catch (const std::system_error& error) {
          return std::string(error.what());
        }
        return std::string("no fault");
      },
      kNever);
  EXPECT_EQ(call.output, "no pipe: Too many open files");
}

}  // namespace
}  // namespace parallax
