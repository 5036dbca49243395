// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "platform/explore/threshold_search.hpp"

namespace parallax {

/// Which of several bounds a number fails, by any numbering; none: it holds them all.
using FailedBounds = std::vector<std::size_t>;

/// find_threshold() of several bounds at once, each of which holds from some number on, or up to some number:
/// the numbers that hold all of them may lie between others that do not. `failed` says it of several numbers
/// at once, in their order: `at_once` of them in each step, at least 1; never twice of one.
Threshold find_bounds(
    std::size_t size, std::size_t start, std::size_t at_once,
    const std::function<std::vector<FailedBounds>(const std::vector<std::size_t>&)>& failed);

}  // namespace parallax
