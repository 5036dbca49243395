// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "platform/cosim/token_words.hpp"
#include "platform/cosim/vector_manifest.hpp"
#include "platform/machine/machine.hpp"

namespace parallax {

/// What went out of a stage of the model while the machine processed images.
struct StageRecord {
  VectorManifest manifest;
  struct Tokens {
    TokenWords words;
    std::vector<std::int64_t> cycles;  ///< of the core's clock, in which each was written
  };
  std::vector<Tokens> outputs;  ///< as the output streams of the manifest
};

/// Runs the machine without replacements on `frames` frames with images, in a process of its own, as this one
/// may have one simulation only; `expose` brings the images. Throws UserError when there is no such stage, or
/// when that machine fails. `interrupted` is asked some ten times a second; when it says yes, the record has
/// no frames.
StageRecord record_stage(const MachineConfig& config, const MachineInput& input, const std::string& stage,
                         const std::function<bool()>& interrupted);

}  // namespace parallax
