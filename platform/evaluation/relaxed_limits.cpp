// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/relaxed_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "platform/results/percent_change.hpp"
#include "traces/number_text.hpp"

namespace parallax {
namespace {

using Json = nlohmann::ordered_json;

Json metric(double value, const char* unit, const char* description) {
  return {{"value", value}, {"unit", unit}, {"description", description}};
}

void add_rates(Json& entry, double frame_rate, double latency) {
  entry["frame_rate"] = metric(frame_rate, "frames/s", "Steady-state rate at which frames are done.");
  entry["latency"] = metric(
      latency, "ms",
      "From the end of exposure to the frame's last bit at the host, or, where the link is off, to its "
      "results in memory; mean of the steady state.");
}

Json entry_of(const RelaxedLimit& limit) {
  Json entry{{"name", limit.relaxation.name},
             {"meaning", limit.relaxation.meaning},
             {"set", limit.relaxation.assignments}};
  if (limit.measured) {
    add_rates(entry, limit.frame_rate, limit.latency);
    entry["gain"] = metric(limit.gain, "%", "Of the frame rate, with this taken away.");
    entry["next_part"] = limit.next_part;
  } else {
    entry["message"] = limit.message;
  }
  return entry;
}

// Those taken away alone, and what is named where that is none of them: several together.
std::vector<const RelaxedLimit*> rows_of(const RelaxedLimits& limits) {
  std::vector<const RelaxedLimit*> rows;
  for (const RelaxedLimit& limit : limits.alone) rows.push_back(&limit);
  const bool listed = std::any_of(rows.begin(), rows.end(), [&](const RelaxedLimit* row) {
    return row->relaxation.name == limits.limit_name();
  });
  if (limits.limit && !listed) rows.push_back(&*limits.limit);
  return rows;
}

}  // namespace

RelaxedLimit relaxed_limit(const EvaluationResult& base, const Relaxation& relaxation,
                           const EvaluationResult& result) {
  RelaxedLimit limit;
  limit.relaxation = relaxation;
  limit.measured = result.done();
  if (limit.measured) {
    limit.frame_rate = result.rate;
    limit.latency = result.latency.exposure_to_host;
    limit.gain = percent_change(base.rate, limit.frame_rate);
    limit.next_part = result.limit.part;
  } else {
    limit.message = result.message.substr(0, result.message.find('\n'));
  }
  return limit;
}

std::string to_text(const RelaxedLimits& limits) {
  const std::vector<const RelaxedLimit*> rows = rows_of(limits);
  std::size_t width = 20;
  for (const RelaxedLimit* row : rows) width = std::max(width, row->relaxation.name.size() + 2);
  std::string lines =
      fmt::format("{:{}}{:>11}  {:>13}  {:>8}\n{:{}}{:>13}  {:>13}\n", "limit taken away", width,
                  "frame rate", "latency", "gain", "none", width,
                  quantity_text(limits.frame_rate, "frames/s"), quantity_text(limits.latency, "ms"));
  for (const RelaxedLimit* row : rows) {
    lines += row->measured
                 ? fmt::format("{:{}}{:>13}  {:>13}  {:>8}  {}\n", row->relaxation.name, width,
                               quantity_text(row->frame_rate, "frames/s"), quantity_text(row->latency, "ms"),
                               change_text(row->gain, "%") + " %", row->relaxation.meaning)
                 : fmt::format("{:{}}{}\n", row->relaxation.name, width, row->message);
  }
  return lines + fmt::format("{:{}}{}\n", "limit", width, limits.limit_name());
}

Json to_json(const RelaxedLimits& limits) {
  Json tree;
  tree["limit"] = limits.limit_name();
  add_rates(tree["base"], limits.frame_rate, limits.latency);
  tree["relaxations"] = Json::array();
  for (const RelaxedLimit* row : rows_of(limits)) tree["relaxations"].push_back(entry_of(*row));
  return tree;
}

}  // namespace parallax
