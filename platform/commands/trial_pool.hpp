// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <vector>

#include "platform/evaluation/evaluation_pool.hpp"
#include "platform/evaluation/relaxation.hpp"

namespace parallax {

struct CommandContext;
class Interruption;

/// Variants of one machine on one input, with progress at a terminal; a pool (EvaluationPool) that may be
/// used after this process has simulated.
class TrialPool {
 public:
  /// What `input` points to must be there now.
  TrialPool(const ConfigurationRequest& machine, const EvaluationInput& input, CommandContext& context,
            const Interruption& interruption);

  /// Of each variant, in their order; fewer when interrupted, or after end_at().
  std::vector<EvaluationResult> evaluate(
      const std::vector<Variant>& variants, const std::function<void()>& done = [] {});
  /// From then on what is under way is given up, and there are no more results. Without it there is no such
  /// date.
  void end_at(std::chrono::steady_clock::time_point date) { end_ = date; }
  /// Of the machine with each of these limits taken away.
  std::vector<EvaluationResult> try_out(const std::vector<Relaxation>& relaxations);

 private:
  CommandContext& context_;
  const Interruption& interruption_;
  EvaluationPool pool_;
  std::chrono::steady_clock::time_point end_ = std::chrono::steady_clock::time_point::max();
};

}  // namespace parallax
