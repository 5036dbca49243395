// SPDX-License-Identifier: Apache-2.0
#pragma once

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

  /// Of each variant, in their order; fewer when interrupted.
  std::vector<EvaluationResult> evaluate(
      const std::vector<Variant>& variants, const std::function<void()>& done = [] {});
  /// Of the machine with each of these limits taken away.
  std::vector<EvaluationResult> try_out(const std::vector<Relaxation>& relaxations);

 private:
  CommandContext& context_;
  const Interruption& interruption_;
  EvaluationPool pool_;
};

}  // namespace parallax
