// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/judgement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace parallax::test {
namespace judgement_test {

using Rows = std::vector<std::vector<std::optional<double>>>;

/// By definition: no other row is at least as good in all and better in one.
std::vector<std::size_t> naive_front(const Rows& rows, const std::vector<Objective>& objectives) {
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    bool on_it = true;
    for (std::size_t o = 0; o < objectives.size(); ++o) on_it = on_it && rows[i][o].has_value();
    for (std::size_t j = 0; on_it && j < rows.size(); ++j) {
      bool as_good = true, better = false;
      for (std::size_t o = 0; o < objectives.size(); ++o) {
        const double sign = objectives[o].most ? 1 : -1;
        const double mine = sign * *rows[i][o];
        const double other = rows[j][o] ? sign * *rows[j][o] : -INFINITY;
        as_good = as_good && other >= mine;
        better = better || other > mine;
      }
      on_it = !(as_good && better);
    }
    if (on_it) front.push_back(i);
  }
  return front;
}

TEST(ParetoFront, IsWhatTheDefinitionSays) {
  std::mt19937 random(5);
  for (int round = 0; round < 300; ++round) {
    const std::size_t number = 1 + random() % 3;
    std::vector<Objective> objectives;
    for (std::size_t i = 0; i < number; ++i) objectives.push_back({"m", random() % 2 == 0, ""});
    Rows rows(random() % 30);
    for (auto& row : rows) {
      for (std::size_t i = 0; i < number; ++i)
        row.push_back(random() % 10 == 0 ? std::nullopt : std::optional<double>(random() % 6));
    }
    EXPECT_EQ(pareto_front(rows, objectives), naive_front(rows, objectives)) << round;
  }
}

TEST(Miss, IsRelativeToTheBound) {
  const Constraint least{"m", 60, {}, ""};
  EXPECT_EQ(miss(least, 60), 0);
  EXPECT_EQ(miss(least, 57), 0.05);
  EXPECT_EQ(miss(least, std::nullopt), INFINITY);
  const Constraint both{"m", -2, 2, ""};
  EXPECT_EQ(miss(both, 0), 0);
  EXPECT_EQ(miss(both, 3), 0.5);
  EXPECT_EQ(miss(both, -3), 0.5);
  const Constraint nothing{"m", {}, 0, ""};
  EXPECT_EQ(miss(nothing, 4), 4);
}

}  // namespace judgement_test
}  // namespace parallax::test
