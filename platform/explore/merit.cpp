// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/merit.hpp"

#include <algorithm>
#include <charconv>

#include "platform/explore/judgement.hpp"

namespace parallax {
namespace {

std::optional<double> number_in(const std::string& text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && last == end ? std::optional(value) : std::nullopt;
}

}  // namespace

std::optional<double> PointNumbers::of(const StoredPoint& point, const std::string& name) const {
  const auto key = std::find(varied_.begin(), varied_.end(), name);
  if (key != varied_.end()) return number_in(point.values[static_cast<std::size_t>(key - varied_.begin())]);
  const auto found = point.result.metrics.find(name);
  if (found == point.result.metrics.end()) return std::nullopt;
  const double* const value = std::get_if<double>(&found->second);
  return value == nullptr ? std::nullopt : std::optional(*value);
}

Merit merit_of(const ExplorationSpec& spec, const StoredPoint& point) {
  Merit merit{Merit::Kind::kFailed, 0, {}};
  if (point.result.status != "done") return merit;
  const PointNumbers numbers(spec);
  for (const Constraint& constraint : spec.constraints)
    merit.missed += miss(constraint, numbers.of(point, constraint.metric));
  for (const Objective& objective : spec.objectives) {
    const std::optional<double> value = numbers.of(point, objective.metric);
    if (!value) return merit;
    merit.costs.push_back(objective.most ? -*value : *value);
  }
  merit.kind = Merit::Kind::kAllowed;
  return merit;
}

bool beats(const Merit& a, const Merit& b) {
  if (a.kind != b.kind) return a.kind < b.kind;
  if (a.kind != Merit::Kind::kAllowed) return false;
  if (a.missed != b.missed) return a.missed < b.missed;
  if (a.missed > 0) return false;
  bool better = false;
  for (std::size_t i = 0; i < a.costs.size(); ++i) {
    if (a.costs[i] > b.costs[i]) return false;
    better = better || a.costs[i] < b.costs[i];
  }
  return better;
}

}  // namespace parallax
