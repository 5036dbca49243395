// SPDX-License-Identifier: Apache-2.0
#include "modules/rectification_map.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "modules/area.hpp"
#include "tlm/error.hpp"

namespace parallax {

namespace {

constexpr int kLargestFractionBits = 8;

}  // namespace

void OffsetRange::validate() const {
  if (window < 1 || window > kLargestWindow || window % 2 == 0) {
    throw UserError(
        fmt::format("rectification.window: {} is not an odd number in 1..{}", window, kLargestWindow));
  }
  if (fraction_bits < 0 || fraction_bits > kLargestFractionBits) {
    throw UserError(
        fmt::format("rectification.fraction_bits: {} is outside 0..{}", fraction_bits, kLargestFractionBits));
  }
  if (limit() > kLargestLimit) {
    throw UserError(fmt::format(
        "rectification.window: {} with {} fraction bits needs offsets of more than 15 bits; at most "
        "{} with this many fraction bits",
        window, fraction_bits, 2 * (kLargestLimit >> fraction_bits) + 1));
  }
}

int OffsetRange::offset_bits() const {
  int bits = 1;
  while ((1 << (bits - 1)) <= limit()) {
    ++bits;
  }
  return bits;
}

RectificationMap RectificationMap::columns(int first, int count) const {
  if (first < 0 || count < 1 || first + count > width) {
    throw std::out_of_range(
        fmt::format("columns {}..{} of a map of width {}", first, first + count - 1, width));
  }
  RectificationMap part{count, height, range, {}};
  part.offsets.reserve(area(count, height));
  for (int y = 0; y < height; ++y) {
    part.offsets.insert(part.offsets.end(), row(y) + first, row(y) + first + count);
  }
  return part;
}

void check_map_size(std::int64_t width, std::int64_t height) {
  if (width * height <= kMostMapPixels) return;
  throw UserError(fmt::format("a rectification map of {}x{} px: it may have {} at most, as {}x{} has", width,
                              height, kMostMapPixels, kMostMapPixels / 8192, 8192));
}

RectificationMap identity_map(int width, int height, const OffsetRange& range) {
  range.validate();
  if (width < 1 || height < 1) {
    throw UserError(fmt::format("identity map: {}x{} is not an image size", width, height));
  }
  check_map_size(width, height);
  return {width, height, range, std::vector<OffsetPair>(area(width, height))};
}

}  // namespace parallax
