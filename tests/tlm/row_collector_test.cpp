// SPDX-License-Identifier: Apache-2.0
#include "tlm/row_collector.hpp"

#include <gtest/gtest.h>

#include <random>

namespace parallax {
namespace row_collector_test {

using Rows = std::vector<std::vector<int>>;

TEST(RowCollector, PassesPiecesOnWithoutALength) {
  RowCollector<int> collector;
  Rows rows;
  const auto take = [&](const int* row, std::size_t size) { rows.emplace_back(row, row + size); };
  const std::vector<int> values{1, 2, 3};
  collector.push(values.data(), 2, take);
  collector.push(values.data() + 2, 1, take);
  EXPECT_EQ(rows, (Rows{{1, 2}, {3}}));
}

TEST(RowCollector, MakesTheSameRowsOfAnyPieces) {
  std::vector<int> values(1000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<int>(i);
  std::mt19937 random(7);
  for (std::size_t length = 1; length <= 40; ++length) {
    RowCollector<int> collector(length);
    Rows rows;
    const auto take = [&](const int* row, std::size_t size) { rows.emplace_back(row, row + size); };
    for (std::size_t at = 0; at < values.size();) {
      const std::size_t size = std::min<std::size_t>(random() % (3 * length), values.size() - at);
      collector.push(values.data() + at, size, take);
      at += size;
    }
    Rows expected;
    for (std::size_t at = 0; at + length <= values.size(); at += length) {
      expected.emplace_back(values.data() + at, values.data() + at + length);
    }
    EXPECT_EQ(rows, expected) << length;
  }
}

}  // namespace row_collector_test
}  // namespace parallax
