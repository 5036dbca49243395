// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <utility>

namespace parallax {

/// Calls `then` at the second of two calls.
inline std::function<void()> when_both(std::function<void()> then) {
  auto first = std::make_shared<bool>(true);
  return [first, then = std::move(then)] {
    if (!std::exchange(*first, false)) then();
  };
}

}  // namespace parallax
