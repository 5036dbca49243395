// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace parallax {

/// Firings of a stage, and tokens of a stream, whose dates are kept when they are over. Leap recognises a
/// period that has no more of either.
inline constexpr std::uint64_t kLeapHistory = 64;

}  // namespace parallax
