// SPDX-License-Identifier: Apache-2.0
#include "tlm/kept_records.hpp"

#include <gtest/gtest.h>

namespace parallax::test {
namespace kept_records_test {

TEST(KeptRecords, KeepsAllUnlessTold) {
  KeptRecords<int> records;
  EXPECT_TRUE(records.empty());
  for (int i = 0; i < 1000; ++i) records.push_back(i);
  EXPECT_EQ(records.size(), 1000u);
  for (std::size_t i = 0; i < 1000; ++i) EXPECT_EQ(records[i], static_cast<int>(i));
}

TEST(KeptRecords, KeepsTheFirstAndTheLast) {
  KeptRecords<int> records;
  records.keep(3);
  for (int i = 0; i < 100; ++i) {
    records.push_back(i);
    EXPECT_EQ(records.size(), static_cast<std::size_t>(i) + 1);
    EXPECT_EQ(records.back(), i);
    EXPECT_EQ(records[static_cast<std::size_t>(i)], i);
  }
  for (const std::size_t i : {0, 1, 2, 97, 98, 99}) EXPECT_EQ(records[i], static_cast<int>(i));
  for (const std::size_t i : {3, 50, 96, 100}) EXPECT_THROW(records[i], std::out_of_range) << i;
  records.back() = 7;
  EXPECT_EQ(records[99], 7);
}

TEST(KeptRecords, KeepsTheOneThatIsPinned) {
  KeptRecords<int> records;
  records.keep(3);
  for (int i = 0; i < 100; ++i) {
    records.push_back(i);
    if (i == 40 || i == 51) records.pin(50 - (i == 40 ? 10 : 0));
  }
  EXPECT_EQ(records[50], 50);
  EXPECT_THROW(records[40], std::out_of_range);
  EXPECT_THROW(records.pin(60), std::out_of_range);
}

}  // namespace kept_records_test
}  // namespace parallax::test
