// SPDX-License-Identifier: Apache-2.0
#include "platform/validation/validation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "platform/config/preset.hpp"
#include "platform/evaluation/evaluation_inputs.hpp"
#include "platform/evaluation/evaluation_pool.hpp"
#include "platform/input/image_padding.hpp"
#include "platform/machine/tile_plan.hpp"
#include "tlm/error.hpp"
#include "traces/number_text.hpp"

namespace parallax {
namespace {

ConfigurationRequest request_of(const PublishedRow& row) {
  ConfigurationRequest request;
  request.preset = row.preset;
  request.assignments = row.assignments;
  return request;
}

std::string size_of(const PublishedRow& row) { return fmt::format("{}x{}", row.width, row.height); }

// Of all rows with the same, one evaluation is enough.
std::string machine_of(const PublishedRow& row) {
  return fmt::format("{} {} {} {}", row.preset, size_of(row), row.rectified, fmt::join(row.assignments, " "));
}

// A row that is to be measured needs a machine that takes images of its size.
void check(const PublishedRow& row) {
  MachineConfig config;
  try {
    config = load_configuration(request_of(row), preset_folders()).machine;
    if (!row.refused && config.image.max_width == 0) {
      plan_tiles(config.tiles, config.matching.range(),
                 padded_size({row.width, row.height}, config.image.granularity()).width,
                 config.timing.pixels_per_token);
    }
  } catch (const UserError& error) {
    throw UserError(fmt::format("{}: {}: {}", row.origin, row.name, error.what()));
  }
  if (row.refused) return;
  const auto check_side = [&row](const char* key, std::uint32_t most, int wanted) {
    if (static_cast<std::uint32_t>(wanted) <= most) return;
    throw UserError(
        fmt::format("{}: {}: {} = {} is less than the row's {} px", row.origin, row.name, key, most, wanted));
  };
  if (config.image.max_width != 0) check_side("image.max_width", config.image.max_width, row.width);
  check_side("image.max_height", config.image.max_height, row.height);
}

// The built-in scene in the sizes of the rows.
class RowInputs {
 public:
  EvaluationCase prepare(const PublishedRow& row, const NoticeSink& notice) {
    Configuration configuration = load_configuration(request_of(row), preset_folders());
    MachineConfig any_size = configuration.machine;
    any_size.image.width = any_size.image.height = 0;  // the row says it
    const EvaluationInput input = inputs_of(row).prepare(any_size, notice);
    return {std::move(configuration), input};
  }

 private:
  struct Scene {
    RunOptions options;
    EvaluationInputs inputs{options};
  };
  EvaluationInputs& inputs_of(const PublishedRow& row) {
    std::unique_ptr<Scene>& scene = scenes_[{size_of(row), row.rectified}];
    if (scene == nullptr) {
      scene = std::make_unique<Scene>();
      scene->options.size = size_of(row);
      scene->options.rectified = row.rectified;
    }
    return scene->inputs;
  }
  std::map<std::pair<std::string, bool>, std::unique_ptr<Scene>> scenes_;
};

ValidatedRow compare(const PublishedRow& row, const EvaluationResult& result) {
  ValidatedRow validated;
  validated.row = row;
  if (row.refused) {
    validated.within = result.status == EvaluationResult::Status::kInvalid;
    validated.limit = validated.within ? "refused" : "not refused";
    return validated;
  }
  if (!result.done()) {
    validated.limit = fmt::format("{}: {}", name(result.status), result.advice());
    return validated;
  }
  validated.predicted = predicted(row, result.metrics);
  validated.deviation = row.deviation(validated.predicted);
  validated.within = row.allows(validated.deviation);
  validated.limit = result.limit.part;
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
  std::map<std::string, std::size_t> numbers;  // of the evaluations, by machine
  std::vector<Variant> variants;               // the first row of each
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!numbers.emplace(machine_of(rows[i]), variants.size()).second) continue;
    check(rows[i]);
    variants.push_back({{}, i});
  }
  RowInputs inputs;
  EvaluationPool pool([&](const Variant& variant, const NoticeSink& notice) {
    return inputs.prepare(rows[variant.base], notice);
  });
  std::vector<EvaluationResult> results;
  std::vector<ValidatedRow> validated;
  pool.evaluate(variants, interrupted, [&](std::size_t, EvaluationResult result) {
    results.push_back(std::move(result));
    while (validated.size() < rows.size()) {
      const PublishedRow& row = rows[validated.size()];
      const std::size_t number = numbers.at(machine_of(row));
      if (number >= results.size()) break;
      validated.push_back(compare(row, results[number]));
      done();
    }
  });
  return validated;
}

bool all_within(const std::vector<ValidatedRow>& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const ValidatedRow& row) { return row.within; });
}

std::string table(const std::vector<ValidatedRow>& rows) {
  std::size_t width = 3;
  for (const ValidatedRow& row : rows) width = std::max(width, row.row.name.size());
  std::string lines = fmt::format("{:<{}}  {:>14}  {:>14}  {:<9} {:>9}  {:>15}       limit\n", "row", width,
                                  "published", "predicted", "unit", "deviation", "tolerance");
  for (const ValidatedRow& validated : rows) {
    const PublishedRow& row = validated.row;
    const char* const verdict = validated.within ? "ok " : "OUT";
    if (row.refused || validated.predicted == 0) {
      lines += fmt::format("{:<{}}  {:>14}  {:>14}  {:<9} {:>9}  {:>15}  {}  {}\n", row.name, width,
                           row.refused ? "too large" : stated_text(row.published, row.unit), "-", row.unit,
                           "-", "-", verdict, validated.limit);
      continue;
    }
    lines += fmt::format("{:<{}}  {:>14}  {:>14}  {:<9} {:>7} %  {:>15}  {}  {}\n", row.name, width,
                         stated_text(row.published, row.unit), number_text(validated.predicted, row.unit),
                         row.unit, change_text(validated.deviation, "%"),
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
