// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace parallax {

/// The key that who wrote `path` most likely means; empty when there are no keys. Keys of the same section
/// come first, of the section whose name is like the one written, if it is none. Among them those whose
/// words, of the name split at '_' and '.', are most alike: equal, one within the other, of one meaning, or a
/// slip of fingers apart. In a tie the nearest_name().
std::string nearest_key(const std::string& path, const std::vector<std::string>& keys);

}  // namespace parallax
