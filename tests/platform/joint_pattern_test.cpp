// SPDX-License-Identifier: Apache-2.0
// What a comparison says of dumps with two deviations at once, or with values in any other shape.
#include "platform/cosim/joint_pattern.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "modules/token_formats.hpp"
#include "tests/platform/altered_dump.hpp"

namespace parallax {
namespace joint_pattern_test {

using test::codes;
using test::costs;
using test::image_of;
using test::Words;

class Joint : public test::AlteredDump {
 protected:
  // Each value of the tokens `late` before; of the first ones 0.
  Words altered(std::int64_t late, const std::function<std::uint64_t(std::uint64_t value)>& change) const {
    Words got = shifted(late);
    for (std::size_t token = 0; token < got.size(); ++token) {
      for (std::size_t field = 0; field < got[token].size(); ++field) {
        const std::size_t width = stream().shape.format.all()[field].width;
        got[token][field] = change(got[token][field]) & ((std::uint64_t{1} << width) - 1);
      }
    }
    return got;
  }
  static std::uint64_t reversed(std::uint64_t value, int width) {
    std::uint64_t out = 0;
    for (int i = 0; i < width; ++i) out |= (value >> i & 1U) << (width - 1 - i);
    return out;
  }
  // The model's in a rim of so many px.
  Words with_rim(Words got, int px) const {
    for (std::uint64_t token = 0; token < got.size(); ++token) {
      const ValuePlace place = manifest_.place(stream(), token, 0);
      if (place.column < px || place.column >= manifest_.width - px || place.row < px ||
          place.row >= manifest_.height - px)
        got[token] = words_[token];
    }
    return got;
  }
};

TEST_F(Joint, AValueAndADelay) {
  make(codes(40, 24), 40, 30);
  EXPECT_EQ(said(altered(2, [](auto v) { return reversed(v, 24); })),
            "the bits are in the other order; all tokens are 2 tokens late");
  EXPECT_EQ(said(altered(-1, [](auto v) { return ~v; })), "all bits are inverted; one column early");
  EXPECT_EQ(said(altered(40, [](auto v) { return ~v; })), "all bits are inverted; one row late");
  make(image_of(gray_format(), 40), 40, 30);
  EXPECT_EQ(said(altered(3, [](auto v) { return v + 1; })),
            "all values are 1 too high; all tokens are 3 tokens late");
  EXPECT_EQ(said(altered(-3, [](auto v) { return v - 1; })),
            "all values are 1 too low; all tokens are 3 tokens early");
  make(costs(8, 2, 16), 8, 30);
  Words got = shifted(2);
  for (auto& word : got) std::reverse(word.begin(), word.end());
  EXPECT_EQ(said(got), "the values of a token are in the other order; one column late");
}

TEST_F(Joint, InsideARim) {
  make(codes(64, 24), 64, 48);
  EXPECT_EQ(said(with_rim(altered(0, [](auto v) { return ~v; }), 2)),
            "all bits are inverted, but for the rim of 2 px");
  EXPECT_EQ(said(with_rim(altered(1, [](auto v) { return reversed(v, 24); }), 3)),
            "the bits are in the other order; one column late, but for the rim of 3 px");
  // Of a rim that is masked, all of it is as one says.
  for (std::uint64_t token = 0; token < words_.size(); ++token) {
    if (token / 64 < 2 || token / 64 > 45) words_[token] = {0xABCDEF};
  }
  EXPECT_EQ(first_pattern(with_rim(altered(0, [](auto v) { return v << 7 | v >> 17; }), 2)), "bit_order");
}

TEST_F(Joint, AllButAFew) {
  make(codes(64, 24), 64, 48);
  Words got = shifted(2);
  for (const std::size_t at : {700, 1500, 1501}) got[at][0] ^= 77;
  EXPECT_EQ(
      said(got),
      "all tokens are 2 tokens late, but for 3 tokens, the first one token 700 (frame 0, row 10, column 60)");
  got = altered(0, [](auto v) { return ~v; });
  got[99][0] ^= 0xFFF;
  EXPECT_EQ(said(got),
            "all bits are inverted, but for one token, which is token 99 (frame 0, row 1, column 35)");
  // 1 in 100 are no few.
  for (std::size_t i = 0; i < got.size(); i += 90) got[i][0] ^= 1 + i % 7;
  EXPECT_NE(first_pattern(got), "inverted");
}

TEST_F(Joint, BitsInAnyOrder) {
  make(codes(64, 24), 64, 48);
  const auto permuted = [this](const std::vector<int>& order, std::int64_t late) {
    return said(altered(late, [&order](auto v) {
      std::uint64_t out = 0;
      for (std::size_t i = 0; i < order.size(); ++i) out |= (v >> order[i] & 1U) << i;
      return out;
    }));
  };
  std::vector<int> order(24);
  for (int i = 0; i < 24; ++i) order[i] = (i + 24 - 3) % 24;
  EXPECT_EQ(permuted(order, 0), "the bits are rotated up by 3");
  for (int i = 0; i < 24; ++i) order[i] = (i + 1) % 24;
  EXPECT_EQ(permuted(order, 0), "the bits are rotated down by 1");
  // Column by column, of 4 rows of 6.
  for (int i = 0; i < 24; ++i) order[i] = i % 4 * 6 + i / 4;
  const std::string columns =
      "the bits are in another order: bit 1 is the model's 6, 2 is the model's 12, 3 is the model's 18, 4 is "
      "the model's 1, 5 is the model's 7, 6 is the model's 13 and so on";
  EXPECT_EQ(permuted(order, 0), columns);
  EXPECT_EQ(permuted(order, 2), columns + "; all tokens are 2 tokens late");
  std::iota(order.begin(), order.end(), 0);
  std::swap(order[3], order[9]);
  EXPECT_EQ(permuted(order, 0), "the bits are in another order: bit 3 is the model's 9, 9 is the model's 3");
  // A bit that is there twice is no order.
  order[3] = order[4];
  EXPECT_EQ(permuted(order, 0).find("order"), std::string::npos);
}

TEST_F(Joint, Scaled) {
  TokenShape disparities = image_of(disparity_format(), 64);
  make(disparities, 64, 48);
  for (std::size_t i = 0; i < words_.size(); i += 5) words_[i][0] = 4095;
  const auto scaled = [this](auto change) {
    return said(altered(0, [&](auto v) { return v == 4095 ? v : change(v); }));
  };
  EXPECT_EQ(scaled([](auto v) { return v >> 4; }), "all values are divided by 16");
  EXPECT_EQ(scaled([](auto v) { return v >> 1; }), "all values are divided by 2");
  EXPECT_EQ(scaled([](auto v) { return v << 1; }), "all values are multiplied by 2");
}

TEST_F(Joint, IsNotFoundInNoise) {
  for (const int bits : {8, 24}) {
    make(codes(64, static_cast<std::size_t>(bits)), 64, 48, 2);
    const Words other = words_;
    std::mt19937 random(3);
    for (auto& word : words_) word[0] = random() & ((1U << bits) - 1);
    EXPECT_EQ(said(other), "none of those known: scattered over the image");
  }
}

}  // namespace joint_pattern_test
}  // namespace parallax
