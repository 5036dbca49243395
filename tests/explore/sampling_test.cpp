// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/sampling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace parallax::test {
namespace sampling_test {

using Places = std::vector<std::vector<double>>;

Places places(SamplingMethod method, std::size_t number, std::size_t dimensions, std::uint64_t seed = 1) {
  SamplingPlan plan;
  plan.method = method;
  plan.points = number;
  plan.seed = seed;
  const auto source = make_place_source(plan, dimensions);
  Places all;
  for (std::size_t i = 0; i < number; ++i) {
    const auto place = source->next();
    if (!place) break;
    all.push_back(*place);
  }
  return all;
}

/// How many of these lie in each of `parts` equal parts of a dimension.
std::vector<int> counts(const Places& all, std::size_t dimension, std::size_t parts) {
  std::vector<int> number(parts);
  for (const auto& place : all)
    ++number[static_cast<std::size_t>(place[dimension] * static_cast<double>(parts))];
  return number;
}

TEST(Sampling, GridHasEveryCombinationTheLastAxisFastest) {
  const std::vector<Axis> axes{{"a", false, {"1", "2"}, {}}, {"b", false, {"x", "y", "z"}, {}}};
  const SamplingPlan plan;
  Sampling sampling(axes, plan);
  std::vector<std::string> seen;
  while (const auto values = sampling.next()) seen.push_back((*values)[0] + (*values)[1]);
  EXPECT_EQ(seen, (std::vector<std::string>{"1x", "1y", "1z", "2x", "2y", "2z"}));
  EXPECT_FALSE(sampling.next());
}

TEST(Sampling, OneAtATimeHasTheBaseAndEachOtherValueAlone) {
  const std::vector<Axis> axes{
      {"a", false, {"1", "2", "3"}, {}}, {"b", false, {"x"}, {}}, {"c", false, {"-", "+"}, {}}};
  SamplingPlan plan;
  plan.method = SamplingMethod::kOneAtATime;
  Sampling sampling(axes, plan);
  std::vector<std::string> seen;
  while (const auto values = sampling.next()) seen.push_back((*values)[0] + (*values)[1] + (*values)[2]);
  EXPECT_EQ(seen, (std::vector<std::string>{"1x-", "2x-", "3x-", "1x+"}));
  const std::vector<Axis> none{{"b", false, {"x"}, {}}};
  Sampling one(none, plan);
  EXPECT_TRUE(one.next());
  EXPECT_FALSE(one.next());
}

TEST(Sampling, LatinHypercubeHasOnePointInEachPartOfEachAxis) {
  const Places all = places(SamplingMethod::kLatinHypercube, 37, 5);
  ASSERT_EQ(all.size(), 37U);
  for (std::size_t dimension = 0; dimension < 5; ++dimension)
    EXPECT_EQ(counts(all, dimension, 37), std::vector<int>(37, 1));
  EXPECT_NE(all, places(SamplingMethod::kLatinHypercube, 37, 5, 2));
}

TEST(Sampling, LatinHypercubeEnds) {
  SamplingPlan plan;
  plan.method = SamplingMethod::kLatinHypercube;
  plan.points = 2;
  const auto source = make_place_source(plan, 1);
  EXPECT_TRUE(source->next());
  EXPECT_TRUE(source->next());
  EXPECT_FALSE(source->next());
}

// Whatever the shift: of the first 2^k points each of 2^k parts of an axis has one.
TEST(Sampling, SobolFillsEveryAxisEvenly) {
  for (const std::uint64_t seed : {1U, 2U, 77U}) {
    const Places all = places(SamplingMethod::kSobol, 256, 12, seed);
    for (std::size_t dimension = 0; dimension < 12; ++dimension)
      EXPECT_EQ(counts(all, dimension, 256), std::vector<int>(256, 1)) << seed << " " << dimension;
  }
}

// The first two dimensions: every rectangle of area 1/256 with sides that are powers of two has one of 256.
TEST(Sampling, SobolFillsPlanesEvenly) {
  const Places all = places(SamplingMethod::kSobol, 256, 2, 3);
  for (int bits = 0; bits <= 8; ++bits) {
    std::set<std::pair<int, int>> boxes;
    for (const auto& place : all)
      boxes.emplace(std::floor(std::ldexp(place[0], bits)), std::floor(std::ldexp(place[1], 8 - bits)));
    EXPECT_EQ(boxes.size(), 256U) << bits;
  }
}

// The standard says what mt19937_64 gives; the rest is arithmetic. So these numbers are those of any
// computer.
TEST(Sampling, RandomPlacesAreTheSameEverywhere) {
  std::mt19937_64 reference(9);
  const Places all = places(SamplingMethod::kRandom, 3, 2, 9);
  for (const auto& place : all) {
    for (const double number : place)
      EXPECT_EQ(number, std::ldexp(static_cast<double>(reference() >> 11), -53));
  }
}

TEST(Axis, ValuesOfAListComeEquallyOften) {
  const Axis axis{"a", false, {"p", "q", "r", "s"}, {}};
  EXPECT_EQ(value_at(axis, 0), "p");
  EXPECT_EQ(value_at(axis, 0.2499), "p");
  EXPECT_EQ(value_at(axis, 0.25), "q");
  EXPECT_EQ(value_at(axis, 1 - 0x1p-53), "s");
}

TEST(Axis, SpansReachBothEnds) {
  const Axis whole{"a", false, {}, Span{3, 5, false, true}};
  EXPECT_EQ(value_at(whole, 0), "3");
  EXPECT_EQ(value_at(whole, 0.34), "4");
  EXPECT_EQ(value_at(whole, 0.99), "5");
  const Axis log{"a", false, {}, Span{1, 1e4, true, false}};
  EXPECT_EQ(value_at(log, 0.5), "100");
  const Axis linear{"a", false, {}, Span{100e6, 200e6, false, false}};
  EXPECT_EQ(value_at(linear, 0.123456789), "1.123457e+08");
}

TEST(Axis, LogarithmicValuesMeetTheirEndAndComeOnce) {
  using Values = std::vector<std::string>;
  EXPECT_EQ(logarithmic_values(4, 64, 2, true), (Values{"4", "8", "16", "32", "64"}));
  EXPECT_EQ(logarithmic_values(4, 63, 2, true), (Values{"4", "8", "16", "32"}));
  EXPECT_EQ(logarithmic_values(1, 4, 1.3, true), (Values{"1", "2", "3", "4"}));
  EXPECT_EQ(logarithmic_values(0.1, 100, 10, false), (Values{"0.1", "1", "10", "100"}));
}

}  // namespace sampling_test
}  // namespace parallax::test
