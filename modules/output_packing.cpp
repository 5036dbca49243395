// SPDX-License-Identifier: Apache-2.0
#include "modules/output_packing.hpp"

#include <algorithm>

namespace parallax {

OutputPacking::OutputPacking(int width, OutputLeft format)
    : width_(width), format_(format), row_(row_bytes(width, format)) {}

void OutputPacking::push(const Gray* left, const Disparity* disparities, const RowSink<std::uint8_t>& emit) {
  const std::size_t each = left_bytes(format_);
  std::uint8_t* out = row_.data();
  for (int x = 0; x < width_; x += 2, out += pair_bytes(format_)) {
    const bool pair = x + 1 < width_;
    const unsigned p0 = disparities[x].value;
    const unsigned p1 = pair ? disparities[x + 1].value : 0u;
    std::fill_n(out, each, left[x]);
    std::fill_n(out + each, each, pair ? left[x + 1] : Gray{0});
    std::uint8_t* packed = out + 2 * each;
    packed[0] = static_cast<std::uint8_t>(p0);
    packed[1] = static_cast<std::uint8_t>((p0 >> 8) | (p1 << 4));
    packed[2] = static_cast<std::uint8_t>(p1 >> 4);
  }
  emit(row_.data());
}

void unpack_output(const std::uint8_t* bytes, int width, OutputLeft format, Gray* left,
                   std::uint16_t* disparities) {
  const std::size_t pair = OutputPacking::pair_bytes(format);
  const std::size_t each = (pair - 3) / 2;
  for (int x = 0; x < width; x += 2, bytes += pair) {
    const std::uint8_t* packed = bytes + 2 * each;
    left[x] = bytes[0];
    disparities[x] = static_cast<std::uint16_t>(packed[0] | (packed[1] & 0x0F) << 8);
    if (x + 1 == width) return;
    left[x + 1] = bytes[each];
    disparities[x + 1] = static_cast<std::uint16_t>(packed[1] >> 4 | packed[2] << 4);
  }
}

}  // namespace parallax
