// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tlm/error.hpp"

namespace parallax {

/// The line of the UserError that `action` throws, or a text that no test expects.
template <class Action>
std::string error_of(const Action& action) {
  try {
    action();
  } catch (const UserError& error) {
    return error.what();
  }
  return "(no error)";
}

}  // namespace parallax
