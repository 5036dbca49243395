// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/alone_search.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "platform/evaluation/own_work.hpp"

namespace parallax {
namespace {

constexpr double kMostAnomaly = 0.01;  // of the frame rate

// How likely it is, from the run of the machine as it is, that this limits where the busiest part does not:
// %, as the part of that name was busy.
double likelihood(const Relaxation& relaxation, const MetricGroup& metrics) {
  const Relief limit = relaxation.limits.front();
  // Path costs in memory and FIFOs that are too shallow hold up all other parts.
  if (limit == Relief::kPathStorage) return 300;
  if (limit == Relief::kBufferPort) return 200;
  if (limit == Relief::kFifos) return 150;
  const char* const part = limit == Relief::kMemoryClock   ? "memory"
                           : limit == Relief::kCoreClock   ? "core"
                           : limit == Relief::kCameraClock ? "camera"
                           : limit == Relief::kLinkClock   ? "link"
                                                           : name_of(limit);
  return metrics.number_or(std::string("limit/utilisation_by_part/") + part, 0);
}

}  // namespace

void AloneSearch::run(const std::vector<Relaxation>& own, const std::vector<Relaxation>& others) {
  std::vector<Relaxation> sorted = others;
  std::stable_sort(sorted.begin(), sorted.end(), [this](const Relaxation& a, const Relaxation& b) {
    return likelihood(a, trials_.base().metrics) > likelihood(b, trials_.base().metrics);
  });
  std::vector<std::vector<Relaxation>> sets;
  for (const Relaxation& one : own) sets.push_back({one});
  branch(sets);
  if (besides_.empty()) {
    const auto hopeless = [this](const Relaxation& one) {
      return most_gain(one, trials_.base().metrics) < worth_a_look();
    };
    sorted.erase(std::remove_if(sorted.begin(), sorted.end(), hopeless), sorted.end());
  }
  if (!sorted.empty()) branch({sorted});
  for (bool first = true; !open_.empty(); first = false) {
    const auto most = std::max_element(open_.begin(), open_.end(),
                                       [](const Node& a, const Node& b) { return a.gain < b.gain; });
    const Node node = std::move(*most);
    open_.erase(most);
    if (node.gain < worth_a_look()) return;
    const auto middle = node.set.begin() + (first ? 1 : static_cast<std::ptrdiff_t>(node.set.size()) / 2);
    branch({{node.set.begin(), middle}, {middle, node.set.end()}});
  }
}

// Tries these sets; those of one alone are found, the others are open.
void AloneSearch::branch(const std::vector<std::vector<Relaxation>>& sets) {
  std::vector<Relaxation> tried;
  for (const std::vector<Relaxation>& set : sets) {
    std::vector<Relaxation> all = besides_;
    all.insert(all.end(), set.begin(), set.end());
    tried.push_back(together(all));
  }
  std::vector<RelaxedLimit> measured;
  try {
    measured = trials_.measure(tried);
  } catch (const TrialsEnded&) {
    for (std::size_t i = 0; i < sets.size(); ++i) {
      const std::optional<RelaxedLimit> limit = trials_.measured(tried[i]);
      if (sets[i].size() == 1 && limit) found_(*limit);
    }
    throw;
  }
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const RelaxedLimit& limit = measured[i];
    if (sets[i].size() > 1) {
      // What cannot be measured together says nothing of its members.
      open_.push_back({sets[i], limit.measured ? limit.gain : std::numeric_limits<double>::infinity()});
      continue;
    }
    found_(limit);
    if (limit.measured) best_ = std::max(best_, limit.gain);
  }
}

double AloneSearch::worth_a_look() const {
  return std::max(RelaxedLimit::kNoise, best_ - std::min(kMostAnomaly * (100 + best_), best_ / 2));
}

}  // namespace parallax
