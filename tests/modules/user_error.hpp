// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tlm/error.hpp"

namespace parallax::test {

/// The line a user would read, empty if there is none.
template <class Action>
std::string complaint_of(const Action& action) {
  try {
    action();
  } catch (const UserError& error) {
    return error.what();
  }
  return {};
}

/// Of a configuration.
template <class Config>
std::string complaint(const Config& config) {
  return complaint_of([&] { config.validate(); });
}

}  // namespace parallax::test
