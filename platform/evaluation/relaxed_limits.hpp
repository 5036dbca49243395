// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "platform/evaluation/evaluation_result.hpp"
#include "platform/evaluation/relaxation.hpp"

namespace parallax {

/// What became of a machine with one limit taken away.
struct RelaxedLimit {
  Relaxation relaxation;
  bool measured = false;
  std::string message;    ///< why it was not
  double frame_rate = 0;  ///< frames/s
  double latency = 0;     ///< ms, from exposure to the host, mean of the steady state
  double gain = 0;        ///< % of the frame rate
  std::string next_part;  ///< that limits then; "none"
};

/// A machine and its limits, taken away one at a time; what gains most first.
struct RelaxedLimits {
  double frame_rate = 0;
  double latency = 0;
  std::vector<RelaxedLimit> gains;

  /// That of the largest gain; null where none gains anything.
  const RelaxedLimit* limit() const;
};

/// `base`: of the machine as it is. `results`: of the relaxations, in their order.
RelaxedLimits relaxed_limits(const EvaluationResult& base, const std::vector<Relaxation>& relaxations,
                             const std::vector<EvaluationResult>& results);

std::string to_text(const RelaxedLimits& limits);
nlohmann::ordered_json to_json(const RelaxedLimits& limits);

}  // namespace parallax
