// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace parallax {

/// A fault of the user's input or configuration: one clear line that says what, where and what would be
/// right. The program prints it on standard error and exits with 2. A fault of the model itself is never a
/// UserError.
class UserError : public std::runtime_error {
 public:
  explicit UserError(const std::string& line) : std::runtime_error(line) {}
};

}  // namespace parallax
