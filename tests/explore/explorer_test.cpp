// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/explorer.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/platform/temporary_folder.hpp"

namespace parallax::test {
namespace explorer_test {

// Points of the same machine are evaluated once, and what became of it became of all of them, a failure, too.
TEST(Explorer, WhatFailsFailsForAllPointsOfTheSameMachine) {
  const TemporaryFolder folder;
  ExplorationSpec spec;
  spec.axes.push_back({"a", false, {"1", "2", "3"}, {}});
  ResultStore store(folder / "r.db");
  store.begin("spec", {"a"});
  EvaluationPool pool(
      [](const Variant&, const NoticeSink&) -> EvaluationCase { throw std::runtime_error("no memory"); }, 1);
  Explorer explorer(spec, store, &pool,
                    [](const ExplorationPoint& point) {
                      return PointIdentity{point.values[0] == "3" ? "another" : "one", "", "", 0};
                    },
                    {});
  std::size_t advanced = 0;
  const ExplorationCounts counts =
      explorer.run([] { return false; }, [&advanced](std::size_t more) { advanced += more; });
  EXPECT_TRUE(counts.whole);
  EXPECT_EQ(counts.points, 3U);
  EXPECT_EQ(counts.evaluated, 2U);
  EXPECT_EQ(counts.not_done, 3U);
  EXPECT_EQ(advanced, 3U);
  std::size_t failed = 0;
  store.each_point({}, [&failed](const StoredPoint& point) {
    if (point.result.status == "failed" && point.result.message == "no memory") ++failed;
  });
  EXPECT_EQ(failed, 3U);
}

}  // namespace explorer_test
}  // namespace parallax::test
