// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace parallax {

/// The one line of the UserError that `action` throws; "no error" when it throws none.
template <class Error, class Action>
std::string error_line(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace parallax
