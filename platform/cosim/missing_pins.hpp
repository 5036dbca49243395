// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "platform/cosim/pin_lookup.hpp"

namespace parallax {

/// Data of a port that no pin of the circuit carries.
struct MissingPin {
  std::string role;       ///< "in_left.data", "in_map_left.dx"
  std::size_t width = 0;  ///< bits
  bool is_input = false;
};

/// Throws UserError, with all of them, when something is missing or an input has bits without a use: these
/// would be 0 for ever, and the user would not know.
void check_missing(const std::string& circuit, const std::string& stage,
                   const std::vector<MissingPin>& missing, const PinLookup& lookup);

}  // namespace parallax
