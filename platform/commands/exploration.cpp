// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/exploration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "platform/commands/exploration_metrics.hpp"
#include "platform/commands/run_folder.hpp"
#include "platform/commands/timed_run.hpp"
#include "platform/explore/axis_effect_table.hpp"
#include "platform/explore/exploration_table.hpp"
#include "platform/explore/search_space.hpp"
#include "platform/results/glossary.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr std::size_t kLargestExploration = 1'000'000;
// So many inputs that cannot be opened are all.
constexpr std::size_t kInputsTried = 100;
constexpr const char* kDatabase = "results.db";
constexpr const char* kPoints = "points.csv";
constexpr const char* kFront = "front.csv";
constexpr const char* kSensitivity = "sensitivity.csv";

}  // namespace

Exploration::Exploration(const std::filesystem::path& spec, const std::filesystem::path& out,
                         PointShare share)
    : file_(spec),
      out_(out),
      share_(share),
      spec_(read_exploration_spec(spec, timed_run_options())),
      names_(spec_.varied_names()),
      metrics_(spec_.named_metrics()),
      inputs_(spec_) {
  if (metrics_.empty()) metrics_ = kept_metrics(spec_);
  check_metrics();
  if (share_.parts > 1 && spec_.sampling.method == SamplingMethod::kSearch)
    fail("a search cannot be shared: each of its points follows from those before");
  size_ = share_.size(count());
  check_inputs();
}

ExplorationReport Exploration::run(const ExplorationWatch& watch) {
  open({});
  EvaluationPool pool([this](const Variant& variant, const NoticeSink& notice) {
    return inputs_.prepare({0, variant.assignments}, notice);
  });
  return look(&pool, watch);
}

ExplorationReport Exploration::merge(const std::vector<std::filesystem::path>& folders) {
  std::vector<NamedInput> databases;
  for (const std::filesystem::path& folder : folders) {
    const std::filesystem::path database = folder / kDatabase;
    if (!std::filesystem::is_regular_file(database))
      throw UserError(
          fmt::format("{}: no {} in it: not the folder of an exploration", folder.string(), kDatabase));
    std::error_code ignored;
    if (std::filesystem::equivalent(folder, out_, ignored))
      throw UserError(
          fmt::format("{}: is the folder that is written; the others are merged into it", folder.string()));
    databases.push_back({database.string(), database});
  }
  open(databases);
  for (const NamedInput& database : databases) store_->take_from(database.path);
  return look(nullptr, {[] { return false; }, [](std::size_t) {}});
}

void Exploration::open(std::vector<NamedInput> further_inputs) {
  FolderPlan all = plan();
  for (NamedInput& input : further_inputs) all.inputs.push_back(std::move(input));
  folder_ = std::make_unique<OutputFolder>(out_, std::move(all));
  store_ = std::make_unique<ResultStore>(out_ / kDatabase);
  store_->begin(spec_.text, names_);
  for (const std::string& name : kept_metrics(spec_)) {
    const MetricInfo& info = require_metric(name, file_.string());
    store_->describe(name, info.unit, info.description);
  }
}

// Without a pool, at what is known.
ExplorationReport Exploration::look(EvaluationPool* pool, const ExplorationWatch& watch) {
  Explorer explorer(
      spec_, *store_, pool, [this](const ExplorationPoint& point) { return inputs_.identify(point); },
      share_);
  ExplorationReport report;
  report.counts = explorer.run(watch.interrupted, watch.advance);
  if (report.counts.whole && share_.parts == 1) store_->end();
  if (report.counts.whole) size_ = report.counts.points;
  report.outcome = judge(spec_, *store_);
  if (spec_.sampling.method == SamplingMethod::kOneAtATime)
    report.effects = axis_effects(spec_, *store_, kept_metrics(spec_));
  write_tables(*folder_, report);
  return report;
}

std::optional<double> Exploration::machines() const {
  if (spec_.sampling.method != SamplingMethod::kSearch) return std::nullopt;
  return SearchSpace(spec_.axes).machines();
}

// Points with all inputs that there can be. Where a search has too many machines to go through, its
// conditions and keys are left out, none of which bears on the input.
ExplorationSpec Exploration::inputs_only() const {
  ExplorationSpec spec = spec_;
  if (spec_.sampling.method != SamplingMethod::kSearch) return spec;
  spec.sampling = {};
  spec.conditions.clear();
  spec.links.clear();
  const SearchSpace space(spec_.axes);
  for (std::size_t i = 0; i < spec.axes.size(); ++i) {
    if (!spec.axes[i].option) {
      spec.axes[i].values = {space.values(Place(spec.axes.size(), 0))[i]};
      spec.axes[i].span.reset();
    }
  }
  return spec;
}

// What is wrong with the input of all points is one error, not a row for each.
void Exploration::check_inputs() {
  std::optional<UserError> first;
  std::set<std::vector<std::string>> seen;
  const ExplorationSpec spec = inputs_only();
  PointSource points(spec);
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

void Exploration::fail(const std::string& line) const {
  const std::string file = file_.string();
  throw UserError(line.rfind(file, 0) == 0 ? line : file + ": " + line);
}

// None of the inputs, at whichever point, may be replaced.
FolderPlan Exploration::plan() const {
  FolderPlan plan;
  plan.writes = [](const std::string& name) {
    return name == kPoints || name == kFront || name == kSensitivity;
  };
  plan.inputs.push_back({file_.string(), file_});
  std::set<std::vector<std::string>> seen;
  const ExplorationSpec spec = inputs_only();
  PointSource points(spec);
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

std::size_t Exploration::count() const {
  if (spec_.sampling.method == SamplingMethod::kSearch) return spec_.sampling.points;
  try {
    const std::size_t number = count_points(spec_, kLargestExploration);
    if (number == 0) throw UserError("no point fulfils the conditions");
    return number;
  } catch (const UserError& error) {
    fail(error.what());
  }
}

void Exploration::check_metrics() const {
  const auto require = [this](const std::string& name, const std::string& where) {
    if (std::find(names_.begin(), names_.end(), name) != names_.end()) return;
    require_number(name, spec_.device, where);
  };
  for (const Constraint& constraint : spec_.constraints) require(constraint.metric, constraint.origin);
  for (const Objective& objective : spec_.objectives) require(objective.metric, objective.origin);
  for (const std::string& name : spec_.metrics) require_metric(name, file_.string());
}

void Exploration::write_tables(OutputFolder& folder, const ExplorationReport& report) {
  const std::vector<std::string> metrics = kept_metrics(spec_);
  const ExplorationTable table(names_, metrics, *store_);
  for (const char* name : {kPoints, kFront}) {
    OutputFile& file = folder.open(name);
    table.csv(report.outcome, name == kFront, [&file](const std::string& line) { file.write(line); });
  }
  if (spec_.sampling.method == SamplingMethod::kOneAtATime) {
    OutputFile& file = folder.open(kSensitivity);
    effects_csv(report.effects, *store_, [&file](const std::string& line) { file.write(line); });
  }
  folder.publish();
}

}  // namespace parallax
