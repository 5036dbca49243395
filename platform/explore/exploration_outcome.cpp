// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/exploration_outcome.hpp"

#include <cmath>
#include <limits>

#include "platform/evaluation/evaluation_result.hpp"
#include "platform/explore/judgement.hpp"
#include "platform/explore/merit.hpp"

namespace parallax {
namespace {

// One point after the other; what is kept of each is its objectives.
class Judge {
 public:
  explicit Judge(const ExplorationSpec& spec) : spec_(spec), numbers_(spec) {}

  void look_at(const StoredPoint& point) {
    ++outcome_.by_status[point.result.status];
    if (point.result.status != "done") {
      if (!outcome_.fault) outcome_.fault = PointFault{point.number, advice_in(point.result.message)};
      return;
    }
    double missed = 0;
    NearestMiss worst{point.number, nullptr, 0};
    double most = 0;
    for (const Constraint& constraint : spec_.constraints) {
      const std::optional<double> value = numbers_.of(point, constraint.metric);
      const double by = miss(constraint, value);
      missed += by;
      if (by > most) {
        most = by;
        worst.constraint = &constraint;
        worst.value = value.value_or(std::nan(""));
      }
    }
    if (missed > 0) {
      if (missed < least_missed_) {
        least_missed_ = missed;
        outcome_.nearest = worst;
      }
      return;
    }
    outcome_.satisfied.insert(point.number);
    if (spec_.objectives.empty()) return;
    satisfied_.push_back(point.number);
    rows_.emplace_back();
    for (const Objective& objective : spec_.objectives)
      rows_.back().push_back(numbers_.of(point, objective.metric));
  }

  ExplorationOutcome outcome() {
    if (!outcome_.satisfied.empty()) outcome_.nearest.reset();
    if (spec_.objectives.empty()) {
      outcome_.front = outcome_.satisfied;
    } else {
      for (const std::size_t row : pareto_front(rows_, spec_.objectives))
        outcome_.front.insert(satisfied_[row]);
    }
    return std::move(outcome_);
  }

 private:
  const ExplorationSpec& spec_;
  const PointNumbers numbers_;
  ExplorationOutcome outcome_;
  double least_missed_ = std::numeric_limits<double>::infinity();
  std::vector<std::size_t> satisfied_;  // by their numbers
  std::vector<std::vector<std::optional<double>>> rows_;
};

}  // namespace

std::size_t ExplorationOutcome::done() const {
  const auto found = by_status.find("done");
  return found == by_status.end() ? 0 : found->second;
}

ExplorationOutcome judge(const ExplorationSpec& spec, ResultStore& store) {
  Judge judge(spec);
  store.each_point(spec.named_metrics(), [&judge](const StoredPoint& point) { judge.look_at(point); });
  return judge.outcome();
}

}  // namespace parallax
