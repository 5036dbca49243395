// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

namespace parallax {

/// The number that `text` is, as a whole: digits with sign, fraction and exponent, or infinity and NaN as C,
/// YAML and Matlab write them. Infinite when a double cannot hold it. None when it is no number.
std::optional<double> number_of(std::string_view text);

}  // namespace parallax
