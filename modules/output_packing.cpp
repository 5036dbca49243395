// SPDX-License-Identifier: Apache-2.0
#include "modules/output_packing.hpp"

namespace parallax {

OutputPacking::OutputPacking(int width) : width_(width), row_(row_bytes(width)) {}

void OutputPacking::push(const Gray* left, const Disparity* disparities, const RowSink<std::uint8_t>& emit) {
  std::uint8_t* out = row_.data();
  for (int x = 0; x < width_; x += 2, out += 5) {
    const bool pair = x + 1 < width_;
    const unsigned p0 = disparities[x].value;
    const unsigned p1 = pair ? disparities[x + 1].value : 0u;
    out[0] = left[x];
    out[1] = pair ? left[x + 1] : Gray{0};
    out[2] = static_cast<std::uint8_t>(p0);
    out[3] = static_cast<std::uint8_t>((p0 >> 8) | (p1 << 4));
    out[4] = static_cast<std::uint8_t>(p1 >> 4);
  }
  emit(row_.data());
}

void unpack_output(const std::uint8_t* bytes, int width, Gray* left, std::uint16_t* disparities) {
  for (int x = 0; x < width; x += 2, bytes += 5) {
    left[x] = bytes[0];
    disparities[x] = static_cast<std::uint16_t>(bytes[2] | (bytes[3] & 0x0F) << 8);
    if (x + 1 == width) return;
    left[x + 1] = bytes[1];
    disparities[x + 1] = static_cast<std::uint16_t>(bytes[3] >> 4 | bytes[4] << 4);
  }
}

}  // namespace parallax
