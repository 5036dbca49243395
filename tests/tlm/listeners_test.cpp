// SPDX-License-Identifier: Apache-2.0
#include "tlm/listeners.hpp"

#include <gtest/gtest.h>

namespace parallax {
namespace listeners_test {

using Each = std::vector<const int*>;

Each notified(const Listeners<int>& listeners) { return {listeners.begin(), listeners.end()}; }

TEST(Listeners, AreNotifiedInTheOrderInWhichTheyCame) {
  int a = 0, b = 0, c = 0;
  Listeners<int> listeners;
  EXPECT_FALSE(listeners.any());
  EXPECT_EQ(notified(listeners), Each{});
  listeners.add(b);
  listeners.add(a);
  listeners.add(c);
  EXPECT_TRUE(listeners.any());
  EXPECT_EQ(notified(listeners), (Each{&b, &a, &c}));
}

TEST(Listeners, GoOneByOne) {
  int a = 0, b = 0, c = 0;
  Listeners<int> listeners;
  for (int* one : {&a, &b, &c}) listeners.add(*one);
  listeners.remove(b);
  EXPECT_EQ(notified(listeners), (Each{&a, &c}));
  listeners.remove(a);
  listeners.remove(c);
  EXPECT_FALSE(listeners.any());
  listeners.add(b);
  EXPECT_EQ(notified(listeners), Each{&b});
}

TEST(Listeners, RefuseOneTwiceAndOneThatIsNotThere) {
  int a = 0, b = 0;
  Listeners<int> listeners;
  listeners.add(a);
  EXPECT_THROW(listeners.add(a), std::logic_error);
  EXPECT_THROW(listeners.remove(b), std::logic_error);
  EXPECT_EQ(listeners.size(), 1U);
}

}  // namespace listeners_test
}  // namespace parallax
