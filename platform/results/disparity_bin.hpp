// SPDX-License-Identifier: Apache-2.0
// disparity.bin: the disparity map as the device sends it, 12 bits a pixel and no header.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "platform/results/disparity_view.hpp"

namespace parallax {

/// Bytes of one row: pixels in pairs of three bytes. Each row starts at a byte; the device's widths are
/// multiples of 32, so this matters for odd widths only, whose last pixel takes two bytes, the upper half of
/// the second zero.
inline std::size_t packed_row_bytes(int width) { return (3 * width + 1) / 2; }

/// b0 = p0[7:0]; b1 = p0[11:8] | p1[3:0] << 4; b2 = p1[11:4]. The value is in 1/16 px, 0xFFF is invalid.
std::vector<unsigned char> pack_disparities(const DisparityView& map);

/// The 12-bit values. Throws UserError when `bytes` is not the length that the size asks for.
std::vector<std::uint16_t> unpack_disparities(const std::vector<unsigned char>& bytes, int width, int height);

}  // namespace parallax
