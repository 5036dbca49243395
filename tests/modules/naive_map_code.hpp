// SPDX-License-Identifier: Apache-2.0
// Naive reference: the row code of MAP_FORMAT.md, read bit by bit.
#pragma once

#include <cstdint>
#include <vector>

#include "modules/map_codec.hpp"

namespace parallax::test {

struct NaiveDecoded {
  std::vector<std::vector<int>> components;          // left dx, left dy, right dx, right dy; row-major
  std::vector<std::vector<std::uint32_t>> end_bits;  // per row, per pixel
};

inline NaiveDecoded naive_decode(const EncodedMap& map) {
  const int limit = (map.range.window - 1) / 2 * (1 << map.range.fraction_bits);
  int offset_bits = 1;
  while (limit > (1 << (offset_bits - 1)) - 1) {
    ++offset_bits;
  }
  const auto bit_at = [&](std::size_t position) {
    return static_cast<int>((map.bytes.at(position / 8) >> (position % 8)) & 1);
  };
  const auto pixels = static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
  NaiveDecoded out{std::vector<std::vector<int>>(4, std::vector<int>(pixels)), {}};
  std::size_t row_begin = 0;
  for (int y = 0; y < map.height; ++y) {
    std::size_t position = row_begin * 8;
    const auto field = [&](int bits) {
      int value = 0;
      for (int i = 0; i < bits; ++i) {
        value += bit_at(position++) << i;
      }
      return value;
    };
    out.end_bits.emplace_back();
    int widths[4] = {};
    for (int x = 0; x < map.width; ++x) {
      if (x % 16 == 0) {
        for (int& width : widths) {
          width = field(4);
        }
      }
      for (std::size_t c = 0; c < 4; ++c) {
        auto& values = out.components[c];
        const auto at = [&](int px, int py) {
          return px < 0 || py < 0
                     ? 0
                     : values[static_cast<std::size_t>(py) * static_cast<std::size_t>(map.width) +
                              static_cast<std::size_t>(px)];
        };
        int residual = field(widths[c]);
        if (widths[c] > 0 && residual >= 1 << (widths[c] - 1)) {
          residual -= 1 << widths[c];
        }
        int value = at(x - 1, y) + at(x, y - 1) - at(x - 1, y - 1) + residual;
        while (value < -(1 << (offset_bits - 1))) {
          value += 1 << offset_bits;
        }
        while (value >= 1 << (offset_bits - 1)) {
          value -= 1 << offset_bits;
        }
        values[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
               static_cast<std::size_t>(x)] = value;
      }
      out.end_bits.back().push_back(static_cast<std::uint32_t>(position - row_begin * 8));
    }
    row_begin += map.row_bytes[static_cast<std::size_t>(y)];
  }
  return out;
}

}  // namespace parallax::test
