// SPDX-License-Identifier: Apache-2.0
// What a comparison says of images whose pixels come in another order.
#include "platform/cosim/frame_order.hpp"

#include <gtest/gtest.h>

#include "tests/platform/altered_dump.hpp"

namespace parallax {
namespace frame_order_test {

using test::Words;

class FrameOrder : public test::AlteredDump {
 protected:
  // The values of all pixels, of as many tokens as there are of one: from (x, y) of the same frame.
  template <class From>
  Words from(const From& of) const {
    const int width = manifest_.width, height = manifest_.height;
    const int pixels = static_cast<int>(stream().shape.pixels_per_token);
    const int tokens = static_cast<int>(stream().shape.tokens_per_pixel);
    const auto values = static_cast<int>(stream().shape.format.all().size()) / pixels;
    Words got = words_;
    for (int frame = 0; frame < manifest_.frames; ++frame) {
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          const auto [from_x, from_y] = of(x, y);
          const auto at = [&](int column, int row) {
            return ((frame * height + row) * width + column) / pixels * tokens;
          };
          for (int token = 0; token < tokens; ++token) {
            for (int i = 0; i < values; ++i) {
              got[at(x, y) + token][x % pixels * values + i] =
                  words_[at(from_x, from_y) + token][from_x % pixels * values + i];
            }
          }
        }
      }
    }
    return got;
  }
  std::string said(const Words& got) const {
    const DifferencePattern first = compare(got).patterns.front();
    return first.name + ": " + first.text;
  }
};

TEST_F(FrameOrder, Turned) {
  TokenShape pairs(gray_format().several(2));
  pairs.row_tokens = 20;
  pairs.pixels_per_token = 2;
  for (const TokenShape& shape : {test::image_of(gray_format(), 40), pairs, test::costs(40, 3, 4)}) {
    make(shape, 40, 30, 2);
    EXPECT_EQ(first_pattern(from([](int x, int y) { return std::pair{39 - x, y}; })), "mirrored");
    EXPECT_EQ(first_pattern(from([](int x, int y) { return std::pair{x, 29 - y}; })), "upside_down");
    EXPECT_EQ(first_pattern(from([](int x, int y) { return std::pair{39 - x, 29 - y}; })), "turned");
    Words got = from([](int x, int y) { return std::pair{39 - x, y}; });
    got.back()[0] ^= 1;
    const std::vector<DifferencePattern> patterns = compare(got).patterns;
    EXPECT_EQ(patterns.back().text.substr(0, 9), "frame 1: ");
    EXPECT_NE(patterns.back().name, "mirrored");
  }
  EXPECT_EQ(said(from([](int x, int y) {
              return std::pair{39 - x, y};
            })),
            "mirrored: each row is mirrored: its last pixel comes first");
}

TEST_F(FrameOrder, EverySecond) {
  make(test::image_of(gray_format(), 40), 40, 30, 2);
  const auto keep = [this](auto is_kept) {
    Words got;
    for (std::size_t i = 0; i < words_.size(); ++i) {
      if (is_kept(i)) got.push_back(words_[i]);
    }
    return got;
  };
  EXPECT_EQ(said(keep([](auto i) { return i % 2 == 0; })),
            "every_second: only every second pixel is there, from the first one on");
  EXPECT_EQ(said(keep([](auto i) { return i % 2 == 1; })),
            "every_second: only every second pixel is there, from the second one on");
  EXPECT_EQ(said(keep([](auto i) { return i / 40 % 2 == 1; })),
            "every_second: only every second row is there, from the second one on");
  Words twice;
  for (const auto& word : words_) twice.insert(twice.end(), 2, word);
  EXPECT_EQ(said(twice), "each_twice: each pixel comes twice");
  twice.resize(words_.size());
  EXPECT_EQ(said(twice), "each_twice: each pixel comes twice");
  EXPECT_EQ(said(from([](int x, int y) {
              return std::pair{x / 2, y};
            })),
            "each_twice: each pixel comes twice, so that only the first half of all pixels is there");
  EXPECT_EQ(said(from([](int x, int y) {
              return std::pair{x, y / 2};
            })),
            "each_twice: each row comes twice, so that only the first half of all rows is there");
  EXPECT_EQ(said(from([](int x, int y) {
              return std::pair{x / 2 * 2, y};
            })),
            "every_second_twice: every second pixel is there twice, in the place of the pixel behind it");
  EXPECT_EQ(said(from([](int x, int y) {
              return std::pair{x, y | 1};
            })),
            "every_second_twice: every second row is there twice, in the place of the row before it");
}

// Tokens that know no rows, and costs of which each group comes twice.
TEST_F(FrameOrder, EverySecondOfOtherTokens) {
  make(TokenShape(gray_format()), 40, 30);
  manifest_.streams.front().frame_tokens = manifest_.streams.front().tokens = 500;
  words_.clear();
  for (std::uint64_t i = 0; i < 500; ++i) words_.push_back({i * i * 7 / 3 % 251});
  Words half;
  for (std::size_t i = 0; i < words_.size(); i += 2) half.push_back(words_[i]);
  EXPECT_EQ(said(half), "every_second: only every second token is there, from the first one on");
  make(test::costs(20, 4, 4), 20, 20);
  half.clear();
  for (std::size_t i = 1; i < words_.size(); i += 2) half.push_back(words_[i]);
  EXPECT_EQ(said(half), "every_second: only every second token is there, from the second one on");
  EXPECT_EQ(said(from([](int x, int y) {
              return std::pair{x / 2 * 2, y};
            })),
            "every_second_twice: every second pixel is there twice, in the place of the pixel behind it");
}

TEST_F(FrameOrder, IsNotFoundWhereAnyOrderIsTheSame) {
  make(test::image_of(gray_format(), 40), 40, 30);
  for (std::size_t i = 0; i < words_.size(); ++i) words_[i] = {i % 40 < 20 ? i % 40 : 39 - i % 40};
  Words got = words_;
  got[500] = {77};
  got[519] = {78};  // of an image that is its own mirror image
  EXPECT_EQ(first_pattern(got), "one_row");
}

}  // namespace frame_order_test
}  // namespace parallax
