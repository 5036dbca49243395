// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace parallax {

/// How deep the parts of a text lie within each other: what OpenCV's parser of YAML goes down; brackets and
/// braces of JSON; elements of a text that begins as XML does. At least what a parser goes down, for a text
/// that is well formed or not.
std::size_t nesting_depth(std::string_view text);

/// OpenCV's parsers go down with a text, and their stack ends before one of a megabyte does. Throws UserError
/// when the text of this file is deeper than a calibration or a raw map can be.
void check_nesting(const std::string& text, const std::string& path);

}  // namespace parallax
