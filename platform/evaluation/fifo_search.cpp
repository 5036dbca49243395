// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/fifo_search.hpp"

#include <algorithm>
#include <cstdint>

namespace parallax {
namespace {

using Set = std::vector<Relaxation>;

bool gains_enough(const RelaxedLimit& limit, double enough) { return limit.measured && limit.gain >= enough; }

// The depth that the model derives, if that gains enough.
std::optional<RelaxedLimit> with_derived_depth(const Trials& trials, const std::string& stream,
                                               double enough) {
  const MetricGroup& metrics = trials.base().metrics;
  const EvaluationResult result = trials.results({fifo_relaxation(metrics, stream, 0)}).front();
  if (!result.done()) return std::nullopt;
  const std::int64_t tokens = result.metrics.count("streams/" + stream + "/depth");
  RelaxedLimit limit = relaxed_limit(trials.base(), fifo_relaxation(metrics, stream, tokens), result);
  if (!gains_enough(limit, enough)) return std::nullopt;
  return limit;
}

std::int64_t depth_of(const Relaxation& fifo) {
  const std::string& assignment = fifo.assignments.front();
  return std::stoll(assignment.substr(assignment.find('=') + 1));
}

std::optional<RelaxedLimit> first_of(Trials& trials, const Set& fifos, std::size_t first_part,
                                     double enough) {
  if (fifos.size() == 1) {
    const RelaxedLimit limit = trials.measure(fifos.front());
    return gains_enough(limit, enough) ? std::optional<RelaxedLimit>(limit) : std::nullopt;
  }
  const auto middle = fifos.begin() + static_cast<std::ptrdiff_t>(first_part);
  const std::vector<Set> parts{{fifos.begin(), middle}, {middle, fifos.end()}};
  const std::vector<RelaxedLimit> measured = trials.measure(Set{together(parts[0]), together(parts[1])});
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!gains_enough(measured[i], enough)) continue;
    if (std::optional<RelaxedLimit> found = first_of(trials, parts[i], parts[i].size() / 2, enough))
      return found;
  }
  return std::nullopt;
}

}  // namespace

std::optional<RelaxedLimit> first_fifo(Trials& trials, const Set& fifos, double enough) {
  if (fifos.empty()) return std::nullopt;
  return first_of(trials, fifos, 1, enough);
}

RelaxedLimit shallowest(Trials& trials, const MachineConfig& config, const RelaxedLimit& deep,
                        double enough) {
  const MetricGroup& metrics = trials.base().metrics;
  const std::string& stream = deep.relaxation.fifo;
  std::vector<std::int64_t> depths = fifo_depths(config, metrics, stream);
  const bool has_another = !depths.empty() && depths.back() == 0;
  if (has_another) depths.pop_back();
  RelaxedLimit least = deep;
  // depths[first] to depths[last - 1] are unknown, what is deeper is enough. Two at a time, as processors
  // are.
  for (std::size_t first = 0, last = depths.size(); first < last;) {
    const std::size_t third = (last - first) / 3;
    std::vector<std::size_t> probes{first + third};
    if (last - 1 - third > probes[0]) probes.push_back(last - 1 - third);
    Set tried;
    for (const std::size_t probe : probes) tried.push_back(fifo_relaxation(metrics, stream, depths[probe]));
    const std::vector<RelaxedLimit> measured = trials.measure(tried);
    for (std::size_t i = probes.size(); i-- > 0;) {
      if (!gains_enough(measured[i], enough)) {
        first = probes[i] + 1;
        break;
      }
      least = measured[i];
      last = probes[i];
    }
  }
  if (!has_another) return least;
  const std::optional<RelaxedLimit> derived = with_derived_depth(trials, stream, enough);
  return derived && depth_of(derived->relaxation) < depth_of(least.relaxation) ? *derived : least;
}

}  // namespace parallax
