// SPDX-License-Identifier: Apache-2.0
#include "modules/kept_rows.hpp"

#include <gtest/gtest.h>

namespace parallax {
namespace kept_rows_test {

using Row = std::vector<std::uint8_t>;

void leave(KeptRows& rows, const Row& row) { rows.leave(row.data(), row.size()); }
bool come_back(KeptRows& rows, const Row& row) { return rows.come_back(row.data(), row.size()); }

TEST(KeptRows, ComeBackInOrder) {
  KeptRows rows;
  leave(rows, {1, 2});
  leave(rows, {3});
  EXPECT_TRUE(come_back(rows, {1, 2}));
  leave(rows, {4});
  EXPECT_TRUE(come_back(rows, {3}));
  EXPECT_TRUE(come_back(rows, {4}));
}

TEST(KeptRows, OfABlockComeBackFromItsEnd) {
  KeptRows rows(2);
  for (const Row& row : {Row{1}, Row{2}, Row{3}, Row{4}}) leave(rows, row);
  for (const Row& row : {Row{2}, Row{1}, Row{4}, Row{3}}) EXPECT_TRUE(come_back(rows, row));
}

TEST(KeptRows, OthersAreNotTheSame) {
  KeptRows rows;
  EXPECT_FALSE(come_back(rows, {1}));
  leave(rows, {1, 2});
  EXPECT_FALSE(come_back(rows, {1, 3}));
  leave(rows, {1, 2});
  EXPECT_FALSE(come_back(rows, {1}));
}

}  // namespace kept_rows_test
}  // namespace parallax
