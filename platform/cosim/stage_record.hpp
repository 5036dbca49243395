// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "platform/cosim/token_words.hpp"
#include "platform/cosim/vector_manifest.hpp"
#include "platform/machine/machine.hpp"

namespace parallax {

/// What went in and out of a stage while the machine processed images.
struct StageRecord {
  VectorManifest manifest;
  struct Tokens {
    TokenWords words;
    std::vector<std::int64_t> cycles;  ///< of the core's clock, in which each was read, or written
  };
  std::vector<Tokens> streams;  ///< as those of the manifest
  std::size_t slot = 0;         ///< of the pipeline that the stage stands in, 0 is the first upstream
};

/// The stages, of which no token has passed: simulates nothing. None when `interrupted`, as below. Throws
/// UserError when the machine has not all of them, or one whose tokens cannot be recorded.
std::vector<VectorManifest> check_stages(const MachineConfig& config, const MachineInput& input,
                                         const std::vector<std::string>& stages,
                                         const std::function<bool()>& interrupted);

/// The records of some stages, of one machine that processes `input.frames` frames with images, in a process
/// of its own. None when `interrupted` (in_own_process) said yes, or when a circuit in the place of another
/// stage has stopped the simulation before the last frame. The machine has these stages (check_stages).
/// Throws UserError when it fails.
std::vector<StageRecord> record_stages(const MachineConfig& config, const MachineInput& input,
                                       const std::vector<std::string>& stages,
                                       const std::function<bool()>& interrupted);

/// Simulates `machine` until its last frame is at the host, or until something stops the simulation; throws
/// UserError when it gets stuck.
void simulate_to_end(const Machine& machine);

}  // namespace parallax
