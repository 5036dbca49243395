// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace parallax {

/// `text` of a file that may hold anything, fit for a line: control characters as ?, the end left out when it
/// is long.
std::string printable(std::string_view text);

/// The same between quotation marks.
std::string in_quotes(std::string_view text);

}  // namespace parallax
