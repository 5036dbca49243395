// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/relaxed_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace parallax {
namespace {

using Json = nlohmann::ordered_json;

// Gains below this are those of the steady state's own rounding, %.
constexpr double kNoise = 0.1;

Json metric(double value, const char* unit, const char* description) {
  return {{"value", value}, {"unit", unit}, {"description", description}};
}

void add_rates(Json& entry, double frame_rate, double latency) {
  entry["frame_rate"] =
      metric(frame_rate, "frames/s", "Steady-state rate at which the host receives frames.");
  entry["latency"] =
      metric(latency, "ms",
             "From the end of exposure to the frame's last bit at the host, mean of the steady state.");
}

}  // namespace

const RelaxedLimit* RelaxedLimits::limit() const {
  return gains.empty() || gains.front().gain < kNoise ? nullptr : &gains.front();
}

RelaxedLimits relaxed_limits(const EvaluationResult& base, const std::vector<Relaxation>& relaxations,
                             const std::vector<EvaluationResult>& results) {
  RelaxedLimits limits;
  limits.frame_rate = base.rate;
  limits.latency = base.latency.exposure_to_host;
  for (std::size_t i = 0; i < results.size(); ++i) {
    RelaxedLimit limit;
    limit.relaxation = relaxations[i];
    limit.measured = results[i].done();
    if (limit.measured) {
      limit.frame_rate = results[i].rate;
      limit.latency = results[i].latency.exposure_to_host;
      // To a thousandth of a percent: what is less are the roundings of a period.
      limit.gain = std::round(1e5 * (limit.frame_rate / limits.frame_rate - 1)) / 1e3 + 0.0;
      limit.next_part = results[i].limit.part;
    } else {
      limit.message = results[i].message.substr(0, results[i].message.find('\n'));
    }
    limits.gains.push_back(std::move(limit));
  }
  std::stable_sort(limits.gains.begin(), limits.gains.end(),
                   [](const RelaxedLimit& a, const RelaxedLimit& b) { return a.gain > b.gain; });
  return limits;
}

std::string to_text(const RelaxedLimits& limits) {
  std::string lines =
      fmt::format("{:20}{:>9}  {:>15}  {:>8}\n{:20}{:>9.2f} fps {:>11.3f} ms\n", "limit taken away",
                  "frame rate", "latency", "gain", "none", limits.frame_rate, limits.latency);
  for (const RelaxedLimit& limit : limits.gains) {
    lines += limit.measured
                 ? fmt::format("{:20}{:>9.2f} fps {:>11.3f} ms  {:>+6.2f} %  {}\n", limit.relaxation.name(),
                               limit.frame_rate, limit.latency, limit.gain, limit.relaxation.meaning)
                 : fmt::format("{:20}{}\n", limit.relaxation.name(), limit.message);
  }
  const RelaxedLimit* const found = limits.limit();
  return lines + fmt::format("limit               {}\n",
                             found == nullptr ? "none of them alone" : found->relaxation.name());
}

Json to_json(const RelaxedLimits& limits) {
  Json tree;
  const RelaxedLimit* const found = limits.limit();
  tree["limit"] = found == nullptr ? "none" : found->relaxation.name();
  add_rates(tree["base"], limits.frame_rate, limits.latency);
  tree["relaxations"] = Json::array();
  for (const RelaxedLimit& limit : limits.gains) {
    Json entry{{"name", limit.relaxation.name()},
               {"meaning", limit.relaxation.meaning},
               {"set", limit.relaxation.assignments}};
    if (limit.measured) {
      add_rates(entry, limit.frame_rate, limit.latency);
      entry["gain"] = metric(limit.gain, "%", "Of the frame rate, with this limit alone taken away.");
      entry["next_part"] = limit.next_part;
    } else {
      entry["message"] = limit.message;
    }
    tree["relaxations"].push_back(entry);
  }
  return tree;
}

}  // namespace parallax
