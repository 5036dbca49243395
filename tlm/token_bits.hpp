// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace parallax {

/// Bits that a value of type T takes on wires, where the type alone says so; 1: it does not. A stream of T
/// that is narrower is refused (Stream).
template <class T>
inline constexpr int kLeastBits = 1;

}  // namespace parallax
