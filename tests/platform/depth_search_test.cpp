// SPDX-License-Identifier: Apache-2.0
// Against goals that are known in full: every vector of depths can be tried.
#include "platform/evaluation/depth_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace parallax::test {
namespace depth_search_test {

using Reached = std::function<bool(const Depths&)>;

struct Search {
  std::vector<FifoRange> fifos;
  Reached reached;
  std::function<Depths(const Depths&)> enough = [](const Depths& depths) { return depths; };
  std::size_t judged = 0;

  Depths find() {
    DepthSearch search(fifos, [this](const std::vector<Depths>& all) {
      std::vector<Judgement> judgements;
      for (const Depths& depths : all) judgements.push_back({reached(depths), enough(depths)});
      judged += all.size();
      return judgements;
    });
    return search.find();
  }
};

bool is_smallest(const Depths& depths, const Reached& reached) {
  for (std::size_t i = 0; i < depths.size(); ++i) {
    if (depths[i] == 1) continue;
    Depths less = depths;
    --less[i];
    if (reached(less)) return false;
  }
  return reached(depths);
}

std::int64_t bits(const Depths& depths, const std::vector<FifoRange>& fifos) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < depths.size(); ++i) sum += depths[i] * fifos[i].width;
  return sum;
}

// All vectors up to `most`.
std::vector<Depths> all_of(const Depths& most) {
  std::vector<Depths> all{{}};
  for (const std::int64_t last : most) {
    std::vector<Depths> longer;
    for (const Depths& begin : all) {
      for (std::int64_t depth = 1; depth <= last; ++depth) {
        longer.push_back(begin);
        longer.back().push_back(depth);
      }
    }
    all = std::move(longer);
  }
  return all;
}

// FIFOs that some sums of depths have to come to: paths that fork and meet again.
struct RandomGoal {
  explicit RandomGoal(std::uint32_t seed, std::size_t fifos, std::int64_t most) : random(seed) {
    for (std::size_t i = 0; i < fifos; ++i) search.fifos.push_back({draw(1, 40), 1, draw(1, most), most});
    for (std::size_t i = 0; i < fifos; ++i) {
      std::vector<std::int64_t> weights;
      for (std::size_t j = 0; j < fifos; ++j) weights.push_back(draw(0, 2) == 0 ? draw(1, 2) : 0);
      const std::int64_t sum = std::accumulate(weights.begin(), weights.end(), std::int64_t{0});
      constraints.emplace_back(weights, draw(0, std::max<std::int64_t>(0, sum * most)));
    }
    search.reached = [this](const Depths& depths) {
      return std::all_of(constraints.begin(), constraints.end(), [&](const auto& constraint) {
        return std::inner_product(depths.begin(), depths.end(), constraint.first.begin(), std::int64_t{0}) >=
               constraint.second;
      });
    };
  }
  std::int64_t draw(std::int64_t least, std::int64_t most) {
    return std::uniform_int_distribution<std::int64_t>(least, most)(random);
  }

  std::mt19937 random;
  std::vector<std::pair<std::vector<std::int64_t>, std::int64_t>> constraints;
  Search search;
};

TEST(DepthSearch, FindsSmallestDepthsAndWhereTheyAreTheOnlyOnesThese) {
  int only = 0;
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    RandomGoal goal(seed, 3, 7);
    const Depths found = goal.search.find();
    std::vector<Depths> smallest;
    for (const Depths& depths : all_of({7, 7, 7})) {
      if (is_smallest(depths, goal.search.reached)) smallest.push_back(depths);
    }
    EXPECT_EQ(std::count(smallest.begin(), smallest.end(), found), 1) << seed;
    if (smallest.size() == 1) ++only;
  }
  EXPECT_GT(only, 50);
}

TEST(DepthSearch, OfManyFifosNoneCanBeOneLess) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    RandomGoal goal(seed, 20, 1000);
    const Depths found = goal.search.find();
    EXPECT_TRUE(is_smallest(found, goal.search.reached)) << seed;
  }
}

TEST(DepthSearch, IndependentFifosTakeFewerRunsThanOneByOne) {
  Search search;
  const Depths least{1, 2, 2, 1, 2, 1, 143, 12320, 2, 1, 1, 19, 24, 2, 1, 1, 2, 1, 2, 2};
  for (const std::int64_t depth : least)
    search.fifos.push_back({8, 1, std::min<std::int64_t>(depth, 2), depth * 2 + 20});
  search.reached = [&](const Depths& depths) {
    return std::equal(depths.begin(), depths.end(), least.begin(), std::greater_equal<>());
  };
  EXPECT_EQ(search.find(), least);
  EXPECT_LT(search.judged, 160U);
}

TEST(DepthSearch, WithTheRightGuessThereIsLittleMoreThanTheProof) {
  Search search;
  const Depths least{1, 2, 2, 1, 143, 12320, 19, 24};
  for (const std::int64_t depth : least) search.fifos.push_back({8, depth, depth, depth * 2});
  search.reached = [&](const Depths& depths) {
    return std::equal(depths.begin(), depths.end(), least.begin(), std::greater_equal<>());
  };
  EXPECT_EQ(search.find(), least);
  EXPECT_LE(search.judged, 3 + least.size());
}

TEST(DepthSearch, AGuessThatIsTooDeepIsNoHarm) {
  Search search;
  search.fifos = {{8, 10, 10, 20}, {8, 500, 500, 900}, {8, 1, 2, 3}};
  search.reached = [](const Depths& depths) { return depths[0] >= 4 && depths[1] >= 321; };
  EXPECT_EQ(search.find(), (Depths{4, 321, 1}));
}

TEST(DepthSearch, OfTwoOfWhichEitherCanBeShallowTheWiderOneIs) {
  Search search;
  search.fifos = {{8, 1, 1, 10}, {32, 1, 1, 10}};
  search.reached = [](const Depths& depths) { return depths[0] + depths[1] >= 11; };
  EXPECT_EQ(search.find(), (Depths{10, 1}));
}

TEST(DepthSearch, WhereADeeperFifoDoesHarmTheProofStillHolds) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    RandomGoal goal(seed, 4, 9);
    const Reached monotonic = goal.search.reached;
    goal.search.reached = [&](const Depths& depths) {
      std::size_t hash = seed;
      for (const std::int64_t depth : depths) hash = hash * 1000003 + static_cast<std::size_t>(depth);
      const bool is_start = depths == Depths(4, 9);
      return monotonic(depths) && (is_start || hash % 5 != 0);
    };
    EXPECT_TRUE(is_smallest(goal.search.find(), goal.search.reached)) << seed;
  }
}

TEST(DepthSearch, WhatARunSaysIsEnoughIsUsedAndChecked) {
  Search search;
  search.fifos = {{8, 1, 1, 1000}, {8, 1, 1, 1000}};
  search.reached = [](const Depths& depths) { return depths[0] >= 400 && depths[1] >= 70; };
  search.enough = [](const Depths& depths) {
    return Depths{std::min<std::int64_t>(depths[0], 400), std::min<std::int64_t>(depths[1], 70)};
  };
  EXPECT_EQ(search.find(), (Depths{400, 70}));
  EXPECT_LT(search.judged, 15U);
  search.enough = [](const Depths& depths) { return Depths(depths.size(), 1); };  // wrong
  EXPECT_EQ(search.find(), (Depths{400, 70}));
}

TEST(DepthSearch, AGoalThatIsOutOfReachHasNoDepths) {
  Search search;
  search.fifos = {{8, 1, 1, 10}};
  search.reached = [](const Depths&) { return false; };
  EXPECT_TRUE(search.find().empty());
}

}  // namespace depth_search_test
}  // namespace parallax::test
