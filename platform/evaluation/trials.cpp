// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/trials.hpp"

#include <algorithm>

namespace parallax {

std::vector<RelaxedLimit> Trials::measure(const std::vector<Relaxation>& some) {
  std::vector<Relaxation> unknown;
  std::copy_if(some.begin(), some.end(), std::back_inserter(unknown),
               [this](const Relaxation& one) { return !measured(one); });
  const std::vector<EvaluationResult> results =
      unknown.empty() ? std::vector<EvaluationResult>{} : trial_(unknown);
  for (std::size_t i = 0; i < results.size(); ++i)
    known_.emplace(unknown[i].assignments, relaxed_limit(base_, unknown[i], results[i]));
  if (results.size() < unknown.size()) throw TrialsEnded();
  std::vector<RelaxedLimit> all;
  for (const Relaxation& one : some) all.push_back(*measured(one));
  return all;
}

std::optional<RelaxedLimit> Trials::measured(const Relaxation& one) const {
  const auto found = known_.find(one.assignments);
  if (found == known_.end()) return std::nullopt;
  RelaxedLimit limit = found->second;
  limit.relaxation = one;
  return limit;
}

std::vector<EvaluationResult> Trials::results(const std::vector<Relaxation>& some) const {
  std::vector<EvaluationResult> all = trial_(some);
  if (all.size() < some.size()) throw TrialsEnded();
  return all;
}

}  // namespace parallax
