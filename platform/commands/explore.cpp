// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/explore.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "platform/commands/command_context.hpp"
#include "platform/commands/exit_codes.hpp"
#include "platform/commands/exploration_inputs.hpp"
#include "platform/commands/interruption.hpp"
#include "platform/commands/notes.hpp"
#include "platform/commands/run_folder.hpp"
#include "platform/commands/timed_run.hpp"
#include "platform/config/nearest_key.hpp"
#include "platform/estimate/estimate_metrics.hpp"
#include "platform/explore/exploration_outcome.hpp"
#include "platform/explore/exploration_table.hpp"
#include "platform/explore/explorer.hpp"
#include "platform/results/glossary.hpp"
#include "platform/results/output_folder.hpp"
#include "platform/results/progress.hpp"
#include "tlm/error.hpp"
#include "traces/json_text.hpp"
#include "traces/number_text.hpp"

namespace parallax {
namespace {

constexpr std::size_t kLargestExploration = 1'000'000;
constexpr std::size_t kMostRows = 20;
// So many inputs that cannot be opened are all.
constexpr std::size_t kInputsTried = 100;
constexpr const char* kPoints = "points.csv";
constexpr const char* kFront = "front.csv";

// A number that no run has would be missing at every point.
const MetricInfo& require_metric(const std::string& name, const std::string& where) {
  if (name.rfind("quality/", 0) == 0)
    throw UserError(fmt::format("{}: {} needs images, and explorations compute none", where, excerpt(name)));
  if (const MetricInfo* metric = find_run_metric(name)) return *metric;
  if (const MetricInfo* metric = find_estimate_metric(name)) return *metric;
  throw UserError(fmt::format(
      "{}: {} is neither varied nor a number of a run; the nearest of these is {} (parallax glossary)", where,
      excerpt(name), nearest_key(name, run_metric_names())));
}

// Where the numbers of a device are.
std::string device_path(const std::string& device) { return "devices/" + device_group(device) + "/"; }

class Exploration {
 public:
  Exploration(const ExploreOptions& options, CommandContext& context)
      : options_(options),
        context_(context),
        spec_(read_exploration_spec(options.spec, timed_run_options())),
        names_(spec_.varied_names()),
        metrics_(spec_.named_metrics()),
        inputs_(spec_) {
    if (metrics_.empty()) metrics_ = kept_metrics(spec_);
    check_metrics();
  }

  int run() {
    const Interruption interruption;
    const std::size_t total = count();
    check_inputs();
    OutputFolder folder(options_.out, plan());
    ResultStore store(options_.out / "results.db");
    store.begin(spec_.text, names_);
    for (const std::string& name : kept_metrics(spec_)) {
      const MetricInfo& info = require_metric(name, options_.spec.string());
      store.describe(name, info.unit, info.description);
    }
    EvaluationPool pool([this](const Variant& variant, const NoticeSink& notice) {
      return inputs_.prepare({0, variant.assignments}, notice);
    });
    Explorer explorer(spec_, store, pool,
                      [this](const ExplorationPoint& point) { return inputs_.identify(point); });
    ExplorationCounts counts;
    {
      Notes notes(context_);
      Progress progress(context_.err, shows_progress(context_), "points", static_cast<std::int64_t>(total),
                        notes.sink());
      counts = explorer.run([&] { return interruption.requested(); },
                            [&](std::size_t more) { progress.advance(static_cast<std::int64_t>(more)); });
    }
    const bool whole = counts.points == total;
    if (whole) store.end();
    const ExplorationOutcome outcome = judge(spec_, store);
    write_tables(folder, store, outcome);
    say(store, outcome, counts, total);
    if (!whole)
      return interrupted_after(fmt::format("{} of {} points", counts.points, total), context_, interruption);
    return outcome.satisfied.empty() ? kNotAsExpected : 0;
  }

 private:
  // What is wrong with the input of all points is one error, not a row for each.
  void check_inputs() {
    std::optional<UserError> first;
    std::set<std::vector<std::string>> seen;
    PointSource points(spec_);
    while (const std::optional<ExplorationPoint> point = points.next()) {
      if (!seen.insert(command_words(inputs_.words(*point))).second) continue;
      try {
        inputs_.check_input(*point);
        return;
      } catch (const UserError& error) {
        if (!first) first = error;
      }
      if (seen.size() == kInputsTried) break;
    }
    fail(first->what());
  }

  [[noreturn]] void fail(const std::string& line) const {
    const std::string file = options_.spec.string();
    throw UserError(line.rfind(file, 0) == 0 ? line : file + ": " + line);
  }

  // None of the inputs, at whichever point, may be replaced.
  FolderPlan plan() const {
    FolderPlan plan;
    plan.writes = [](const std::string& name) { return name == kPoints || name == kFront; };
    plan.inputs.push_back({options_.spec.string(), options_.spec});
    std::set<std::vector<std::string>> seen;
    PointSource points(spec_);
    while (const std::optional<ExplorationPoint> point = points.next()) {
      const std::vector<RunWord> words = inputs_.words(*point);
      if (!seen.insert(command_words(words)).second) continue;
      try {
        for (NamedInput& input : folder_plan(timed_run(words), ResultPlan{}).inputs)
          plan.inputs.push_back(std::move(input));
      } catch (const UserError&) {  // its row says so
      }
    }
    return plan;
  }

  std::size_t count() const {
    try {
      const std::size_t number = count_points(spec_, kLargestExploration);
      if (number == 0) throw UserError("no point fulfils the conditions");
      return number;
    } catch (const UserError& error) {
      fail(error.what());
    }
  }

  void check_metrics() const {
    const auto require = [this](const std::string& name, const std::string& where) {
      if (std::find(names_.begin(), names_.end(), name) != names_.end()) return;
      const MetricInfo& metric = require_metric(name, where);
      const bool of_device = metric.path.rfind("devices/", 0) == 0;
      if (of_device && name.rfind(device_path(spec_.device), 0) != 0)
        throw UserError(fmt::format("{}: {} is not of the device that the file names: device = \"{}\"", where,
                                    excerpt(name), spec_.device));
      if (metric.unit.empty() && !of_device)
        throw UserError(fmt::format("{}: {} is a word, and has no least or most", where, excerpt(name)));
    };
    for (const Constraint& constraint : spec_.constraints) require(constraint.metric, constraint.origin);
    for (const Objective& objective : spec_.objectives) require(objective.metric, objective.origin);
    for (const std::string& name : spec_.metrics) require_metric(name, options_.spec.string());
  }

  void write_tables(OutputFolder& folder, ResultStore& store, const ExplorationOutcome& outcome) const {
    const std::vector<std::string> metrics = kept_metrics(spec_);
    const ExplorationTable table(names_, metrics, store);
    for (const char* name : {kPoints, kFront}) {
      OutputFile& file = folder.open(name);
      table.csv(outcome, name == kFront, [&file](const std::string& line) { file.write(line); });
    }
    folder.publish();
  }

  void say(ResultStore& store, const ExplorationOutcome& outcome, const ExplorationCounts& counts,
           std::size_t total) const {
    const ExplorationTable table(names_, metrics_, store);
    if (options_.json) {
      context_.out << json_text(tree(table, outcome, counts, total), 2) << '\n';
      return;
    }
    if (context_.verbosity == Verbosity::kQuiet) return;
    context_.out << fmt::format("points              {} of {}: {}; {} evaluated now\n", counts.points, total,
                                statuses(outcome), counts.evaluated);
    if (outcome.fault)
      context_.out << fmt::format("not measured        {}; the first, point {}: {}\n",
                                  counts.points - outcome.done(), outcome.fault->number, outcome.fault->line);
    if (!spec_.constraints.empty())
      context_.out << fmt::format("satisfied           {}\n", outcome.satisfied.size());
    if (outcome.nearest)
      context_.out << "nearest             " << nearest_text(store, *outcome.nearest) << '\n';
    if (outcome.front.empty()) return;
    context_.out << (spec_.objectives.empty() ? ""
                                              : fmt::format("front               {}\n", outcome.front.size()))
                 << table.text(outcome.front, kMostRows);
  }

  static std::string statuses(const ExplorationOutcome& outcome) {
    std::string text;
    for (const auto& [status, number] : outcome.by_status)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", number, status);
    return text.empty() ? "none" : text;
  }

  std::string nearest_text(ResultStore& store, const NearestMiss& nearest) const {
    const Constraint& constraint = *nearest.constraint;
    const std::string unit = store.unit(constraint.metric);
    const bool below = constraint.at_least && nearest.value < *constraint.at_least;
    return fmt::format(
        "point {}: {} is {}, {} {} asked for", nearest.number, constraint.metric,
        quantity_text(nearest.value, unit), below ? "at least" : "at most",
        with_unit(stated_text(below ? *constraint.at_least : *constraint.at_most, unit), unit));
  }

  nlohmann::ordered_json tree(const ExplorationTable& table, const ExplorationOutcome& outcome,
                              const ExplorationCounts& counts, std::size_t total) const {
    nlohmann::ordered_json tree{{"points", total},
                                {"there", counts.points},
                                {"evaluated", counts.evaluated},
                                {"statuses", outcome.by_status},
                                {"satisfied", outcome.satisfied.size()},
                                {"front", table.json(outcome.front)}};
    if (outcome.fault)
      tree["first_fault"] = {{"point", outcome.fault->number}, {"message", outcome.fault->line}};
    if (outcome.nearest) tree["nearest"] = table.json({outcome.nearest->number}).front();
    return tree;
  }

  const ExploreOptions& options_;
  CommandContext& context_;
  const ExplorationSpec spec_;
  const std::vector<std::string> names_;
  std::vector<std::string> metrics_;  // that are shown
  ExplorationInputs inputs_;
};

}  // namespace

int explore(const ExploreOptions& options, CommandContext& context) {
  return Exploration(options, context).run();
}

}  // namespace parallax
