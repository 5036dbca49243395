// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace parallax {

/// What a rate has gained, in percent of what it was (not 0), to a thousandth of a percent: what is less are
/// the roundings of a period. Never -0.
inline double percent_change(double from, double to) { return std::round(1e5 * (to / from - 1)) / 1e3 + 0.0; }

}  // namespace parallax
