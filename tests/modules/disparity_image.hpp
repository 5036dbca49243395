// SPDX-License-Identifier: Apache-2.0
// Whole disparity images for tests: made at random, and sent through a row kernel.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "modules/pixel.hpp"

namespace parallax {

inline void PrintTo(const Disparity& d, std::ostream* out) {
  *out << '(' << d.value << ", cause " << static_cast<int>(d.cause) << ')';
}

namespace test {

template <class T>
struct Image {
  int width = 0;
  int height = 0;
  std::vector<T> pixels;

  Image() = default;
  Image(int w, int h)
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

  bool inside(int x, int y) const { return x >= 0 && x < width && y >= 0 && y < height; }
  T& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  const T& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  const T* row(int y) const { return &at(0, y); }
};

using DisparityImage = Image<Disparity>;

enum class Content { kPatches, kNoise, kFlat, kExtremes, kAllInvalid };

/// Images as filters meet them: piecewise smooth surfaces with speckles, gaps, and a masked border; or worse.
inline DisparityImage random_disparities(int width, int height, std::uint_fast32_t seed, Content content) {
  std::mt19937 random(seed);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  DisparityImage image(width, height);
  const int gap_percent = below(60);
  const int patch = 3 + below(20);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      int value = kInvalidDisparity;
      switch (content) {
        case Content::kPatches:
          value = 200 + 40 * (((x / patch) * 7 + (y / patch) * 5) % 9) + below(12);
          if (below(100) < 5) value = below(kInvalidDisparity);
          break;
        case Content::kNoise:
          value = below(kInvalidDisparity);
          break;
        case Content::kFlat:
          value = 777;
          break;
        case Content::kExtremes:
          value = below(2) ? kInvalidDisparity - 1 - below(2) : below(2);
          break;
        case Content::kAllInvalid:
          break;
      }
      image.at(x, y).value = static_cast<std::uint16_t>(value);
      if (below(100) < gap_percent) image.at(x, y).value = kInvalidDisparity;
      if (!image.at(x, y).valid()) image.at(x, y).cause = below(2) ? Cause::kUniqueness : Cause::kConsistency;
    }
  }
  const int border = below(3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (std::min({x, y, width - 1 - x, height - 1 - y}) < border)
        image.at(x, y) = {kInvalidDisparity, Cause::kBorder};
    }
  }
  return image;
}

/// Pushes the rows of `input` and collects what the kernel emits. Checks that output row y is emitted by the
/// push of input row y + look_ahead_rows, and not before.
template <class Kernel>
DisparityImage filtered(Kernel& kernel, const DisparityImage& input) {
  DisparityImage output(input.width, input.height);
  int rows = 0;
  for (int y = 0; y < input.height; ++y) {
    kernel.push(input.row(y), [&](const Disparity* row) {
      ASSERT_LT(rows, input.height);
      std::copy(row, row + input.width, &output.at(0, rows));
      ++rows;
    });
    const int complete = y + 1 == input.height ? input.height : std::max(0, y + 1 - kernel.look_ahead_rows());
    EXPECT_EQ(rows, complete) << "after input row " << y;
  }
  return output;
}

/// The first difference is named; printing all would drown it.
inline void expect_equal(const DisparityImage& actual, const DisparityImage& expected) {
  for (int y = 0; y < expected.height; ++y) {
    for (int x = 0; x < expected.width; ++x) {
      ASSERT_EQ(actual.at(x, y), expected.at(x, y))
          << "at x=" << x << " y=" << y << " of " << expected.width << 'x' << expected.height;
    }
  }
}

struct Size {
  int width;
  int height;
};

/// One row, one column, one pixel, smaller than the windows, not a multiple of anything.
inline const std::vector<Size> kOddSizes = {{1, 1}, {1, 37}, {41, 1},  {2, 2},
                                            {3, 5}, {7, 4},  {33, 29}, {64, 17}};

inline const std::vector<Content> kContents = {Content::kPatches, Content::kNoise, Content::kFlat,
                                               Content::kExtremes, Content::kAllInvalid};

/// For all sizes, contents and some seeds, two different frames through one kernel: equal to the reference.
template <class Kernel, class Config, class Reference>
void expect_matches_reference(const Config& config, const Reference& reference) {
  for (const Size size : kOddSizes) {
    Kernel kernel(config, size.width, size.height);
    for (const Content content : kContents) {
      for (unsigned seed = 0; seed < 3; ++seed) {
        const DisparityImage input = random_disparities(size.width, size.height, seed, content);
        expect_equal(filtered(kernel, input), reference(config, input));
        if (::testing::Test::HasFatalFailure()) return;
      }
    }
  }
}

}  // namespace test
}  // namespace parallax
