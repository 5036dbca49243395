// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tlm/error.hpp"

namespace parallax::test {

/// The line a user would read, empty if the configuration is accepted.
template <class Config>
std::string complaint(const Config& config) {
  try {
    config.validate();
  } catch (const UserError& error) {
    return error.what();
  }
  return {};
}

}  // namespace parallax::test
