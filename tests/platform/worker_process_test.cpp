// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/worker_process.hpp"

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
namespace worker_process_test {

using State = WorkerProcess::State;

constexpr int kLong = 60'000;  // ms

std::string answer(WorkerProcess& worker, const std::string& request) {
  worker.ask(request);
  while (worker.state() == State::kWorking) worker.receive(kLong);
  return worker.state() == State::kAnswered ? worker.take_answer() : "died";
}

std::string run(const std::function<std::string()>& function) {
  WorkerProcess worker([&](const std::string&) { return function(); });
  return answer(worker, "");
}

std::ptrdiff_t open_descriptors() {
  const std::filesystem::directory_iterator entries("/proc/self/fd");
  return std::distance(begin(entries), end(entries));
}

bool has_children() { return ::waitpid(-1, nullptr, WNOHANG) != -1 || errno != ECHILD; }

TEST(WorkerProcess, AnswersOneRequestAfterTheOther) {
  WorkerProcess worker([](const std::string& request) { return request + request; });
  EXPECT_EQ(worker.state(), State::kIdle);
  EXPECT_EQ(answer(worker, "ab"), "abab");
  EXPECT_EQ(answer(worker, ""), "");
  EXPECT_EQ(worker.state(), State::kIdle);
  // More than a connection holds.
  EXPECT_EQ(answer(worker, std::string(5'000'000, 'x')), std::string(10'000'000, 'x'));
}

TEST(WorkerProcess, IsAsThisProcessWas) {
  int value = 1;
  WorkerProcess worker([&value](const std::string&) { return std::to_string(value++); });
  value = 100;
  EXPECT_EQ(answer(worker, ""), "1");
  EXPECT_EQ(answer(worker, ""), "2");
  EXPECT_EQ(value, 100);
}

TEST(WorkerProcess, SaysWhichSignalEndedIt) {
  for (const int signal : {SIGKILL, SIGTERM, SIGINT}) {
    WorkerProcess worker([signal](const std::string&) {
      ::raise(signal);
      return std::string("alive");
    });
    EXPECT_EQ(answer(worker, ""), "died");
    EXPECT_EQ(worker.signal(), signal);
    EXPECT_EQ(worker.descriptor(), -1);
    EXPECT_EQ(answer(worker, "once more"), "died");
  }
}

TEST(WorkerProcess, OneThatEndedWhileIdleDiesWhenItIsAsked) {
  WorkerProcess worker([](const std::string&) { return std::to_string(::getpid()); });
  ::kill(std::stoi(answer(worker, "")), SIGKILL);
  EXPECT_EQ(answer(worker, std::string(5'000'000, 'x')), "died");
  EXPECT_EQ(worker.signal(), SIGKILL);
}

TEST(WorkerProcess, IsEndedWhateverItDoes) {
  WorkerProcess worker([](const std::string&) {
    ::pause();
    return std::string();
  });
  worker.ask("");
  EXPECT_EQ(worker.receive(1), State::kWorking);
  worker.kill();
  EXPECT_EQ(worker.state(), State::kDied);
  EXPECT_EQ(worker.signal(), SIGKILL);
}

TEST(WorkerProcess, LeavesNeitherDescriptorsNorProcesses) {
  const std::ptrdiff_t before = open_descriptors();
  for (int i = 0; i < 20; ++i) {
    run([] { return std::string("x"); });
    run([]() -> std::string {
      ::raise(SIGKILL);
      return "";
    });
    WorkerProcess worker([](const std::string&) {
      ::pause();
      return std::string();
    });
    worker.ask("");
  }
  EXPECT_EQ(open_descriptors(), before);
  EXPECT_FALSE(has_children());
}

TEST(WorkerProcess, WritesNothingOfWhatTheCallerHasBuffered) {
  const std::string written = run([] {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0 || ::dup2(ends[1], STDOUT_FILENO) < 0) return std::string("no pipe");
    std::cout << "once";
    run([] { return std::string(); });
    std::cout << std::flush;
    std::fflush(stdout);
    std::array<char, 64> read{};
    const ssize_t count = ::read(ends[0], read.data(), read.size());
    return std::string(read.data(), static_cast<std::size_t>(count));
  });
  EXPECT_EQ(written, "once");
}

TEST(WorkerProcess, FailsWhereNoPipeCanBeMade) {
  const rlimit none{3, 3};
  const std::string fault = run([&] {
    ::setrlimit(RLIMIT_NOFILE, &none);
    try {
      run([] { return std::string(); });
    } catch (const std::system_error& error) {
      return std::string(error.what());
    }
    return std::string("no fault");
  });
  EXPECT_EQ(fault, "no connection to a process: Too many open files");
}

}  // namespace worker_process_test
}  // namespace parallax
