// SPDX-License-Identifier: Apache-2.0
#include "tlm/ring.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <random>

namespace parallax {
namespace ring_test {

TEST(Ring, IsAQueue) {
  std::mt19937 random(1);
  Ring<int> ring;
  std::deque<int> expected;
  EXPECT_TRUE(ring.empty());
  for (int i = 0; i < 20'000; ++i) {
    // It grows to some length, empties, grows further.
    if (expected.empty() || random() % 16 < (i / 500 % 2 == 0 ? 10u : 6u)) {
      ring.push_back(i);
      expected.push_back(i);
    } else {
      ring.pop_front();
      expected.pop_front();
    }
    ASSERT_EQ(ring.size(), expected.size());
    ASSERT_EQ(ring.empty(), expected.empty());
    if (expected.empty()) continue;
    ASSERT_EQ(ring.front(), expected.front());
    const std::size_t at = random() % expected.size();
    ASSERT_EQ(ring[at], expected[at]);
  }
}

}  // namespace ring_test
}  // namespace parallax
