// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/trial_pool.hpp"

#include <utility>

#include "platform/commands/command_context.hpp"
#include "platform/commands/interruption.hpp"
#include "platform/commands/notes.hpp"
#include "platform/config/preset.hpp"
#include "platform/results/progress.hpp"

namespace parallax {
namespace {

// The input is the same for all.
EvaluationPool::Preparation preparation(const ConfigurationRequest& machine, const EvaluationInput& input) {
  return [machine, input](const Variant& variant, const NoticeSink&) {
    ConfigurationRequest request = machine;
    request.changes = variant.assignments;
    return EvaluationCase{load_configuration(request, preset_folders()), input};
  };
}

}  // namespace

TrialPool::TrialPool(const ConfigurationRequest& machine, const EvaluationInput& input,
                     CommandContext& context, const Interruption& interruption)
    : context_(context), interruption_(interruption), pool_(preparation(machine, input)) {}

std::vector<EvaluationResult> TrialPool::evaluate(const std::vector<Variant>& variants,
                                                  const std::function<void()>& done) {
  std::vector<EvaluationResult> results;
  pool_.evaluate(
      variants, [this] { return interruption_.requested() || std::chrono::steady_clock::now() >= end_; },
      [&](std::size_t, EvaluationResult result) {
        results.push_back(std::move(result));
        done();
      });
  return results;
}

std::vector<EvaluationResult> TrialPool::try_out(const std::vector<Relaxation>& relaxations) {
  std::vector<Variant> variants;
  for (const Relaxation& relaxation : relaxations) variants.push_back({relaxation.assignments});
  Notes notes(context_);
  Progress progress(context_.err, shows_progress(context_), "limits", variants.size(), notes.sink());
  return evaluate(variants, [&progress] { progress.advance(); });
}

}  // namespace parallax
