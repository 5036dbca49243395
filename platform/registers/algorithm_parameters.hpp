// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/config/machine_config.hpp"

namespace parallax {

/// What software may change from frame to frame, in the units of the stages' configurations.
struct AlgorithmParameters {
  int p1 = 0;
  int p2 = 0;
  bool mask_border = false;
  bool uniqueness = false;
  int uniqueness_factor = 256;
  bool consistency = false;
  int consistency_threshold = 0;
  bool texture = false;
  int texture_threshold = 0;
  int speckle_iterations = 0;
  bool gap_interpolation = false;
  bool noise_reduction = false;

  bool operator==(const AlgorithmParameters& other) const;
};

/// Those that the machine is configured with.
AlgorithmParameters algorithm_parameters(const MachineConfig& config);

/// The configuration with these in it.
MachineConfig with_parameters(MachineConfig config, const AlgorithmParameters& parameters);

}  // namespace parallax
