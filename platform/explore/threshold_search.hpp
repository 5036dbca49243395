// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace parallax {

/// Where something that does not hold for small numbers holds for large ones.
struct Threshold {
  bool complete = false;  ///< false: there were fewer answers than asked for
  /// The least number that holds while the one before it does not, both tried; 0 if that holds; nothing if
  /// the last does not. Where it holds, does not, and holds again, it is one of these places.
  std::optional<std::size_t> at;
};

/// Of the numbers from 0 to `size` - 1, in steps that double from `start` on, away from it on the side where
/// the threshold is; then by sections. `hold` says it of several numbers at once, in their order: `at_once`
/// of them in each step, at least 1. So little is tried that lies far from both.
Threshold find_threshold(std::size_t size, std::size_t start, std::size_t at_once,
                         const std::function<std::vector<bool>(const std::vector<std::size_t>&)>& hold);

}  // namespace parallax
