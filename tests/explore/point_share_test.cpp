// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/point_share.hpp"

#include <gtest/gtest.h>

#include <set>

namespace parallax::test {
namespace point_share_test {

TEST(PointShare, GivesEachPointToOnePart) {
  for (std::size_t parts = 1; parts <= 9; ++parts) {
    for (std::size_t points = 0; points <= 100; ++points) {
      std::size_t all = 0;
      for (std::size_t index = 0; index < parts; ++index) {
        std::size_t own = 0;
        for (std::size_t number = 0; number < points; ++number)
          own += PointShare{index, parts}.has(number) ? 1 : 0;
        EXPECT_EQ((PointShare{index, parts}.size(points)), own) << index << "/" << parts << " of " << points;
        all += own;
      }
      EXPECT_EQ(all, points);
    }
  }
}

// As of a grid whose last axis has four values.
TEST(PointShare, HasAllValuesOfTheLastAxis) {
  for (std::size_t index = 0; index < 4; ++index) {
    std::set<std::size_t> values;
    for (std::size_t number = 0; number < 40; ++number) {
      if (PointShare{index, 4}.has(number)) values.insert(number % 4);
    }
    EXPECT_EQ(values.size(), 4U) << index;
  }
}

}  // namespace point_share_test
}  // namespace parallax::test
