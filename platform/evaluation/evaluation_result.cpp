// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/evaluation_result.hpp"
#include "traces/json_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <sstream>
#include <utility>

namespace parallax {
namespace {

using Json = nlohmann::ordered_json;
using Status = EvaluationResult::Status;

constexpr std::array<Status, 6> kStatuses{Status::kDone,   Status::kInvalid,     Status::kStuck,
                                          Status::kFailed, Status::kInterrupted, Status::kTooSlow};

}  // namespace

std::string advice_in(const std::string& message) {
  std::string line = message;
  while (!line.empty() && line.back() == '\n') line.pop_back();
  line.erase(0, line.rfind('\n') + 1);
  return line.erase(0, line.find_first_not_of(' '));
}

EvaluationResult measured(MetricGroup metrics) {
  EvaluationResult result;
  result.status = Status::kDone;
  result.rate = metrics.number("performance/frame_rate");
  result.latency.first_pixel = metrics.number("latency/first_pixel_mean");
  result.latency.last_pixel = metrics.number("latency/last_pixel_mean");
  result.latency.exposure_to_host = metrics.number("latency/exposure_to_host_mean");
  result.limit.part = metrics.word_or("limit/part", "none");
  result.limit.utilisation = metrics.number_or("limit/utilisation", 0);
  std::istringstream reliefs(metrics.word_or("limit/relieved_by", ""));
  for (std::string name; reliefs >> name;) result.limit.relieved_by.push_back(name);
  result.disparities = metrics.count("input/disparity_range");
  result.metrics = std::move(metrics);
  return result;
}

EvaluationResult not_measured(Status status, std::string message) {
  EvaluationResult result;
  result.status = status;
  result.message = std::move(message);
  return result;
}

EvaluationResult without_result(int signal) {
  return not_measured(Status::kFailed, signal == 0 ? "the simulation ended without a result"
                                                   : fmt::format("the simulation was ended by signal {} ({})",
                                                                 signal, ::strsignal(signal)));
}

const char* name(Status status) {
  switch (status) {
    case Status::kDone:
      return "done";
    case Status::kInvalid:
      return "invalid";
    case Status::kStuck:
      return "stuck";
    case Status::kFailed:
      return "failed";
    case Status::kInterrupted:
      return "interrupted";
    case Status::kTooSlow:
      return "too slow";
  }
  return "";
}

Json timing_json(const MetricGroup& metrics, Json configuration) {
  Json tree = to_json(metrics);
  tree["configuration"] = std::move(configuration);
  return tree;
}

std::string to_text(const EvaluationResult& result) {
  return json_text(Json{{"status", name(result.status)},
                        {"message", result.message},
                        {"notes", result.notes},
                        {"wall_seconds", result.wall_seconds},
                        {"processor_seconds", result.processor_seconds},
                        {"metrics", to_json(result.metrics)},
                        {"configuration", result.configuration}});
}

EvaluationResult evaluation_result(const std::string& text) try {
  Json tree = Json::parse(text);
  const std::string word = tree.at("status");
  const Status* const status =
      std::find_if(kStatuses.begin(), kStatuses.end(), [&](Status s) { return word == name(s); });
  if (status == kStatuses.end()) return without_result(0);
  EvaluationResult result = *status == Status::kDone ? measured(metrics_of(tree.at("metrics")))
                                                     : not_measured(*status, tree.at("message"));
  result.notes = tree.at("notes").get<std::vector<std::string>>();
  result.wall_seconds = tree.at("wall_seconds");
  result.processor_seconds = tree.at("processor_seconds");
  result.configuration = std::move(tree.at("configuration"));
  return result;
} catch (const Json::exception&) {
  return without_result(0);
} catch (const MetricError&) {
  return without_result(0);
}

}  // namespace parallax
