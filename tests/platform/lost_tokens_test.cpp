// SPDX-License-Identifier: Apache-2.0
// What a comparison says of dumps in which tokens are missing, or too many.
#include "platform/cosim/lost_tokens.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <vector>

#include "tests/platform/altered_dump.hpp"

namespace parallax {
namespace lost_tokens_test {

using test::codes;
using test::Words;

class TokensLost : public test::AlteredDump {
 protected:
  // The dump with each token as often as `times` says.
  Words with(const std::function<int(std::size_t token)>& times) const {
    Words got;
    for (std::size_t i = 0; i < words_.size(); ++i) got.insert(got.end(), times(i), words_[i]);
    return got;
  }
  std::string said(const Words& got) const {
    const DifferencePattern first = compare(got).patterns.front();
    return first.name + ": " + first.text;
  }
};

TEST_F(TokensLost, WholeRows) {
  make(codes(40, 24), 40, 30, 2);
  const Words one = with([](auto i) { return i / 40 == 10 ? 0 : 1; });
  const std::string row_10 = "row_lost: row 10 (frame 0) is lost, all other tokens are there";
  EXPECT_EQ(said(one), row_10);
  // Filled up with what comes next.
  Words full = one;
  full.resize(words_.size(), {5});
  EXPECT_EQ(said(full), row_10);
  EXPECT_EQ(said(with([](auto i) { return i / 40 >= 33 && i / 40 < 36 ? 0 : 1; })),
            "rows_lost: 3 rows from row 3 (frame 1) to row 5 are lost, all other tokens are there");
  // As many tokens, but from the middle of a row.
  EXPECT_EQ(
      said(with([](auto i) { return i >= 410 && i < 450 ? 0 : 1; })),
      "tokens_lost: 40 tokens are lost from token 410 (frame 0, row 10, column 10) on, all others are there");
  // A row and its neighbours begin alike.
  for (std::size_t i = 0; i < words_.size(); ++i) {
    if (i % 40 < 7) words_[i] = {9};
  }
  EXPECT_EQ(said(with([](auto i) { return i / 40 == 10 ? 0 : 1; })), row_10);
}

TEST_F(TokensLost, RowsThatAreTooMany) {
  make(codes(40, 24), 40, 30);
  Words got = words_;
  got.insert(got.begin() + 440, words_.begin() + 400, words_.begin() + 440);
  const std::string twice = "row_doubled: row 10 (frame 0) comes twice, all other tokens are there once";
  EXPECT_EQ(said(got), twice);
  got.resize(words_.size());
  EXPECT_EQ(said(got), twice);
  got = words_;
  got.insert(got.begin() + 440, 80, {3});
  EXPECT_EQ(said(got), "rows_inserted: 2 rows too many before row 11 (frame 0), all others are there");
}

TEST_F(TokensLost, AColumn) {
  make(codes(40, 24), 40, 30, 2);
  for (const std::size_t column : {0, 13, 39}) {
    const Words got = with([&](auto i) { return i % 40 == column ? 0 : 1; });
    EXPECT_EQ(said(got),
              fmt::format("column_lost: column {} of each row is lost, all other tokens are there", column));
    Words twice = with([&](auto i) { return i % 40 == column ? 2 : 1; });
    const std::string text =
        fmt::format("column_doubled: column {} of each row comes twice, all other tokens are there", column);
    EXPECT_EQ(said(twice), text);
    twice.resize(words_.size());
    EXPECT_EQ(said(twice), text);
  }
  for (std::size_t i = 0; i < words_.size(); ++i) {
    if (i % 40 < 7) words_[i] = {9};
  }
  EXPECT_EQ(said(with([](auto i) { return i % 40 == 3 ? 0 : 1; })),
            "column_lost: a column of each row, one of 0 to 6, is lost, all other tokens are there");
  make(test::costs(16, 2, 4), 16, 20);
  EXPECT_EQ(said(with([](auto i) { return i % 32 / 2 == 5 ? 0 : 1; })),
            "column_lost: column 5 of each row is lost, all other tokens are there");
}

TEST_F(TokensLost, HereAndThere) {
  make(codes(40, 24), 40, 30, 2);
  const std::string first = "token 87 (frame 0, row 2, column 7)", end = ", all others are there";
  EXPECT_EQ(said(with([](auto i) { return i >= 80 && i % 40 == 7 && i / 40 % 3 == 2 ? 0 : 1; })),
            "tokens_lost: 20 tokens are lost at 20 places, each in column 7, the first one " + first + end);
  // Some at once, and at several places.
  const auto bursts = [](std::size_t i) {
    return (i >= 87 && i < 92) || (i >= 1000 && i < 1033) || i == 1999;
  };
  EXPECT_EQ(said(with([&](auto i) { return bursts(i) ? 0 : 1; })),
            "tokens_lost: 39 tokens are lost at 3 places, the first one " + first + end);
  EXPECT_EQ(
      said(with([](auto i) { return i == 87 || i == 1000 || i == 1999 ? 3 : 1; })),
      "tokens_inserted: 6 tokens are too many at 3 places, the first one before token 88 (frame 0, row 2, "
      "column 8)" +
          end);
  Words cut = with([&](auto i) { return bursts(i) ? 0 : 1; });
  cut.resize(2300);
  EXPECT_EQ(said(cut), "tokens_lost: 39 tokens are lost at 3 places, the first one " + first + end +
                           " but for the last 61");
}

// Some of them near each other.
TEST_F(TokensLost, AtRandom) {
  make(codes(64, 24), 64, 48, 2);
  std::mt19937 random(3);
  std::vector<int> times;
  int lost = 0, places = 0;
  for (std::size_t i = 0; i < words_.size(); ++i) {
    times.push_back(i > 100 && i + 100 < words_.size() && random() % 100 < 2 ? 0 : 1);
    lost += 1 - times[i];
    places += times[i] == 0 && times[i - 1] == 1 ? 1 : 0;
  }
  ASSERT_GT(lost, 80);
  ASSERT_LT(places, lost) << "some are neighbours";
  EXPECT_EQ(said(with([&](auto i) { return times[i]; })).substr(0, 51),
            fmt::format("tokens_lost: {} tokens are lost at {} places, the fir", lost, places).substr(0, 51));
}

// What is none of these: tokens that are wrong as well, and flat images, where anything follows anything.
TEST_F(TokensLost, AreNotFoundInNoise) {
  make(codes(40, 24), 40, 30);
  Words got = with([](auto i) { return i % 40 == 7 && i / 40 % 3 == 2 ? 0 : 1; });
  for (std::size_t i = 0; i < got.size(); i += 50) got[i][0] ^= 1;
  EXPECT_EQ(first_pattern(got), "none");
  words_.assign(words_.size(), {7});
  for (const std::size_t at : {150, 600, 1100}) words_[at] = {8};
  got = words_;
  got[150] = {7};  // two that are not there, as if lost behind a flat part
  got[600] = {7};
  EXPECT_EQ(first_pattern(got), "none");
}

}  // namespace lost_tokens_test
}  // namespace parallax
