// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/evaluation_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <protozero/exception.hpp>
#include <protozero/pbf_message.hpp>
#include <protozero/pbf_writer.hpp>
#include <sstream>
#include <utility>

#include "traces/metric_bytes.hpp"

namespace parallax {
namespace {

using Json = nlohmann::ordered_json;
using Status = EvaluationResult::Status;

constexpr std::array<Status, 6> kStatuses{Status::kDone,   Status::kInvalid,     Status::kStuck,
                                          Status::kFailed, Status::kInterrupted, Status::kTooSlow};

enum class ResultField : protozero::pbf_tag_type {
  kStatus = 1,
  kMessage = 2,
  kNote = 3,
  kWallSeconds = 4,
  kProcessorSeconds = 5,
  kConfiguration = 6,
  kMetrics = 7,  // the last: bytes that are cut lack it
};

constexpr protozero::pbf_tag_type tag(ResultField field) {
  return static_cast<protozero::pbf_tag_type>(field);
}

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

std::optional<Status> status_named(const std::string& word) {
  const Status* const status =
      std::find_if(kStatuses.begin(), kStatuses.end(), [&word](Status s) { return word == name(s); });
  return status == kStatuses.end() ? std::nullopt : std::optional(*status);
}

Json timing_json(const MetricGroup& metrics, Json configuration) {
  Json tree = to_json(metrics);
  tree["configuration"] = std::move(configuration);
  return tree;
}

Json timing_json(const EvaluationResult& result) {
  return timing_json(result.metrics, Json::parse(result.configuration));
}

std::string to_bytes(const EvaluationResult& result) {
  std::string bytes;
  protozero::pbf_writer out(bytes);
  out.add_string(tag(ResultField::kStatus), name(result.status));
  out.add_string(tag(ResultField::kMessage), result.message);
  for (const std::string& note : result.notes) out.add_string(tag(ResultField::kNote), note);
  out.add_double(tag(ResultField::kWallSeconds), result.wall_seconds);
  out.add_double(tag(ResultField::kProcessorSeconds), result.processor_seconds);
  out.add_string(tag(ResultField::kConfiguration), result.configuration);
  out.add_bytes(tag(ResultField::kMetrics), to_bytes(result.metrics));
  return bytes;
}

EvaluationResult evaluation_result(const std::string& bytes) try {
  EvaluationResult read;
  std::optional<Status> status;
  MetricGroup metrics;
  bool whole = false;
  protozero::pbf_message<ResultField> in(bytes);
  while (in.next()) {
    switch (in.tag()) {
      case ResultField::kStatus:
        status = status_named(in.get_string());
        break;
      case ResultField::kMessage:
        read.message = in.get_string();
        break;
      case ResultField::kNote:
        read.notes.push_back(in.get_string());
        break;
      case ResultField::kWallSeconds:
        read.wall_seconds = in.get_double();
        break;
      case ResultField::kProcessorSeconds:
        read.processor_seconds = in.get_double();
        break;
      case ResultField::kConfiguration:
        read.configuration = in.get_string();
        break;
      case ResultField::kMetrics: {
        const protozero::data_view view = in.get_view();
        metrics = metrics_from_bytes({view.data(), view.size()});
        whole = true;
        break;
      }
      default:
        return without_result(0);
    }
  }
  if (!status || !whole) return without_result(0);
  EvaluationResult result = *status == Status::kDone ? measured(std::move(metrics))
                                                     : not_measured(*status, std::move(read.message));
  result.notes = std::move(read.notes);
  result.wall_seconds = read.wall_seconds;
  result.processor_seconds = read.processor_seconds;
  result.configuration = std::move(read.configuration);
  return result;
} catch (const protozero::exception&) {
  return without_result(0);
} catch (const MetricError&) {
  return without_result(0);
}

}  // namespace parallax
