// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace parallax {

/// `text` of a file that may hold anything as a message quotes it: its excerpt() between quotation marks.
std::string in_quotes(std::string_view text);

/// A word, quoted for a shell where need be.
std::string shell_word(const std::string& word);

}  // namespace parallax
