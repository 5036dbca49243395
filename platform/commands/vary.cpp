// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/vary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "platform/commands/command_context.hpp"
#include "platform/commands/exit_codes.hpp"
#include "platform/commands/interruption.hpp"
#include "platform/commands/notes.hpp"
#include "platform/commands/run_folder.hpp"
#include "platform/config/nearest_name.hpp"
#include "platform/config/preset.hpp"
#include "platform/config/preset_file.hpp"
#include "platform/evaluation/evaluation_inputs.hpp"
#include "platform/evaluation/evaluation_pool.hpp"
#include "platform/results/output_folder.hpp"
#include "platform/results/progress.hpp"
#include "tlm/error.hpp"
#include "traces/json_text.hpp"

namespace parallax {
namespace {

constexpr std::size_t kMostPoints = 100'000;

/// A key and the values that it takes in turn, as they were written.
struct Axis {
  std::string key;
  std::vector<std::string> values;
};

/// One combination of values, an assignment "key=value" for each axis.
using Point = std::vector<std::string>;

// At the commas, but not within double quotes: a set of names has commas of its own.
std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts(1);
  bool quoted = false;
  for (const char c : text) {
    if (c == '"') quoted = !quoted;
    if (c == ',' && !quoted) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

std::vector<Axis> read_axes(const RunOptions& options, const Configuration& configuration) {
  std::vector<std::string> keys;
  for (const EffectiveKey& key : configuration.keys) keys.push_back(key.section + "." + key.name);
  std::vector<Axis> axes;
  std::size_t points = 1;
  for (const std::string& argument : options.vary) {
    const std::size_t equals = std::min(argument.find('='), argument.size());
    Axis axis{argument.substr(0, equals), split(argument.substr(std::min(equals + 1, argument.size())))};
    const bool blank =
        std::any_of(axis.values.begin(), axis.values.end(), [](const std::string& v) { return v.empty(); });
    if (axis.key.empty() || blank) {
      throw UserError(fmt::format("--vary {}: must have the form key=value,value,...", excerpt(argument)));
    }
    if (std::find(keys.begin(), keys.end(), axis.key) == keys.end()) {
      throw UserError(fmt::format("--vary {}: unknown key {}; the nearest is {}", excerpt(argument),
                                  excerpt(axis.key), nearest_name(axis.key, keys)));
    }
    if (std::any_of(axes.begin(), axes.end(), [&](const Axis& a) { return a.key == axis.key; })) {
      throw UserError(fmt::format("--vary {}: {} is varied twice", excerpt(argument), axis.key));
    }
    if (axis.key == "matching.iterations" && options.configuration.disparity_range) {
      throw UserError("--vary matching.iterations and --disparities exclude each other: both set the range");
    }
    points *= axis.values.size();
    if (points > kMostPoints) {
      throw UserError(fmt::format("--vary: more than {} combinations", kMostPoints));
    }
    axes.push_back(std::move(axis));
  }
  return axes;
}

// Every combination, the last axis changing fastest.
std::vector<Point> combinations(const std::vector<Axis>& axes) {
  std::vector<Point> points(1);
  for (const Axis& axis : axes) {
    std::vector<Point> longer;
    for (const Point& point : points) {
      for (const std::string& value : axis.values) {
        longer.push_back(point);
        longer.back().push_back(axis.key + "=" + value);
      }
    }
    points = std::move(longer);
  }
  return points;
}

std::string value_of(const std::string& assignment) { return assignment.substr(assignment.find('=') + 1); }

// {"key": value}; what no key can hold stays text.
nlohmann::ordered_json as_json(const std::string& assignment) {
  const auto [key, raw] = read_assignment(assignment);
  const auto* value = std::get_if<ConfigValue>(&raw.value);
  if (value == nullptr) return {{key, value_of(assignment)}};
  return {{key, std::visit([](const auto& held) { return nlohmann::ordered_json(held); }, *value)}};
}

class Grid {
 public:
  Grid(const RunOptions& options, CommandContext& context)
      : options_(options), context_(context), notes_(context), inputs_(options) {
    const Configuration configuration = load_configuration(options.configuration, preset_folders());
    axes_ = read_axes(options, configuration);
    for (Point& point : combinations(axes_)) points_.push_back({std::move(point)});
    // A wrong path is one error, not one a point.
    inputs_.open(configuration.machine, [this](const std::string& line) { notes_(line); });
  }

  int run() {
    const Interruption interruption;
    if (!options_.out.empty()) {
      ResultPlan plan;
      plan.sweep = true;
      folder_ = std::make_unique<OutputFolder>(options_.out, folder_plan(options_, plan));
    }
    // At a terminal the growing table is progress enough.
    Progress progress(context_.err, options_.json && shows_progress(context_), "points", points_.size(),
                      notes_.sink());
    if (prints_table()) context_.out << header() << std::flush;
    EvaluationPool pool(
        [this](const Variant& point, const NoticeSink& notice) { return prepare(point, notice); });
    const std::size_t taken = pool.evaluate(
        points_, [&] { return interruption.requested(); },
        [&](std::size_t index, EvaluationResult result) {
          take(index, std::move(result));
          progress.advance();
        });
    if (options_.json)
      context_.out << json_text(all_, 2) << '\n';  // of a grid that was interrupted, what there is
    if (taken < points_.size())
      return interrupted_after(fmt::format("{} of {} points", taken, points_.size()), context_, interruption);
    return all_done_ ? 0 : kNotAsExpected;
  }

 private:
  EvaluationCase prepare(const Variant& point, const NoticeSink& notice) {
    ConfigurationRequest request = options_.configuration;
    request.assignments.insert(request.assignments.end(), point.assignments.begin(), point.assignments.end());
    EvaluationCase one{load_configuration(request, preset_folders()), {}};
    one.input = inputs_.prepare(one.configuration.machine, notice);
    std::vector<std::string> alone;
    for (const std::string& assignment : point.assignments) alone.insert(alone.end(), {"--set", assignment});
    one.input.command = context_.command_line.with({"--vary", "--out"}, alone).text();
    return one;
  }

  void take(std::size_t index, EvaluationResult result) {
    for (const std::string& note : result.notes) notes_(note);
    all_done_ = all_done_ && result.done();
    if (prints_table()) context_.out << row(index, result) << std::flush;
    if (folder_ && result.done()) {
      folder_->write(fmt::format("point_{:04}/timing.json", index),
                     json_text(timing_json(result.metrics, result.configuration), 2) + "\n");
      folder_->publish();
    }
    if (options_.json) all_.push_back(entry(index, std::move(result)));
  }

  bool prints_table() const { return !options_.json && context_.verbosity != Verbosity::kQuiet; }

  static std::size_t width(const Axis& axis) {
    std::size_t most = axis.key.size();
    for (const std::string& text : axis.values) most = std::max(most, text.size());
    return most;
  }

  std::string header() const {
    std::string line = "point";
    for (const Axis& axis : axes_) line += fmt::format("  {:>{}}", axis.key, width(axis));
    if (range_varies()) line += "  disparities";
    return line + "   frame rate      latency  limit\n";
  }

  // Who varies the parallelism varies the range, unless it is given.
  bool range_varies() const {
    return !options_.configuration.disparity_range &&
           std::any_of(axes_.begin(), axes_.end(), [](const Axis& axis) {
             return axis.key == "matching.parallelism" || axis.key == "matching.iterations";
           });
  }

  std::string row(std::size_t index, const EvaluationResult& result) const {
    std::string line = fmt::format("{:>5}", index);
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      line += fmt::format("  {:>{}}", value_of(points_[index].assignments[i]), width(axes_[i]));
    }
    if (!result.done()) return line + fmt::format("  {}: {}\n", name(result.status), result.advice());
    if (range_varies()) line += fmt::format("  {:>11}", result.disparities);
    if (result.rate == 0) return line + "  one frame has no rate\n";
    return line + fmt::format("  {:>7.2f} fps  {:>8.3f} ms  {} at {:.1f} %\n", result.rate,
                              result.latency.exposure_to_host, result.limit.part, result.limit.utilisation);
  }

  nlohmann::ordered_json entry(std::size_t index, EvaluationResult result) const {
    nlohmann::ordered_json point{{"point", index}, {"status", name(result.status)}};
    for (const std::string& assignment : points_[index].assignments) point["set"].update(as_json(assignment));
    if (result.done()) {
      point["timing"] = timing_json(result.metrics, std::move(result.configuration));
    } else {
      point["message"] = std::move(result.message);
    }
    return point;
  }

  const RunOptions& options_;
  CommandContext& context_;
  Notes notes_;
  EvaluationInputs inputs_;
  std::vector<Axis> axes_;
  std::vector<Variant> points_;
  std::unique_ptr<OutputFolder> folder_;
  nlohmann::ordered_json all_ = nlohmann::ordered_json::array();  // for --json
  bool all_done_ = true;
};

}  // namespace

int vary(const RunOptions& options, CommandContext& context) { return Grid(options, context).run(); }

}  // namespace parallax
