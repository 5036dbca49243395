// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "platform/config/machine_config.hpp"

namespace parallax {

/// What software writes into the registers of parameters: a value for each row of run_time_parameters(), in
/// the unit of its configuration key. To change one, change the configuration that they are taken from.
struct AlgorithmParameters {
  std::vector<int> values;

  bool operator==(const AlgorithmParameters& other) const { return values == other.values; }
};

/// Those that a configuration holds.
AlgorithmParameters algorithm_parameters(const MachineConfig& config);

/// The configuration with these in it. Throws std::out_of_range when there is not one for each row.
MachineConfig with_parameters(MachineConfig config, const AlgorithmParameters& parameters);

}  // namespace parallax
