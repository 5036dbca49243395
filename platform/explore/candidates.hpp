// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace parallax {

/// Numbers from `least` to `most`, ascending, both included where they are such numbers: whole ones up to a
/// thousand, each; others to three significant digits, as assignments have them ("146e6"). Needs 0 < least <=
/// most.
std::vector<std::string> candidates(double least, double most, bool whole);

}  // namespace parallax
