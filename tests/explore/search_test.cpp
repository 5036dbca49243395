// SPDX-License-Identifier: Apache-2.0
// What a search finds in made-up spaces, beside what their full enumeration finds.
#include "platform/explore/search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

namespace parallax::test {
namespace search_test {

using Judge = std::function<Merit(const Place&)>;

Merit costing(std::vector<double> costs, double missed = 0) {
  return {Merit::Kind::kAllowed, missed, std::move(costs)};
}

struct Found {
  SearchEnd end;
  std::vector<Place> asked;
  std::size_t evaluated = 0;
};

Found run(const SearchPlan& plan, const Judge& judge) {
  Found found{};
  found.end = search(plan, [&](const std::vector<Place>& places) {
    std::vector<Merit> merits;
    for (const Place& place : places) {
      found.asked.push_back(place);
      merits.push_back(judge(place));
      if (merits.back().kind != Merit::Kind::kExcluded) ++found.evaluated;
    }
    return merits;
  });
  return found;
}

std::vector<Place> all_places(const std::vector<std::size_t>& sizes) {
  std::vector<Place> all{{}};
  for (const std::size_t size : sizes) {
    std::vector<Place> longer;
    for (const Place& place : all) {
      for (std::size_t value = 0; value < size; ++value) {
        longer.push_back(place);
        longer.back().push_back(value);
      }
    }
    all = std::move(longer);
  }
  return all;
}

// Costs of what no other place beats, each once.
std::set<std::vector<double>> front_costs(const std::vector<Place>& places, const Judge& judge) {
  std::vector<Merit> merits;
  for (const Place& place : places) merits.push_back(judge(place));
  std::set<std::vector<double>> costs;
  for (const Merit& merit : merits) {
    const bool beaten =
        std::any_of(merits.begin(), merits.end(), [&](const Merit& other) { return beats(other, merit); });
    if (!beaten) costs.insert(merit.costs);
  }
  return costs;
}

// Of this many seeds, how many searches find the best.
int successes(SearchPlan plan, const Judge& judge, int seeds) {
  const std::set<std::vector<double>> best = front_costs(all_places(plan.sizes), judge);
  int found = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    plan.seed = static_cast<std::uint64_t>(seed);
    const Found searched = run(plan, judge);
    EXPECT_LE(searched.evaluated, plan.budget);
    EXPECT_EQ(std::set<Place>(searched.asked.begin(), searched.asked.end()).size(), searched.asked.size())
        << "a place was asked for twice";
    if (front_costs(searched.asked, judge) == best) ++found;
  }
  return found;
}

double at(const Place& place, std::size_t axis) { return static_cast<double>(place[axis]); }

// The cheapest of lanes, clock, depth and width that reaches a rate: lanes cost much, the rest a little.
Merit cheapest(const Place& place) {
  const double lanes = std::pow(2, at(place, 0));
  const double clock = 50 + 5 * at(place, 1);
  const double rate = std::min(lanes * clock, 400 * (1 + at(place, 2))) * (at(place, 3) < 2 ? 0.5 : 1);
  const double cost = 100 * lanes + clock / 10 + 20 * at(place, 2) + at(place, 3);
  return costing({cost}, rate >= 2000 ? 0 : (2000 - rate) / 2000);
}

TEST(Search, FindsTheCheapestThatHoldsABound) {
  EXPECT_GE(successes({{7, 31, 12, 6}, 300, 1}, cheapest, 30), 28) << "of 15,624 machines, 2 %";
}

TEST(Search, FindsAWholeFront) {
  const auto two = [](const Place& place) {
    const double lanes = 1 + at(place, 0), clock = 1 + at(place, 1);
    return costing({-lanes * clock, 10 * lanes + clock + std::abs(at(place, 2) - 3)});
  };
  // 640 machines. All points of the front, of which there are some fifty.
  EXPECT_GE(successes({{8, 10, 8}, 320, 1}, two, 20), 18);
}

// Many places where each neighbour is worse.
TEST(Search, GetsOutOfHollows) {
  const auto rugged = [](const Place& place) {
    double cost = 0;
    for (std::size_t axis = 0; axis < place.size(); ++axis) {
      const double away = at(place, axis) - 6;
      cost += away * away + 10 * (1 - std::cos(2 * away));
    }
    return costing({cost});
  };
  EXPECT_GE(successes({{9, 9, 9, 9}, 500, 1}, rugged, 30), 28) << "of 6,561 machines, 8 %";
}

// Stuck, impossible, and excluded by a condition: most of the space.
TEST(Search, FindsTheWayAmongWhatFails) {
  std::set<Place> excluded;
  const auto narrow = [&excluded](const Place& place) {
    if ((place[0] + place[1]) % 3 == 0) {
      excluded.insert(place);
      return Merit{};
    }
    if (place[2] < 2) return Merit{Merit::Kind::kFailed, 0, {}};
    const double rate = at(place, 0) * at(place, 1);
    return costing({at(place, 0) + at(place, 1) + at(place, 2)}, rate >= 60 ? 0 : (60 - rate) / 60);
  };
  EXPECT_GE(successes({{12, 12, 8}, 200, 1}, narrow, 20), 19);
  EXPECT_FALSE(excluded.empty());
}

TEST(Search, EnumeratesWhatIsNoLargerThanTheBudget) {
  const Found found = run({{3, 4, 2}, 24, 1}, [](const Place& place) { return costing({at(place, 0)}); });
  EXPECT_EQ(found.end, SearchEnd::kExhausted);
  EXPECT_EQ(found.asked, all_places({3, 4, 2}));
}

TEST(Search, EndsWhereNothingIsLeft) {
  // All but 30 of 200 places are excluded: they cost nothing.
  const Found found = run({{10, 20}, 50, 1}, [](const Place& place) {
    return place[0] < 3 && place[1] < 10 ? costing({at(place, 0) - at(place, 1)}) : Merit{};
  });
  EXPECT_EQ(found.end, SearchEnd::kExhausted);
  EXPECT_EQ(found.evaluated, 30U);
}

TEST(Search, WithoutObjectivesFindsWhatSatisfies) {
  const auto bound = [](const Place& place) {
    return costing({}, place[0] == 17 && place[1] == 3 ? 0 : 1.0 + std::abs(at(place, 0) - 17));
  };
  const Found found = run({{40, 5}, 100, 1}, bound);
  EXPECT_TRUE(std::any_of(found.asked.begin(), found.asked.end(),
                          [&](const Place& place) { return bound(place).satisfies(); }));
}

TEST(Search, IsTheSameForTheSameSeed) {
  const SearchPlan plan{{7, 31, 12, 6}, 100, 5};
  SearchPlan other = plan;
  other.seed = 6;
  EXPECT_EQ(run(plan, cheapest).asked, run(plan, cheapest).asked);
  EXPECT_NE(run(plan, cheapest).asked, run(other, cheapest).asked);
}

TEST(Search, EndsWhenItIsInterrupted) {
  std::size_t answers = 0;
  const SearchEnd end = search({{7, 31, 12, 6}, 100, 1}, [&](const std::vector<Place>& places) {
    std::vector<Merit> merits;
    for (const Place& place : places) {
      if (++answers > 20) break;
      merits.push_back(cheapest(place));
    }
    return merits;
  });
  EXPECT_EQ(end, SearchEnd::kInterrupted);
  EXPECT_EQ(answers, 21U);
}

TEST(Search, BeatsByDebsRules) {
  const Merit good = costing({1, 5}), better = costing({1, 4}), other = costing({0, 9});
  const Merit near = costing({0, 0}, 0.1), far = costing({0, 0}, 0.2), failed{Merit::Kind::kFailed, 0, {}};
  const std::vector<Merit> order{better, good, near, far, failed, Merit{}};
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = 0; j < order.size(); ++j)
      EXPECT_EQ(beats(order[i], order[j]), i < j) << i << " " << j;
  }
  EXPECT_FALSE(beats(good, other));
  EXPECT_FALSE(beats(other, good));
}

TEST(SearchSpace, HasEachWholeNumberOrEvenSteps) {
  Axis few{"a", false, {}, Span{2, 6, false, true}};
  Axis list{"b", false, {"x", "y"}, {}};
  Axis span{"c", false, {}, Span{1, 100, true, false}};
  Axis whole{"d", false, {}, Span{1e6, 2e8, false, true}};
  const SearchSpace space({few, list, span, whole});
  EXPECT_EQ(space.sizes(), (std::vector<std::size_t>{5, 2, 101, 101}));
  EXPECT_EQ(space.machines(), 5. * 2 * 101 * 101);
  EXPECT_EQ(space.values({0, 0, 0, 0}), (std::vector<std::string>{"2", "x", "1", "1000000"}));
  EXPECT_EQ(space.values({4, 1, 50, 100}), (std::vector<std::string>{"6", "y", "10", "200000000"}));
}

}  // namespace search_test
}  // namespace parallax::test
