// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "modules/map_codec.hpp"
#include "platform/config/machine_config.hpp"

namespace parallax {

/// What a run's time depends on beside the configuration.
struct TimingInput {
  int width = 0;                              ///< px, of the images as given
  int height = 0;                             ///< px
  const EncodedMap* map = nullptr;            ///< of the size that is processed; must outlive its use
  std::int64_t frames = 1;                    ///< of the input
  std::optional<std::int64_t> timing_frames;  ///< least number to simulate (frames_to_simulate)
  std::string command;                        ///< echoed in the metrics
  std::optional<std::uint64_t> scene_seed;    ///< likewise, when the built-in scene is the input
};

/// What became of an evaluation.
struct TimingResult {
  enum class Status {
    kDone,
    kInvalid,      ///< the configuration is not possible, or not with this input
    kStuck,        ///< the machine came to a halt before the host had all frames
    kFailed,       ///< a fault of the program or of this computer
    kInterrupted,  ///< the caller gave up on it
  };
  Status status = Status::kFailed;
  nlohmann::ordered_json metrics;  ///< of a timing-only run, as timing.json has them; null unless done
  std::string message;             ///< what is wrong, one line or (stuck) several; empty when done

  /// Of the message, the line that says what to do: the last one.
  std::string advice() const;
};

/// "done", "invalid", "stuck", "failed", "interrupted".
const char* name(TimingResult::Status status);
nlohmann::ordered_json to_json(const TimingResult& result);
/// From what to_json() made; kFailed from anything else.
TimingResult timing_result(const nlohmann::ordered_json& tree);

/// The time of one input in any number of machines. Neither images nor the map are computed anew; each
/// evaluation costs the simulation alone, in a process of its own, as a process can hold one only.
///
/// The map depends on rectification.window and .fraction_bits, and on the size that is processed, so on
/// image.width_granularity and .height_granularity: for a configuration that differs from the map in these
/// the result is kInvalid, and a map for it must be made.
class TimingEvaluator {
 public:
  /// `interrupted` is asked during an evaluation, which ends early when it says yes.
  explicit TimingEvaluator(
      TimingInput input, std::function<bool()> interrupted = [] { return false; });

  /// Never throws for what a configuration can bring about. The calling process must not have simulated.
  TimingResult evaluate(const MachineConfig& config) const;

 private:
  TimingInput input_;
  std::function<bool()> interrupted_;
};

}  // namespace parallax
