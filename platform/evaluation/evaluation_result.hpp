// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "traces/metrics.hpp"

namespace parallax {

/// Of a message of several lines, the one that says what to do: the last.
std::string advice_in(const std::string& message);

/// What became of an evaluation: whether it could be done, what most ask for, and all that was measured.
struct EvaluationResult {
  enum class Status {
    kDone,
    kInvalid,      ///< the configuration is not possible, or not with this input
    kStuck,        ///< the machine came to a halt before the host had all frames
    kFailed,       ///< a fault of the program or of this computer
    kInterrupted,  ///< the caller gave up on it
    kTooSlow,      ///< a frame took longer than asked for (EvaluationInput::longest_frame_ps)
  };
  /// Means of the steady state, ms.
  struct Latencies {
    double first_pixel = 0;       ///< from the frame in memory to its first disparity
    double last_pixel = 0;        ///< and to its last
    double exposure_to_host = 0;  ///< from the end of exposure to the frame's last bit at the host
  };
  struct Limit {
    std::string part = "none";             ///< that is at work all the time
    double utilisation = 0;                ///< of it, or of the busiest, %
    std::vector<std::string> relieved_by;  ///< names of the limits without which it would be faster
  };

  Status status = Status::kFailed;
  std::string message;  ///< what is wrong, one line or (stuck) several; empty when done
  double rate = 0;      ///< frames/s in the steady state; 0: a single frame has none
  Latencies latency;
  Limit limit;
  std::int64_t disparities = 0;    ///< that are searched
  MetricGroup metrics;             ///< all that was measured; empty unless done
  std::string configuration;       ///< of the machine, key by key, as JSON, where a pool evaluated it
  std::vector<std::string> notes;  ///< what was said of the input, one line each
  double wall_seconds = 0;         ///< that it took, where a pool evaluated it
  double processor_seconds = 0;    ///< likewise

  bool done() const { return status == Status::kDone; }
  std::string advice() const { return advice_in(message); }
};

/// Of a run that came to its end.
EvaluationResult measured(MetricGroup metrics);
/// Of one that did not.
EvaluationResult not_measured(EvaluationResult::Status status, std::string message);
/// Of one whose process died; by this signal, 0: by itself.
EvaluationResult without_result(int signal);

/// "done", "invalid", "stuck", "failed", "interrupted", "too slow".
const char* name(EvaluationResult::Status status);
/// Nothing for any other word.
std::optional<EvaluationResult::Status> status_named(const std::string& word);

/// What timing.json holds.
nlohmann::ordered_json timing_json(const MetricGroup& metrics, nlohmann::ordered_json configuration);
/// Likewise, of one that a pool evaluated.
nlohmann::ordered_json timing_json(const EvaluationResult& result);

/// As bytes (a protocol buffer), to hand it from one process to another.
std::string to_bytes(const EvaluationResult& result);
/// From what to_bytes() made; kFailed from anything else.
EvaluationResult evaluation_result(const std::string& bytes);

}  // namespace parallax
