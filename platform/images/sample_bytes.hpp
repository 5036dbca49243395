// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace parallax {

/// A number of type T from sizeof(T) bytes of a file in the byte order given; this machine is little-endian.
template <class T>
T number_of_bytes(const std::uint8_t* bytes, bool big_endian) {
  std::array<std::uint8_t, sizeof(T)> ordered{};
  std::copy_n(bytes, sizeof(T), ordered.begin());
  if (big_endian) std::reverse(ordered.begin(), ordered.end());
  T value;
  std::memcpy(&value, ordered.data(), sizeof(T));
  return value;
}

}  // namespace parallax
