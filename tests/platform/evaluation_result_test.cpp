// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/evaluation_result.hpp"

#include <gtest/gtest.h>

namespace parallax::test {
namespace evaluation_result_test {

using Status = EvaluationResult::Status;

TEST(EvaluationResult, StatusesHaveNames) {
  EXPECT_STREQ(name(Status::kDone), "done");
  EXPECT_STREQ(name(Status::kInvalid), "invalid");
  EXPECT_STREQ(name(Status::kStuck), "stuck");
  EXPECT_STREQ(name(Status::kFailed), "failed");
  EXPECT_STREQ(name(Status::kInterrupted), "interrupted");
}

TEST(EvaluationResult, WhatWasNotMeasuredComesBackFromItsBytes) {
  for (const Status status : {Status::kInvalid, Status::kStuck, Status::kFailed, Status::kInterrupted}) {
    EvaluationResult result = not_measured(status, "what is wrong");
    result.notes = {"a note", "another"};
    result.configuration = R"({"clocks":{"core_hz":133e6}})";
    const EvaluationResult back = evaluation_result(to_bytes(result));
    EXPECT_EQ(back.status, status) << name(status);
    EXPECT_EQ(back.message, "what is wrong");
    EXPECT_EQ(back.notes, result.notes);
    EXPECT_EQ(back.configuration, result.configuration);
  }
}

TEST(EvaluationResult, WhatIsNoAnswerIsAFailure) {
  const std::string whole = to_bytes(not_measured(Status::kStuck, "m"));
  ASSERT_EQ(evaluation_result(whole).status, Status::kStuck);
  // A status that is none, and one that is done without the metrics that every result has.
  std::string asleep = whole;
  asleep.replace(asleep.find("stuck"), 5, "sleep");
  for (const std::string& text :
       {std::string(), std::string("no result"), std::string("[]"), std::string(300, '\xff'),
        whole.substr(0, whole.size() - 1), whole.substr(0, whole.size() / 2), asleep,
        to_bytes(not_measured(Status::kDone, ""))}) {
    const EvaluationResult result = evaluation_result(text);
    EXPECT_EQ(result.status, Status::kFailed) << text;
    EXPECT_EQ(result.message, "the simulation ended without a result") << text;
    EXPECT_FALSE(result.done());
  }
}

}  // namespace evaluation_result_test
}  // namespace parallax::test
