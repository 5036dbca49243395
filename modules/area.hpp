// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace parallax {

/// Elements of `rows` rows of `width` each, neither of them negative; the product is taken in 64 bits.
constexpr std::size_t area(std::int64_t rows, std::int64_t width) { return rows * width; }

}  // namespace parallax
