// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/threshold_search.hpp"

#include <gtest/gtest.h>

#include "platform/explore/candidates.hpp"

namespace parallax::test {
namespace threshold_search_test {

// Whatever the size, where it starts, how many at once, and where the threshold lies.
TEST(ThresholdSearch, FindsTheOnlyThreshold) {
  for (std::size_t size = 0; size < 40; ++size) {
    for (std::size_t start = 0; start <= size; start += 3) {
      for (std::size_t at_once = 1; at_once <= 3; ++at_once) {
        for (std::size_t least = 0; least <= size; ++least) {
          const Threshold found = find_threshold(size, start, at_once, [&](const auto& numbers) {
            EXPECT_LE(numbers.size(), at_once);
            std::vector<bool> answers;
            for (const std::size_t number : numbers) {
              EXPECT_LT(number, size);
              answers.push_back(number >= least);
            }
            return answers;
          });
          EXPECT_TRUE(found.complete);
          EXPECT_EQ(found.at, least < size ? std::optional(least) : std::nullopt) << size << " " << start;
        }
      }
    }
  }
}

TEST(ThresholdSearch, StaysNearItsStart) {
  std::size_t lowest = 3000, highest = 0, number_tried = 0;
  find_threshold(3000, 1500, 2, [&](const auto& numbers) {
    std::vector<bool> answers;
    for (const std::size_t number : numbers) {
      lowest = std::min(lowest, number);
      highest = std::max(highest, number);
      answers.push_back(number >= 1600);
      ++number_tried;
    }
    return answers;
  });
  EXPECT_GE(lowest, 1400U);
  EXPECT_LE(highest, 2100U);
  EXPECT_LE(number_tried, 16U);
}

// Where it holds in several places, it is one of them, with one before that does not.
TEST(ThresholdSearch, FindsOneOfSeveral) {
  const auto holds = [](std::size_t number) { return number % 10 > 6 || number > 80; };
  for (std::size_t start = 0; start < 100; ++start) {
    const Threshold found = find_threshold(100, start, 2, [&](const auto& numbers) {
      std::vector<bool> answers;
      for (const std::size_t number : numbers) answers.push_back(holds(number));
      return answers;
    });
    ASSERT_TRUE(found.at);
    EXPECT_TRUE(holds(*found.at));
    EXPECT_TRUE(*found.at == 0 || !holds(*found.at - 1));
  }
}

TEST(ThresholdSearch, EndsWhenItGetsNoAnswer) {
  EXPECT_FALSE(find_threshold(100, 50, 2, [](const auto&) { return std::vector<bool>{}; }).complete);
}

TEST(Candidates, AreNumbersOfThreeDigits) {
  const std::vector<std::string> clocks = candidates(99.7e6, 101.5e6, false);
  EXPECT_EQ(clocks, (std::vector<std::string>{"99700e3", "99800e3", "99900e3", "100e6", "101e6"}));
  const std::vector<std::string> depths = candidates(98, 1020, true);
  EXPECT_EQ(depths[1], "99");
  EXPECT_EQ(depths[2], "100");
  EXPECT_EQ(depths.back(), "1020");
  EXPECT_EQ(depths.size(), 2U + 900 + 3);
  EXPECT_EQ(candidates(0.5, 0.502, false), (std::vector<std::string>{"500e-3", "501e-3", "502e-3"}));
  EXPECT_EQ(candidates(1, 3, true), (std::vector<std::string>{"1", "2", "3"}));
}

}  // namespace threshold_search_test
}  // namespace parallax::test
