// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/vary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

#include "platform/commands/command_context.hpp"
#include "platform/commands/interruption.hpp"
#include "platform/commands/timing_inputs.hpp"
#include "platform/config/config_writer.hpp"
#include "platform/config/nearest_name.hpp"
#include "platform/config/preset.hpp"
#include "platform/config/preset_file.hpp"
#include "platform/evaluation/timing_evaluator.hpp"
#include "platform/results/output_folder.hpp"
#include "platform/results/progress.hpp"
#include "platform/results/result_names.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

using Status = TimingResult::Status;

constexpr std::size_t kMostPoints = 100'000;
constexpr int kSomePointFailed = 1;
constexpr int kSignalled = 128;  // as shells report a program that a signal ended

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
      throw UserError(fmt::format("--vary {}: must have the form key=value,value,...", argument));
    }
    if (std::find(keys.begin(), keys.end(), axis.key) == keys.end()) {
      throw UserError(fmt::format("--vary {}: unknown key {}; the nearest is {}", argument, axis.key,
                                  nearest_name(axis.key, keys)));
    }
    if (std::any_of(axes.begin(), axes.end(), [&](const Axis& a) { return a.key == axis.key; })) {
      throw UserError(fmt::format("--vary {}: {} is varied twice", argument, axis.key));
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
      : options_(options),
        context_(context),
        input_(options, [this](const std::string& line) { note(line); }) {
    const Configuration configuration = load_configuration(options.configuration, preset_folders());
    axes_ = read_axes(options, configuration);
    points_ = combinations(axes_);
    input_.open(configuration.machine);  // a wrong path is one error, not one a point
  }

  int run() {
    const Interruption interruption;
    if (!options_.out.empty()) {
      folder_ = std::make_unique<OutputFolder>(options_.out);
      folder_->replace(is_result_name);
    }
    const bool quiet = context_.verbosity == Verbosity::kQuiet;
    // At a terminal the growing table is progress enough.
    Progress progress(context_.err, options_.json && !quiet && standard_error_is_terminal(), "points",
                      static_cast<std::int64_t>(points_.size()));
    auto all = nlohmann::ordered_json::array();
    int code = 0;
    if (!options_.json && !quiet) context_.out << header();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      TimingResult result = measure(points_[i], interruption);
      if (result.status == Status::kInterrupted) {
        context_.err << fmt::format("parallax: interrupted after {} of {} points\n", i, points_.size());
        return kSignalled + interruption.signal();
      }
      if (result.status != Status::kDone) code = kSomePointFailed;
      if (!options_.json && !quiet) context_.out << row(i, result) << std::flush;
      if (folder_ && result.status == Status::kDone) {
        folder_->write(fmt::format("point_{:04}/timing.json", i), result.metrics.dump(2) + "\n");
        folder_->publish();
      }
      if (options_.json) all.push_back(entry(i, std::move(result)));
      progress.advance();
    }
    if (options_.json) context_.out << all.dump(2) << '\n';
    return code;
  }

 private:
  void note(const std::string& line) {
    if (context_.verbosity != Verbosity::kQuiet && said_.insert(line).second) {
      context_.err << "parallax: note: " << line << '\n';
    }
  }

  TimingResult measure(const Point& point, const Interruption& interruption) {
    if (interruption.requested()) return {Status::kInterrupted, nullptr, "interrupted"};
    try {
      ConfigurationRequest request = options_.configuration;
      request.assignments.insert(request.assignments.end(), point.begin(), point.end());
      const Configuration configuration = load_configuration(request, preset_folders());
      TimingInput input = input_.prepare(configuration.machine);
      std::vector<std::string> alone;
      for (const std::string& assignment : point) alone.insert(alone.end(), {"--set", assignment});
      input.command = context_.command_line.with({"--vary", "--out"}, alone).text();
      TimingResult result = TimingEvaluator(std::move(input), [&] {
                              return interruption.requested();
                            }).evaluate(configuration.machine);
      if (result.status == Status::kDone) result.metrics["configuration"] = to_json(configuration, false);
      return result;
    } catch (const UserError& error) {
      return {Status::kInvalid, nullptr, error.what()};
    }
  }

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

  std::string row(std::size_t index, const TimingResult& result) const {
    std::string line = fmt::format("{:>5}", index);
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      line += fmt::format("  {:>{}}", value_of(points_[index][i]), width(axes_[i]));
    }
    if (result.status != Status::kDone) {
      return line + fmt::format("  {}: {}\n", name(result.status), result.advice());
    }
    const auto metric = [&](const char* group, const char* metric_name) {
      return result.metrics.at(group).at(metric_name).at("value");
    };
    if (range_varies())
      line += fmt::format("  {:>11}", metric("input", "disparity_range").get<std::int64_t>());
    if (metric("performance", "frame_rate") == 0) return line + "  one frame has no rate\n";
    line += fmt::format("  {:>7.2f} fps  {:>8.3f} ms", metric("performance", "frame_rate").get<double>(),
                        metric("latency", "exposure_to_host_mean").get<double>());
    return line + fmt::format("  {} at {:.1f} %\n", metric("limit", "part").get<std::string>(),
                              metric("limit", "utilisation").get<double>());
  }

  nlohmann::ordered_json entry(std::size_t index, TimingResult result) const {
    nlohmann::ordered_json point{{"point", index}, {"status", name(result.status)}};
    for (const std::string& assignment : points_[index]) point["set"].update(as_json(assignment));
    if (result.status == Status::kDone) {
      point["timing"] = std::move(result.metrics);
    } else {
      point["message"] = std::move(result.message);
    }
    return point;
  }

  const RunOptions& options_;
  CommandContext& context_;
  std::vector<Axis> axes_;
  std::vector<Point> points_;
  TimingInputs input_;
  std::unique_ptr<OutputFolder> folder_;
  std::set<std::string> said_;  // notes, once each
};

}  // namespace

int vary(const RunOptions& options, CommandContext& context) { return Grid(options, context).run(); }

}  // namespace parallax
