// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "platform/evaluation/relaxed_limits.hpp"

namespace parallax {

/// Evaluates the machine with each of these taken away, in their order. Fewer results: whoever does it wants
/// no more.
using Trial = std::function<std::vector<EvaluationResult>(const std::vector<Relaxation>&)>;

/// Thrown when fewer results came than were asked for.
struct TrialsEnded {};

/// What relaxations of one machine gain; of those that set the same one is tried.
class Trials {
 public:
  /// `base`: of the machine as it is. Both must outlive this object.
  Trials(const EvaluationResult& base, const Trial& trial) : base_(base), trial_(trial) {}

  /// In their order. Throws TrialsEnded; what came before is kept, and measured() has it.
  std::vector<RelaxedLimit> measure(const std::vector<Relaxation>& some);
  RelaxedLimit measure(const Relaxation& one) { return measure(std::vector<Relaxation>{one}).front(); }
  /// What is known of it, without a trial.
  std::optional<RelaxedLimit> measured(const Relaxation& one) const;
  /// All that was measured of it. Throws TrialsEnded.
  std::vector<EvaluationResult> results(const std::vector<Relaxation>& some) const;

  const EvaluationResult& base() const { return base_; }

 private:
  const EvaluationResult& base_;
  const Trial& trial_;
  std::map<std::vector<std::string>, RelaxedLimit> known_;  // by the assignments
};

}  // namespace parallax
