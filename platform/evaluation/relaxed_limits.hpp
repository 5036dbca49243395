// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "platform/evaluation/evaluation_result.hpp"
#include "platform/evaluation/relaxation.hpp"

namespace parallax {

/// What became of a machine with limits taken away.
struct RelaxedLimit {
  Relaxation relaxation;
  bool measured = false;
  std::string message;    ///< why it was not
  double frame_rate = 0;  ///< frames/s
  double latency = 0;     ///< ms, from exposure to the host, mean of the steady state
  double gain = 0;        ///< % of the frame rate
  std::string next_part;  ///< that limits then; "none"

  /// More than the steady state's own rounding.
  bool gains() const { return measured && gain >= kNoise; }

  static constexpr double kNoise = 0.1;  ///< %
};

/// `base`: of the machine as it is. `result`: of the relaxation.
RelaxedLimit relaxed_limit(const EvaluationResult& base, const Relaxation& relaxation,
                           const EvaluationResult& result);

/// A machine and its limits, taken away one at a time.
struct RelaxedLimits {
  double frame_rate = 0;
  double latency = 0;
  std::vector<RelaxedLimit> alone;    ///< what gains most first
  std::optional<RelaxedLimit> limit;  ///< what limits: of `alone`, or several that gain only together

  /// "host", "core_clock+host", "none".
  std::string limit_name() const { return limit ? limit->relaxation.name : "none"; }
};

std::string to_text(const RelaxedLimits& limits);
nlohmann::ordered_json to_json(const RelaxedLimits& limits);

}  // namespace parallax
