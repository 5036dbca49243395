// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace parallax {

/// Fewest insertions, deletions, substitutions and swaps of two neighbours, the commonest slip of fingers,
/// that make `b` of `a`, where no letter is changed twice (optimal string alignment).
std::size_t edit_distance(const std::string& a, const std::string& b);

/// The name that takes the fewest insertions, deletions, substitutions and swaps of neighbours to reach from
/// `name`; the first one in a tie, empty when there are no names.
std::string nearest_name(const std::string& name, const std::vector<std::string>& names);

}  // namespace parallax
