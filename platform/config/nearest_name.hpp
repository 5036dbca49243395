// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace parallax {

/// The name that takes the fewest insertions, deletions, substitutions and swaps of neighbours to reach from
/// `name`; the first one in a tie, empty when there are no names.
std::string nearest_name(const std::string& name, const std::vector<std::string>& names);

}  // namespace parallax
