// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace parallax {

/// How deep the parts of a text lie within each other: brackets and braces of YAML and JSON, with the blanks
/// before a line of YAML and the colons and dashes in it; elements of a text that begins as XML does. At
/// least what a parser goes down, for a text that is well formed or not.
std::size_t nesting_depth(std::string_view text);

/// Parsers of OpenCV and yaml-cpp go down with a text, and their stack ends before one of a megabyte does.
/// Throws UserError when the text of this file is deeper than a calibration or a raw map can be.
void check_nesting(const std::string& text, const std::string& path);

}  // namespace parallax
