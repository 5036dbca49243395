// SPDX-License-Identifier: Apache-2.0
// What a comparison says of codes whose comparisons are others than the model's.
#include "platform/cosim/value_difference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "tests/platform/altered_dump.hpp"

namespace parallax {
namespace value_difference_test {

using test::Words;
using Compare = std::function<bool(int a, int b)>;

// Codes of 8 bits, of the neighbours in a window of 3 x 3, in an image of few values, so that many are equal.
class Comparisons : public test::AlteredDump {
 protected:
  Comparisons() {
    make(test::codes(kWidth, 8), kWidth, kHeight);
    std::mt19937 random(11);
    for (int i = 0; i < kWidth * kHeight; ++i) pixels_.push_back(static_cast<int>(random() % 6));
  }

  // What the border has: codes of the nearest pixels, or 0, as if masked.
  enum class Border { kNearest, kMasked };

  Words codes(const Compare& compare, Border border) const {
    Words out;
    for (int i = 0; i < kWidth * kHeight; ++i) {
      const int x = i % kWidth, y = i / kWidth;
      std::uint64_t code = 0;
      for (int n = 0; n < 9; ++n) {
        if (n == 4) continue;
        const int at_x = std::clamp(x + n % 3 - 1, 0, kWidth - 1),
                  at_y = std::clamp(y + n / 3 - 1, 0, kHeight - 1);
        code = code << 1 | (compare(pixels_[at_y * kWidth + at_x], pixels_[i]) ? 1 : 0);
      }
      const bool is_rim = x == 0 || y == 0 || x == kWidth - 1 || y == kHeight - 1;
      out.push_back({border == Border::kMasked && is_rim ? 0 : code});
    }
    return out;
  }
  std::string said(const Compare& model, const Compare& circuit, Border border) {
    words_ = codes(model, border);
    const DifferencePattern first =
        TokenComparison(AlteredDump::compare(codes(circuit, border))).patterns.front();
    return first.name + ": " + first.text;
  }

  static constexpr int kWidth = 40, kHeight = 30;
  std::vector<int> pixels_;
};

const Compare kLess = std::less<int>(), kLessOrEqual = std::less_equal<int>(), kGreater = std::greater<int>(),
              kGreaterOrEqual = std::greater_equal<int>();

TEST_F(Comparisons, TiesSetOrClearBits) {
  for (const Border border : {Border::kNearest, Border::kMasked}) {
    const std::string set =
        "only_set_bits: bits are 1 where the model's are 0, never the other way: as with <= in place of <";
    EXPECT_EQ(said(kLess, kLessOrEqual, border), set);
    EXPECT_EQ(said(kGreater, kGreaterOrEqual, border), set);
    const std::string cleared =
        "only_cleared_bits: bits are 0 where the model's are 1, never the other way: as with < in place of "
        "<=";
    EXPECT_EQ(said(kLessOrEqual, kLess, border), cleared);
    EXPECT_EQ(said(kGreaterOrEqual, kGreater, border), cleared);
  }
}

TEST_F(Comparisons, TheOtherWayRound) {
  const std::string none = "inverted_comparison: no bit is 1 in both: the comparison is the other way round";
  const std::string all = "inverted_comparison: no bit is 0 in both: the comparison is the other way round";
  EXPECT_EQ(said(kLess, kGreater, Border::kNearest), none);
  EXPECT_EQ(said(kLess, kGreater, Border::kMasked), none);
  EXPECT_EQ(said(kLessOrEqual, kGreaterOrEqual, Border::kNearest), all);
  EXPECT_EQ(said(kLessOrEqual, kGreaterOrEqual, Border::kMasked), all + ", but for what is masked");
  EXPECT_EQ(said(kLess, kGreaterOrEqual, Border::kNearest), "inverted: all bits are inverted");
  EXPECT_EQ(said(kLess, kGreaterOrEqual, Border::kMasked),
            "inverted: all bits are inverted, but for what is masked");
}

TEST_F(Comparisons, AreNotFoundInAFew) {
  words_ = codes(kLess, Border::kNearest);
  Words got = words_;
  int set = 0;
  for (std::size_t i = 40; i < got.size() && set < 15; i += 71) {
    if (got[i][0] == 0xFF) continue;
    got[i][0] |= set % 2 == 0 ? 0x3C : 0xC3;
    set += got[i] == words_[i] ? 0 : 1;
  }
  EXPECT_EQ(set, 15);
  EXPECT_EQ(first_pattern(got), "none");
  got = codes(kLessOrEqual, Border::kNearest);
  const auto at =
      std::find_if(words_.begin() + 500, words_.end(), [](const auto& word) { return word[0] != 0; });
  got[at - words_.begin()][0] &= (*at)[0] - 1;  // one that goes the other way
  EXPECT_EQ(first_pattern(got), "none");
  // At the border, that it lies there is what tells; and numbers have no bits that are comparisons.
  got = words_;
  for (int i = 0; i < kWidth; ++i) got[i][0] |= codes(kLessOrEqual, Border::kNearest)[i][0];
  EXPECT_EQ(first_pattern(got), "only_first_rows");
  manifest_.streams.front().shape.format = gray_format();
  EXPECT_EQ(first_pattern(codes(kLessOrEqual, Border::kNearest)), "none");
}

}  // namespace value_difference_test
}  // namespace parallax
