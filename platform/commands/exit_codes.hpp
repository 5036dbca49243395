// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace parallax {

/// What the program ends with. 0: done.
constexpr int kNotAsExpected = 1;  ///< stuck, a point that cannot be measured, a figure outside its tolerance
constexpr int kBadInput = 2;       ///< a UserError: nothing was done, or the frames before the fault
constexpr int kInternalError = 3;

/// As shells report a program that a signal ended.
constexpr int ended_by(int signal) { return 128 + signal; }

}  // namespace parallax
