// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "platform/config/machine_config.hpp"

namespace parallax {

/// 16 hexadecimal digits that are the same for two machines when all their keys have the same values, however
/// these were given (preset, --set, order, spelling), and almost surely differ otherwise: the 64-bit FNV-1a
/// hash (Fowler, Noll, Vo: offset basis cbf29ce484222325, prime 100000001b3) of the lines "key = value\n",
/// sorted by key, values as `parallax config` writes them.
std::string configuration_hash(const MachineConfig& config);

}  // namespace parallax
