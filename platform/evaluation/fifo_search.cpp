// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/fifo_search.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>

namespace parallax {
namespace {

using Set = std::vector<Relaxation>;

constexpr std::int64_t kMostTimes = 1024;  // a FIFO of one token gets so many more

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

// Of "streams.a.depth=16".
std::int64_t depth_in(const std::string& assignment) {
  return std::stoll(assignment.substr(assignment.find('=') + 1));
}

std::int64_t depth_of(const Relaxation& fifo) { return depth_in(fifo.assignments.front()); }

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

// The first of `depths`, which ascend, that gains enough, by bisection into three: two are tried at a time,
// as processors are.
std::optional<RelaxedLimit> least_depth(Trials& trials, const std::vector<std::int64_t>& depths,
                                        const std::function<Relaxation(std::int64_t)>& with, double enough) {
  std::optional<RelaxedLimit> least;
  // depths[first] to depths[last - 1] are unknown, what is deeper is enough.
  for (std::size_t first = 0, last = depths.size(); first < last;) {
    const std::size_t third = (last - first) / 3;
    std::vector<std::size_t> probes{first + third};
    if (last - 1 - third > probes[0]) probes.push_back(last - 1 - third);
    Set tried;
    for (const std::size_t probe : probes) tried.push_back(with(depths[probe]));
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
  return least;
}

}  // namespace

std::optional<RelaxedLimit> first_fifo(Trials& trials, const Set& fifos, double enough) {
  if (fifos.empty()) return std::nullopt;
  return first_of(trials, fifos, 1, enough);
}

RelaxedLimit shallowest(Trials& trials, const MachineConfig& config, const RelaxedLimit& deep,
                        double enough) {
  const MetricGroup& metrics = trials.base().metrics;
  const std::string& stream = deep.relaxation.fifos.front();
  std::vector<std::int64_t> depths = fifo_depths(config, metrics, stream);
  const bool has_another = !depths.empty() && depths.back() == 0;
  if (has_another) depths.pop_back();
  const auto with = [&](std::int64_t tokens) { return fifo_relaxation(metrics, stream, tokens); };
  RelaxedLimit least = least_depth(trials, depths, with, enough).value_or(deep);
  if (!has_another) return least;
  const std::optional<RelaxedLimit> derived = with_derived_depth(trials, stream, enough);
  return derived && depth_of(derived->relaxation) < depth_of(least.relaxation) ? *derived : least;
}

// All of them with so many times their depths, then each alone with less, as long as that is enough.
RelaxedLimit shallowest_of_several(Trials& trials, const RelaxedLimit& deep, double enough) {
  const MetricGroup& metrics = trials.base().metrics;
  const std::vector<std::string>& streams = deep.relaxation.fifos;
  std::vector<std::int64_t> depths;
  for (const std::string& stream : streams) depths.push_back(metrics.count("streams/" + stream + "/depth"));
  const auto times = [&](std::int64_t factor) {
    std::vector<std::int64_t> tokens;
    for (const std::int64_t depth : depths) tokens.push_back(std::min(factor * depth, deep_enough(depth)));
    return tokens;
  };
  std::vector<std::int64_t> factors;
  for (std::int64_t factor = 2; factor <= kMostTimes; factor *= 2) factors.push_back(factor);
  std::optional<RelaxedLimit> least = least_depth(
      trials, factors, [&](std::int64_t factor) { return fifos_relaxation(metrics, streams, times(factor)); },
      enough);
  if (!least) return deep;
  std::vector<std::int64_t> tokens;
  for (const std::string& assignment : least->relaxation.assignments) tokens.push_back(depth_in(assignment));
  for (std::size_t i = 0; i < streams.size(); ++i) {
    std::vector<std::int64_t> fewer;
    for (std::int64_t depth = depths[i]; depth < tokens[i]; depth *= 2) fewer.push_back(depth);
    const auto with = [&](std::int64_t depth) {
      std::vector<std::int64_t> changed = tokens;
      changed[i] = depth;
      return fifos_relaxation(metrics, streams, changed);
    };
    const std::optional<RelaxedLimit> shallower = least_depth(trials, fewer, with, enough);
    if (!shallower) continue;
    tokens[i] = depth_in(shallower->relaxation.assignments[i]);
    least = shallower;
  }
  return *least;
}

std::optional<RelaxedLimit> least_default_depth(Trials& trials, const MachineConfig& config, const Set& fifos,
                                                double enough) {
  constexpr std::int64_t kDeepest = 65536;  // that the configuration takes
  if (!default_depth_relaxation(config, fifos, kDeepest)) return std::nullopt;
  std::vector<std::int64_t> depths;
  for (std::int64_t tokens = 2 * std::int64_t{config.streams.default_depth}; tokens <= kDeepest; tokens *= 2)
    depths.push_back(tokens);
  return least_depth(
      trials, depths, [&](std::int64_t tokens) { return *default_depth_relaxation(config, fifos, tokens); },
      enough);
}

}  // namespace parallax
