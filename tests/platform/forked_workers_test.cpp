// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/forked_workers.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <set>

namespace parallax {
namespace {

const auto kNever = [] { return false; };

TEST(ForkedWorkers, AnswerInTheOrderOfTheRequests) {
  ForkedWorkers workers(3, [](const std::string& request) { return request + request; });
  std::vector<std::string> requests, expected;
  for (int i = 0; i < 50; ++i) {
    requests.push_back(std::string(static_cast<std::size_t>(i) * 5000, static_cast<char>('a' + i % 26)));
    expected.push_back(requests.back() + requests.back());
  }
  int done = 0;
  EXPECT_EQ(workers.answer(requests, kNever, [&] { ++done; }), expected);
  EXPECT_EQ(done, 50);
  EXPECT_EQ(workers.answer({"once more"}, kNever, [] {}).front(), "once moreonce more");
  EXPECT_TRUE(workers.answer({}, kNever, [] {}).empty());
}

TEST(ForkedWorkers, AreAsThisProcessWas) {
  int value = 1;
  ForkedWorkers workers(1, [&value](const std::string&) { return std::to_string(value++); });
  value = 100;
  EXPECT_EQ(workers.answer({"", ""}, kNever, [] {}), (std::vector<std::string>{"1", "2"}));
}

TEST(ForkedWorkers, OneThatDiesAnswersNothing) {
  ForkedWorkers workers(2, [](const std::string& request) {
    if (request == "die") ::raise(SIGKILL);
    return request;
  });
  const std::vector<std::string> answers = workers.answer({"a", "die", "b", "c"}, kNever, [] {});
  EXPECT_EQ(answers, (std::vector<std::string>{"a", "", "b", "c"}));
  EXPECT_EQ(workers.answer({"die", "x"}, kNever, [] {}), (std::vector<std::string>{"", ""}));
}

TEST(ForkedWorkers, AreGivenUpOn) {
  ForkedWorkers workers(1, [](const std::string& request) {
    ::pause();
    return request;
  });
  EXPECT_EQ(workers.answer(
                {"a", "b"}, [] { return true; }, [] {}),
            (std::vector<std::string>{"", ""}));
}

}  // namespace
}  // namespace parallax
