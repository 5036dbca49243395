// SPDX-License-Identifier: Apache-2.0
// What circuits usually call their pins.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace parallax {

using PinNames = std::vector<std::string>;

/// By what a pin is at a port, how its name may end behind the port's; "": it is the port's name alone.
const std::map<std::string, PinNames>& pin_endings();

const PinNames& clock_names();
const PinNames& reset_names();
const PinNames& low_reset_names();  ///< active-low
const PinNames& enable_names();     ///< of the clock

/// What ports may call a pin that they share, or that the only port of its direction has.
struct SharedNames {
  PinNames of_inputs, of_outputs;
};
/// Throws std::out_of_range for a role that is of one port alone.
const SharedNames& shared_names(const std::string& role);

}  // namespace parallax
