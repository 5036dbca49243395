// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include "tlm/error.hpp"

namespace parallax {

/// Rejects a configuration value outside low..high with one line that names the key as the user wrote it.
inline void require_range(const char* key, int value, int low, int high) {
  if (value < low || value > high) {
    throw UserError(fmt::format("{} = {}: must be within {}..{}", key, value, low, high));
  }
}

/// As require_range, for the width of a window with a centre pixel.
inline void require_odd_range(const char* key, int value, int low, int high) {
  if (value < low || value > high || value % 2 == 0) {
    throw UserError(fmt::format("{} = {}: must be odd and within {}..{}", key, value, low, high));
  }
}

}  // namespace parallax
