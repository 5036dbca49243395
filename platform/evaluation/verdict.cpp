// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "platform/results/rate_metrics.hpp"

namespace parallax {
namespace {

std::string spoken(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

// `part`: that which is at work all the time; null where there is none.
std::string sentence(const EvaluationResult& base, const Part* part, const RelaxedLimits& limits) {
  const RelaxedLimit* const found = limits.limit();
  const std::string share = part == nullptr ? "" : fmt::format(" at {:.1f} %", base.limit.utilisation);
  if (found == nullptr) {
    return part == nullptr
               ? "no limit gains anything alone: each frame fills the look-ahead anew, or two are equal"
               : fmt::format("{} limits{}, and so does another: alone, neither gains", spoken(part->name),
                             share);
  }
  const bool named = part != nullptr && part->is_relieved_by(found->relaxation.limit);
  const std::string limiting = named ? part->name : found->relaxation.name();
  const std::string text = fmt::format("{} limits{}; {} gives {:.1f} fps", spoken(limiting),
                                       named ? share : "", found->relaxation.remedy, found->frame_rate);
  if (found->next_part == "none") return text + ", and then no part limits alone";
  if (part != nullptr && found->next_part == part->name)
    return text + fmt::format(", and {} still limits", spoken(part->name));
  return text + fmt::format(", then {} limits", spoken(found->next_part));
}

}  // namespace

Verdict find_verdict(const Machine& machine, const EvaluationResult& base, Thoroughness thoroughness,
                     const Trial& trial) {
  const Part* const part = machine.find_part(base.limit.part);
  std::vector<Relaxation> left = relaxations(machine.config(), base.metrics);
  std::vector<Relaxation> tried;
  std::vector<EvaluationResult> results;
  const auto try_out = [&](const std::vector<Relaxation>& some) {
    for (EvaluationResult& result : trial(some)) results.push_back(std::move(result));
    tried.insert(tried.end(), some.begin(), some.end());
    RelaxedLimits limits = relaxed_limits(base, tried, results);
    return Verdict{sentence(base, part, limits), std::move(limits)};
  };
  const auto busiest = std::find_if(left.begin(), left.end(), [part](const Relaxation& relaxation) {
    return part != nullptr && part->is_relieved_by(relaxation.limit);
  });
  if (thoroughness == Thoroughness::kUntilOneGains && busiest != left.end()) {
    const Relaxation first = *busiest;
    left.erase(busiest);
    Verdict verdict = try_out({first});
    if (verdict.limits.limit() != nullptr) return verdict;
  }
  return try_out(left);
}

void add_verdict(MetricGroup& root, const Verdict& verdict) {
  const RelaxedLimits& limits = verdict.limits;
  const MetricWriter out(root, rate_table());
  const RelaxedLimit* const found = limits.limit();
  out.add("limit/verdict", verdict.sentence);
  out.add("limit/relaxation", found == nullptr ? std::string("none") : found->relaxation.name());
  out.add("limit/relaxed_frame_rate", found == nullptr ? limits.frame_rate : found->frame_rate);
  out.add("limit/relaxed_part", found == nullptr ? std::string("none") : found->next_part);
}

}  // namespace parallax
