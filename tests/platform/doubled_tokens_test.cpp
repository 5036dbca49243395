// SPDX-License-Identifier: Apache-2.0
// What a comparison says of dumps in which tokens come twice, and of streams that end otherwise.
#include "platform/cosim/doubled_tokens.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <utility>

#include "tests/platform/altered_dump.hpp"

namespace parallax {
namespace doubled_tokens_test {

using test::codes;
using test::Words;

class Doubled : public test::AlteredDump {
 protected:
  void SetUp() override { make(codes(64, 24), 64, 48); }
  // The dump with some tokens twice, no longer than the model's.
  Words twice(const std::function<bool(std::size_t token)>& is_twice) const {
    Words got;
    for (std::size_t i = 0; i < words_.size(); ++i) got.insert(got.end(), is_twice(i) ? 2 : 1, words_[i]);
    got.resize(words_.size());
    return got;
  }
};

TEST_F(Doubled, TheLastOfEachBurst) {
  const Words got = twice([](auto i) { return i % 128 == 127; });
  EXPECT_EQ(first_pattern(got), "tokens_doubled");
  EXPECT_EQ(said(got), "the last of every 128 tokens comes twice, 23 in all, and the last 23 are not there");
}

TEST_F(Doubled, HereAndThere) {
  const Words got = twice([](auto i) { return i == 700 || i == 900 || i == 1313; });
  EXPECT_EQ(said(got),
            "3 tokens come twice, the first one token 700 (frame 0, row 10, column 60), all others are there "
            "once, and the last 3 are not there");
  Words cut = got;
  cut.resize(got.size() - 20);
  EXPECT_EQ(first_pattern(cut), "tokens_doubled");
}

TEST_F(Doubled, IsNotSaidOfOtherValues) {
  Words got = words_;
  for (std::size_t i = 5; i < got.size(); i += 50) got[i] = got[i - 1];
  EXPECT_EQ(first_pattern(got), "none");
}

// What fills up for a row that is lost may be longer than that, and of one value.
TEST_F(Doubled, ARowLostAndPadded) {
  for (std::size_t i = 64 * 46; i < words_.size(); ++i) words_[i] = {0xFFF};
  Words got = words_;
  got.erase(got.begin() + 700, got.begin() + 764);
  got.resize(64 * 45);
  got.resize(words_.size(), {0});
  EXPECT_EQ(said(got).substr(0, 48), "64 tokens are lost from token 700 (frame 0, row ");
}

TEST_F(Doubled, AValueFromATokenOn) {
  Words got = words_;
  for (std::size_t i = 1500; i < got.size(); ++i) got[i] = {0};
  EXPECT_EQ(said(got), "all its tokens are 0 from token 1500 (frame 0, row 23, column 28) on");
}

// Behind a border that is masked a delay begins with a token that comes twice, or is lost.
TEST_F(Doubled, ADelayBehindAMaskedBorder) {
  for (std::size_t i = 0; i < 130; ++i) words_[i] = {4095};
  Words late = words_;
  late.insert(late.begin(), {4095});
  EXPECT_EQ(
      said(late),
      "one column late; all tokens are 1 token late, as shows from token 130 (frame 0, row 2, column 2) on");
  const Words early(words_.begin() + 1, words_.end());
  EXPECT_EQ(
      said(early),
      "one column early; all tokens are 1 token early, as shows from token 129 (frame 0, row 2, column 1) "
      "on");
}

// A line counter that goes one further.
TEST_F(Doubled, LinesThatAreLonger) {
  Words got;
  for (std::size_t i = 0; i < words_.size(); ++i) {
    got.push_back(words_[i]);
    if (i % 64 == 63) got.push_back({i % 1000});
  }
  got.resize(words_.size());
  EXPECT_EQ(first_pattern(got), "column_inserted");
  EXPECT_EQ(said(got).substr(0, 41), "each row has one more, behind column 63 o");
}

TEST_F(Doubled, OtherOrders) {
  Words got = words_;
  for (std::size_t i = 0; i + 1 < got.size(); i += 2) std::swap(got[i], got[i + 1]);
  EXPECT_EQ(first_pattern(got), "pairs_swapped");
  got = words_;
  for (std::size_t i = 0; i < 64; ++i) {
    std::swap(got[64 * 5 + i], got[64 * 9 + i]);
    std::swap(got[64 * 20 + i], got[64 * 21 + i]);
  }
  EXPECT_EQ(said(got), "4 rows are there in another order, the first of them as row 5, which is row 9");
  got[64 * 5] = {1};
  EXPECT_NE(first_pattern(got), "row_order");
}

}  // namespace doubled_tokens_test
}  // namespace parallax
