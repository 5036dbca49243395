// SPDX-License-Identifier: Apache-2.0
#include "platform/validation/validation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "platform/config/preset.hpp"
#include "platform/evaluation/timing_evaluator.hpp"
#include "platform/input/image_padding.hpp"
#include "platform/input/rectification_choice.hpp"
#include "platform/input/run_input.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

EncodedMap map_for(const PublishedRow& row, const MachineConfig& config) {
  const Granularity granularity{static_cast<int>(config.image.width_granularity),
                                static_cast<int>(config.image.height_granularity)};
  const cv::Size padded = padded_size({row.width, row.height}, granularity);
  if (row.rectified) return encode(identity_map(padded.width, padded.height, config.rectification.range));
  RunOptions options;
  options.size = fmt::format("{}x{}", row.width, row.height);
  const NoticeSink silent = [](const std::string&) {};
  const std::unique_ptr<FrameSource> source = open_source(options, config, silent);
  return choose_rectification(options, config.rectification.range, *source, padded, silent).map;
}

TimingResult run(const PublishedRow& row, const ConfigurationRequest& request,
                 const std::function<bool()>& interrupted) {
  MachineConfig config;
  try {
    config = load_configuration(request, preset_folders()).machine;
  } catch (const UserError& error) {
    throw UserError(fmt::format("{}: {}: {}", row.origin, row.name, error.what()));
  }
  const auto beyond = [](const char* key, std::uint32_t most, int wanted) {
    if (static_cast<std::uint32_t>(wanted) <= most) return std::string();
    return fmt::format("{} = {} is less than the row's {} px", key, most, wanted);
  };
  for (const std::string& fault : {beyond("image.max_width", config.image.max_width, row.width),
                                   beyond("image.max_height", config.image.max_height, row.height)}) {
    if (fault.empty()) continue;
    if (row.refused) return {TimingResult::Status::kInvalid, nullptr, fault};
    throw UserError(fmt::format("{}: {}: {}", row.origin, row.name, fault));
  }
  const EncodedMap map = map_for(row, config);
  TimingInput input;
  input.width = row.width;
  input.height = row.height;
  input.map = &map;
  return TimingEvaluator(input, interrupted).evaluate(config);
}

ValidatedRow compare(const PublishedRow& row, const TimingResult& result) {
  using Status = TimingResult::Status;
  ValidatedRow validated;
  validated.row = row;
  if (row.refused) {
    validated.within = result.status == Status::kInvalid;
    validated.limit = validated.within ? "refused" : "not refused";
    return validated;
  }
  if (result.status != Status::kDone) {
    validated.limit = fmt::format("{}: {}", name(result.status), result.advice());
    return validated;
  }
  const MetricGroup metrics = metrics_of(result.metrics);
  validated.predicted = predicted(row, metrics);
  validated.deviation = 100 * (validated.predicted / row.published - 1);
  validated.within = validated.deviation >= row.least && validated.deviation <= row.most;
  validated.limit = metrics.word("limit/part");
  return validated;
}

}  // namespace

double predicted(const PublishedRow& row, const MetricGroup& metrics) {
  const auto check_unit = [&row](const std::string& unit) {
    if (row.unit == unit || (unit.empty() && row.unit == "-")) return;
    throw UserError(fmt::format("{}: {}: unit is '{}', but {} is in {}", row.origin, row.name, row.unit,
                                row.metric, unit.empty() ? "-" : unit));
  };
  if (row.metric == "frame_time") {
    check_unit("ms");
    return 1e3 / metrics.number("performance/frame_rate");
  }
  const Metric* const metric = metrics.find(row.metric);
  if (metric == nullptr || !metric->is_number()) {
    throw UserError(
        fmt::format("{}: {}: timing.json has no number '{}', such as performance/frame_rate; or frame_time",
                    row.origin, row.name, row.metric));
  }
  check_unit(metric->unit);
  return metric->number();
}

std::vector<ValidatedRow> validate_rows(const std::vector<PublishedRow>& rows,
                                        const std::function<void()>& done,
                                        const std::function<bool()>& interrupted) {
  std::map<std::string, TimingResult> results;  // by what is run
  std::vector<ValidatedRow> validated;
  for (const PublishedRow& row : rows) {
    ConfigurationRequest request;
    request.preset = row.preset;
    request.assignments = row.assignments;
    const std::string key = fmt::format("{} {}x{} {} {}", row.preset, row.width, row.height, row.rectified,
                                        fmt::join(row.assignments, " "));
    if (results.count(key) == 0) results.emplace(key, run(row, request, interrupted));
    if (interrupted()) return validated;
    validated.push_back(compare(row, results.at(key)));
    done();
  }
  return validated;
}

bool all_within(const std::vector<ValidatedRow>& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const ValidatedRow& row) { return row.within; });
}

std::string table(const std::vector<ValidatedRow>& rows) {
  std::size_t width = 3;
  for (const ValidatedRow& row : rows) width = std::max(width, row.row.name.size());
  std::string lines = fmt::format("{:<{}}  {:>10}  {:>10}  {:<9} {:>9}  {:>15}       limit\n", "row", width,
                                  "published", "predicted", "unit", "deviation", "tolerance");
  for (const ValidatedRow& validated : rows) {
    const PublishedRow& row = validated.row;
    const char* const verdict = validated.within ? "ok " : "OUT";
    if (row.refused || validated.predicted == 0) {
      lines += fmt::format("{:<{}}  {:>10}  {:>10}  {:<9} {:>9}  {:>15}  {}  {}\n", row.name, width,
                           row.refused ? "too large" : fmt::format("{:.6g}", row.published), "-", row.unit,
                           "-", "-", verdict, validated.limit);
      continue;
    }
    lines += fmt::format("{:<{}}  {:>10.6g}  {:>10.5g}  {:<9} {:>+7.2f} %  {:>15}  {}  {}\n", row.name, width,
                         row.published, validated.predicted, row.unit, validated.deviation,
                         fmt::format("{:+g} to {:+g} %", row.least, row.most), verdict, validated.limit);
  }
  return lines;
}

nlohmann::ordered_json to_json(const std::vector<ValidatedRow>& rows) {
  nlohmann::ordered_json tree;
  tree["within"] = all_within(rows);
  tree["rows"] = nlohmann::ordered_json::array();
  for (const ValidatedRow& validated : rows) {
    const PublishedRow& row = validated.row;
    nlohmann::ordered_json entry{{"name", row.name},           {"source", row.source},
                                 {"preset", row.preset},       {"set", row.assignments},
                                 {"width", row.width},         {"height", row.height},
                                 {"within", validated.within}, {"limit", validated.limit}};
    if (row.refused) {
      entry["refused"] = true;
    } else {
      entry["metric"] = row.metric;
      entry["unit"] = row.unit;
      entry["published"] = row.published;
      entry["predicted"] = validated.predicted;
      entry["deviation_percent"] = validated.deviation;
      entry["tolerance_percent"] = {row.least, row.most};
    }
    tree["rows"].push_back(entry);
  }
  return tree;
}

}  // namespace parallax
