// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace parallax {

/// Copies `count` elements out of a ring of `size`, a power of two and at least `count`, or into it, from
/// index `first` on: in two pieces, which is some five times faster than to find each one's slot.
template <class T>
void copy_out_of_ring(const T* ring, std::size_t size, std::uint64_t first, std::size_t count, T* out) {
  const std::size_t at = first & (size - 1);
  const std::size_t piece = std::min(count, size - at);
  std::copy_n(ring + at, piece, out);
  std::copy_n(ring, count - piece, out + piece);
}

template <class T>
void copy_into_ring(const T* in, std::size_t count, T* ring, std::size_t size, std::uint64_t first) {
  const std::size_t at = first & (size - 1);
  const std::size_t piece = std::min(count, size - at);
  std::copy_n(in, piece, ring + at);
  std::copy_n(in + piece, count - piece, ring);
}

}  // namespace parallax
