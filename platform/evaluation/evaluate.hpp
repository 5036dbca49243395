// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "modules/map_codec.hpp"
#include "platform/config/machine_config.hpp"
#include "platform/evaluation/evaluation_result.hpp"

namespace parallax {

/// What a machine's time depends on beside its configuration.
///
/// The map depends on rectification.window and .fraction_bits, and on the size that is processed, so on
/// image.width_granularity and .height_granularity: a machine that differs from its map in these needs
/// another one (EvaluationInputs makes it).
struct EvaluationInput {
  int width = 0;                              ///< px, of the images as given
  int height = 0;                             ///< px
  const EncodedMap* map = nullptr;            ///< of the size that is processed; must outlive its use
  std::int64_t frames = 1;                    ///< of the input
  std::optional<std::int64_t> timing_frames;  ///< least number to simulate (run_length)
  /// 0, or so many picoseconds: the run is over, and too slow, as soon as the core takes longer for a frame.
  /// Where software queues frames, that counts of those that were in memory when the core was done with the
  /// one before; where it does not, of every frame, with the software's response. By 0.01 % longer, so that
  /// the phases of the memory do not decide.
  std::int64_t longest_frame_ps = 0;
  std::string command;                      ///< echoed in the metrics
  std::optional<std::uint64_t> scene_seed;  ///< likewise, when the built-in scene is the input
};

/// The time of a machine on an input, without images. Never throws for what a configuration can bring about:
/// that is the result's status. The simulation has a process of its own, as a process can hold one only; the
/// calling process must not have simulated, and should have one thread. `interrupted` is asked some ten times
/// a second; when it says yes, the simulation is given up.
EvaluationResult evaluate(
    const MachineConfig& config, const EvaluationInput& input,
    const std::function<bool()>& interrupted = [] { return false; });

}  // namespace parallax
