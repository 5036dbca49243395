// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/judgement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parallax {
namespace {

using Costs = std::vector<double>;  // the less, the better

double relative(double short_by, double bound) { return bound == 0 ? short_by : short_by / std::abs(bound); }

bool dominates(const Costs& a, const Costs& b) {
  bool better = false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] > b[i]) return false;
    better = better || a[i] < b[i];
  }
  return better;
}

struct Candidate {
  std::size_t row;
  Costs costs;
};

std::vector<Candidate> candidates(const std::vector<std::vector<std::optional<double>>>& rows,
                                  const std::vector<Objective>& objectives) {
  std::vector<Candidate> all;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    Candidate candidate{row, {}};
    for (std::size_t i = 0; i < objectives.size(); ++i) {
      if (rows[row][i]) candidate.costs.push_back(objectives[i].most ? -*rows[row][i] : *rows[row][i]);
    }
    if (candidate.costs.size() == objectives.size()) all.push_back(std::move(candidate));
  }
  return all;
}

}  // namespace

double miss(const Constraint& constraint, std::optional<double> value) {
  if (!value) return std::numeric_limits<double>::infinity();
  double missed = 0;
  if (constraint.at_least && *value < *constraint.at_least)
    missed = relative(*constraint.at_least - *value, *constraint.at_least);
  if (constraint.at_most && *value > *constraint.at_most)
    missed = std::max(missed, relative(*value - *constraint.at_most, *constraint.at_most));
  return missed;
}

std::vector<std::size_t> pareto_front(const std::vector<std::vector<std::optional<double>>>& rows,
                                      const std::vector<Objective>& objectives) {
  // Sorted by the first objective, a row can be dominated by earlier ones only, and of these by those on the
  // front.
  std::vector<Candidate> all = candidates(rows, objectives);
  std::sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) { return a.costs < b.costs; });
  std::vector<const Candidate*> front;
  for (const Candidate& candidate : all) {
    const bool dominated = std::any_of(front.begin(), front.end(), [&](const Candidate* better) {
      return dominates(better->costs, candidate.costs);
    });
    if (!dominated) front.push_back(&candidate);
  }
  std::vector<std::size_t> numbers;
  for (const Candidate* one : front) numbers.push_back(one->row);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

}  // namespace parallax
