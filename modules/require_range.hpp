// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tlm/error.hpp"

namespace parallax {

/// Rejects a configuration value outside [low, high] with one line that names the key as the user wrote it.
inline void require_range(const std::string& key, int value, int low, int high) {
  if (value < low || value > high) {
    throw UserError(key + ": " + std::to_string(value) + " is out of range, allowed are " +
                    std::to_string(low) + " to " + std::to_string(high));
  }
}

/// As require_range, for the width of a window with a centre pixel.
inline void require_odd_range(const std::string& key, int value, int low, int high) {
  if (value < low || value > high || value % 2 == 0) {
    throw UserError(key + ": " + std::to_string(value) +
                    " is out of range, allowed are the odd numbers from " + std::to_string(low) + " to " +
                    std::to_string(high));
  }
}

}  // namespace parallax
