// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "platform/config/machine_config.hpp"

namespace parallax {

/// A FIFO of the pipeline.
struct PlannedStream {
  std::string name;
  std::int64_t depth = 0;  ///< tokens
  std::int64_t bits = 0;   ///< of a token
};

/// The streams of the pipeline (platform/machine/pipeline.cpp) with their depths and widths, without the
/// modules and the simulation kernel: a thousand machines a second can be asked so. A test holds them against
/// the machine that is built. `width` and `height`: of a tile, px.
std::vector<PlannedStream> plan_streams(const MachineConfig& config, int width, int height);

}  // namespace parallax
