// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/bounds_search.hpp"

#include <gtest/gtest.h>

#include <set>

namespace parallax::test {
namespace bounds_search_test {

using Numbers = std::vector<std::size_t>;

// Below `running` nothing is known of the others, as of a machine that gets stuck.
struct Space {
  std::size_t running = 0;
  std::size_t least = 0;
  std::size_t most = 0;

  FailedBounds failed(std::size_t number) const {
    if (number < running) return {2};
    FailedBounds bounds;
    if (number < least) bounds.push_back(0);
    if (number > most) bounds.push_back(1);
    return bounds;
  }
  std::optional<std::size_t> first(std::size_t size) const {
    for (std::size_t number = 0; number < size; ++number) {
      if (failed(number).empty()) return number;
    }
    return std::nullopt;
  }
};

// Against a look at each number, wherever it starts, and whichever bounds contradict each other.
TEST(BoundsSearch, FindsTheLeastBetweenBounds) {
  constexpr std::size_t kSize = 18;
  for (std::size_t at = 0; at < kSize * kSize * kSize * 3; ++at) {
    const Space space{at / 3 % kSize, at / 3 / kSize % kSize, at / 3 / kSize / kSize};
    const std::size_t at_once = 1 + at % 3;
    for (std::size_t start = 0; start <= kSize; start += 3) {
      std::set<std::size_t> asked;
      const Threshold found = find_bounds(kSize, start, at_once, [&](const Numbers& numbers) {
        EXPECT_LE(numbers.size(), at_once);
        std::vector<FailedBounds> answers;
        for (const std::size_t number : numbers) {
          EXPECT_TRUE(asked.insert(number).second) << "twice";
          answers.push_back(space.failed(number));
        }
        return answers;
      });
      ASSERT_TRUE(found.complete);
      ASSERT_EQ(found.at, space.first(kSize))
          << space.running << " " << space.least << " " << space.most << " " << start;
    }
  }
}

// One number of thousands holds both.
TEST(BoundsSearch, TriesFew) {
  const Space space{0, 1234, 1234};
  std::size_t tried = 0;
  const Threshold found = find_bounds(3000, 2500, 1, [&](const Numbers& numbers) {
    tried += numbers.size();
    return std::vector<FailedBounds>{space.failed(numbers.front())};
  });
  EXPECT_EQ(found.at, 1234U);
  EXPECT_LE(tried, 30U);
}

TEST(BoundsSearch, HasNothingInNothing) {
  const Threshold found = find_bounds(0, 0, 2, [](const Numbers&) { return std::vector<FailedBounds>{}; });
  EXPECT_TRUE(found.complete);
  EXPECT_FALSE(found.at);
}

// Whenever the answers end.
TEST(BoundsSearch, EndsWhenItGetsNoAnswer) {
  const Space space{0, 40, 40};
  for (std::size_t most = 0; most < 8; ++most) {
    std::size_t tried = 0;
    const Threshold found = find_bounds(100, 90, 1, [&](const Numbers& numbers) {
      return tried++ < most ? std::vector<FailedBounds>{space.failed(numbers.front())}
                            : std::vector<FailedBounds>{};
    });
    EXPECT_FALSE(found.complete) << most;
  }
}

}  // namespace bounds_search_test
}  // namespace parallax::test
