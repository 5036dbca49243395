// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace parallax {

/// A fault of the user's input or configuration: one clear line that says what, where and what would be
/// right. The program prints it on standard error and exits with 2. A fault of the model itself is never a
/// UserError.
class UserError : public std::runtime_error {
 public:
  explicit UserError(const std::string& line) : std::runtime_error(line) {}
};

/// Text of the user's as a message quotes it: at most so many bytes, then "..."; what is no character to be
/// read, such as the end of a line, is a blank.
std::string excerpt(std::string_view text, std::size_t most = 60);

}  // namespace parallax
