// SPDX-License-Identifier: Apache-2.0
#include "platform/results/disparity_bin.hpp"

#include <fmt/format.h>

#include "modules/area.hpp"
#include "tlm/error.hpp"

namespace parallax {

std::vector<unsigned char> pack_disparities(const DisparityView& map) {
  std::vector<unsigned char> bytes;
  bytes.reserve(packed_row_bytes(map.width) * map.height);
  for (int y = 0; y < map.height; ++y) {
    const Disparity* row = map.row(y);
    for (int x = 0; x < map.width; x += 2) {
      const unsigned p0 = row[x].value;
      const bool pair = x + 1 < map.width;
      const unsigned p1 = pair ? row[x + 1].value : 0u;
      bytes.push_back(static_cast<unsigned char>(p0));
      bytes.push_back(static_cast<unsigned char>(((p0 >> 8) & 0xFu) | (p1 << 4)));
      if (pair) {
        bytes.push_back(static_cast<unsigned char>(p1 >> 4));
      }
    }
  }
  return bytes;
}

std::vector<std::uint16_t> unpack_disparities(const std::vector<unsigned char>& bytes, int width,
                                              int height) {
  const std::size_t expected = packed_row_bytes(width) * height;
  if (bytes.size() != expected) {
    throw UserError(fmt::format("the packed disparity map has {} bytes, {}x{} pixels of 12 bits need {}",
                                bytes.size(), width, height, expected));
  }
  std::vector<std::uint16_t> values;
  values.reserve(area(width, height));
  const unsigned char* in = bytes.data();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; x += 2) {
      values.push_back(static_cast<std::uint16_t>(in[0] | (in[1] & 0xFu) << 8));
      if (x + 1 < width) {
        values.push_back(static_cast<std::uint16_t>(in[1] >> 4 | in[2] << 4));
        ++in;
      }
      in += 2;
    }
  }
  return values;
}

}  // namespace parallax
