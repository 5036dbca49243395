// SPDX-License-Identifier: Apache-2.0
// What a comparison says of images that are moved, but for their border.
#include "platform/cosim/token_shift.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/platform/altered_dump.hpp"

namespace parallax {
namespace token_shift_test {

using test::codes;
using test::Words;

// Sums of 5 x 5 random pixels, of a window that is where it should be in the model, and where its circuit has
// it in the dump. Outside the image the model sees the nearest pixel, the circuit what `outside` says.
class MovedWindow : public test::AlteredDump {
 protected:
  void make_sums(int width, int height, int frames = 1) {
    make(codes(width, 24), width, height, frames);
    pixels_ = words_;
    for (auto& pixel : pixels_) pixel[0] &= 0xFF;
    width_ = width;
    height_ = height;
    words_ = sums(0, 0, [this](int frame, int x, int y) { return nearest(frame, x, y); });
  }
  std::uint64_t nearest(int frame, int x, int y) const {
    return pixels_[(frame * height_ + std::clamp(y, 0, height_ - 1)) * width_ + std::clamp(x, 0, width_ - 1)]
                  [0];
  }
  template <class Pixel>
  Words sums(int columns, int rows, const Pixel& pixel) const {
    Words out;
    for (int i = 0; i < static_cast<int>(pixels_.size()); ++i) {
      std::uint64_t sum = 0;
      for (int dy = -2; dy <= 2; ++dy) {
        for (int dx = -2; dx <= 2; ++dx)
          sum += pixel(i / width_ / height_, i % width_ + dx - columns, i / width_ % height_ + dy - rows);
      }
      out.push_back({sum});
    }
    return out;
  }
  // With zeros outside the image.
  std::string said(int columns, int rows) const {
    const DifferencePattern first =
        compare(sums(columns, rows, [this](int frame, int x, int y) {
          return x < 0 || x >= width_ || y < 0 || y >= height_ ? 0 : nearest(frame, x, y);
        })).patterns.front();
    return first.name + ": " + first.text;
  }

  int width_ = 0, height_ = 0;
  Words pixels_;
};

TEST_F(MovedWindow, IsFoundWhateverItsBorderIs) {
  for (const auto& [width, height] : {std::pair{64, 48}, {24, 20}, {200, 30}}) {
    make_sums(width, height, 2);
    EXPECT_EQ(said(1, 0), "one_column_late: 1 column late, but for the rim of 3 px") << width;
    EXPECT_EQ(said(0, -1), "one_row_early: 1 row early, but for the rim of 3 px") << width;
    EXPECT_EQ(said(2, 2), "moved: 2 columns late and 2 rows late, but for the rim of 4 px") << width;
  }
  make_sums(64, 48);
  EXPECT_EQ(said(-8, 3), "moved: 8 columns early and 3 rows late, but for the rim of 10 px");
  EXPECT_EQ(said(0, 0).substr(0, 8), "only_rim");
  EXPECT_EQ(said(9, 0), "none: none of those known: scattered over the image");
}

TEST_F(MovedWindow, IsNotFoundInNoise) {
  make_sums(64, 48);
  Words got = sums(1, 0, [this](int frame, int x, int y) { return nearest(frame, x, y); });
  got[20 * 64 + 30][0] ^= 1;  // one inside that is neither
  EXPECT_EQ(first_pattern(got), "none");
  // A flat image with a few points: that they are elsewhere says nothing of the others.
  words_.assign(words_.size(), {700});
  got = words_;
  for (const int at : {20 * 64 + 20, 24 * 64 + 40, 28 * 64 + 31}) {
    words_[at] = {705};
    got[at + 1] = {705};
  }
  EXPECT_EQ(first_pattern(got).substr(0, 3), "non");
  std::mt19937 random(5);
  for (int i = 0; i < 200; ++i) {
    got = words_;
    for (int n = 0; n < 12; ++n)
      got[random() % got.size()] = {random() % 2 == 0 ? 705U : 700U + random() % 9};
    const std::string name = first_pattern(got);
    EXPECT_TRUE(name == "none" || name == "one_token" || name == "") << name << ' ' << i;
  }
}

// Rows that begin alike hide where a delay begins.
TEST_F(MovedWindow, ADelayBehindAMaskedRim) {
  make(codes(40, 24), 40, 30);
  for (std::size_t i = 0; i < words_.size(); ++i) {
    if (i < 80 || i % 40 < 2) words_[i] = {0xFFF};
  }
  Words got = shifted(40);
  std::fill(got.begin(), got.begin() + 40, words_[0]);
  EXPECT_EQ(first_pattern(got), "one_row_late");
  got = shifted(1);
  got[0] = words_[0];
  EXPECT_EQ(first_pattern(got), "one_column_late");
}

}  // namespace token_shift_test
}  // namespace parallax
