// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/explore.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>

#include "platform/commands/command_context.hpp"
#include "platform/commands/exit_codes.hpp"
#include "platform/commands/exploration.hpp"
#include "platform/commands/interruption.hpp"
#include "platform/commands/job_script.hpp"
#include "platform/commands/notes.hpp"
#include "platform/explore/axis_effect_table.hpp"
#include "platform/explore/exploration_table.hpp"
#include "platform/input/quoted_text.hpp"
#include "platform/results/output_folder.hpp"
#include "platform/results/progress.hpp"
#include "tlm/error.hpp"
#include "traces/json_text.hpp"
#include "traces/number_text.hpp"

namespace parallax {
namespace {

constexpr std::size_t kMostRows = 20;

// Says on the console what an exploration came to.
class ExplorationPrinter {
 public:
  ExplorationPrinter(Exploration& exploration, const ExplorationReport& report, bool json,
                     CommandContext& context)
      : exploration_(exploration), report_(report), json_(json), context_(context) {}

  void print() const {
    const ExplorationOutcome& outcome = report_.outcome;
    const ExplorationCounts& counts = report_.counts;
    const ExplorationTable table(exploration_.names(), exploration_.metrics(), exploration_.store());
    if (json_) {
      context_.out << json_text(tree(table), 2) << '\n';
      return;
    }
    if (context_.verbosity == Verbosity::kQuiet) return;
    context_.out << fmt::format("points              {} of {}: {}; {} evaluated now\n", counts.points,
                                exploration_.size(), statuses(outcome), counts.evaluated);
    if (const std::optional<double> machines = exploration_.machines())
      context_.out << fmt::format("chosen from         {} machines, conditions aside\n",
                                  grouped(fmt::format("{:.0f}", *machines)));
    if (outcome.fault)
      context_.out << fmt::format("not measured        {}; the first, point {}: {}\n",
                                  counts.points - outcome.done(), outcome.fault->number, outcome.fault->line);
    if (!exploration_.spec().constraints.empty())
      context_.out << fmt::format("satisfied           {}\n", outcome.satisfied.size());
    if (outcome.nearest) context_.out << "nearest             " << nearest_text(*outcome.nearest) << '\n';
    if (exploration_.spec().sampling.method == SamplingMethod::kOneAtATime) {
      context_.out << effects_text(shown(), exploration_.store(), kMostRows);
      return;
    }
    if (outcome.front.empty()) return;
    context_.out << (exploration_.spec().objectives.empty()
                         ? ""
                         : fmt::format("front               {}\n", outcome.front.size()))
                 << table.text(outcome.front, kMostRows);
  }

 private:
  // Those of the numbers that the table has.
  std::vector<AxisEffect> shown() const {
    std::vector<AxisEffect> all = report_.effects;
    const std::vector<std::string>& metrics = exploration_.metrics();
    const auto left_out = [&metrics](const AxisEffect& one) {
      return std::find(metrics.begin(), metrics.end(), one.metric) == metrics.end();
    };
    all.erase(std::remove_if(all.begin(), all.end(), left_out), all.end());
    return all;
  }

  static std::string statuses(const ExplorationOutcome& outcome) {
    std::string text;
    for (const auto& [status, number] : outcome.by_status)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", number, status);
    return text.empty() ? "none" : text;
  }

  std::string nearest_text(const NearestMiss& nearest) const {
    const Constraint& constraint = *nearest.constraint;
    const std::string unit = exploration_.store().unit(constraint.metric);
    const bool below = constraint.at_least && nearest.value < *constraint.at_least;
    return fmt::format(
        "point {}: {} is {}, {} {} asked for", nearest.number, constraint.metric,
        quantity_text(nearest.value, unit), below ? "at least" : "at most",
        with_unit(stated_text(below ? *constraint.at_least : *constraint.at_most, unit), unit));
  }

  nlohmann::ordered_json tree(const ExplorationTable& table) const {
    const ExplorationOutcome& outcome = report_.outcome;
    const ExplorationCounts& counts = report_.counts;
    nlohmann::ordered_json tree{
        {"points", exploration_.size()},         {"there", counts.points},
        {"evaluated", counts.evaluated},         {"statuses", outcome.by_status},
        {"satisfied", outcome.satisfied.size()}, {"front", table.json(outcome.front)}};
    if (const std::optional<double> machines = exploration_.machines()) tree["machines"] = *machines;
    if (exploration_.spec().sampling.method == SamplingMethod::kOneAtATime)
      tree["sensitivities"] = effects_json(shown(), exploration_.store());
    if (outcome.fault)
      tree["first_fault"] = {{"point", outcome.fault->number}, {"message", outcome.fault->line}};
    if (outcome.nearest) tree["nearest"] = table.json({outcome.nearest->number}).front();
    return tree;
  }

  Exploration& exploration_;
  const ExplorationReport& report_;
  const bool json_;
  CommandContext& context_;
};

// "2/4".
PointShare read_share(const std::string& text) {
  PointShare share;
  if (text.empty()) return share;
  char rest = 0;
  std::size_t number = 0;
  // Digits alone: the library would take a sign, and blanks before it.
  const bool digits = text.find_first_not_of("0123456789/") == std::string::npos;
  if (!digits || std::sscanf(text.c_str(), "%9zu/%9zu%c", &number, &share.parts, &rest) != 2 || number < 1 ||
      number > share.parts)
    throw UserError(fmt::format("--shard '{}': must be NUMBER/PARTS, as 1/4 to 4/4", excerpt(text)));
  share.index = number - 1;
  return share;
}

int write_job(const ExploreOptions& options, CommandContext& context) {
  if (!options.shard.empty())
    throw UserError("--emit and --shard exclude each other: each task has its shard");
  if (options.tasks == 0) throw UserError("--emit needs --tasks: how many tasks the job has");
  const Exploration exploration(options.spec, options.out);
  const JobScript script(options.emit, options.spec, options.out, options.tasks);
  if (options.tasks > exploration.size())
    throw UserError(fmt::format("--tasks {}: there are {} points; a task has one or more", options.tasks,
                                exploration.size()));
  if (exploration.machines())
    throw UserError("--emit: a search cannot be shared: each of its points follows from those before");
  FolderPlan plan;
  plan.writes = [&script](const std::string& name) { return name == script.name(); };
  plan.inputs.push_back({options.spec.string(), options.spec});
  OutputFolder folder(options.out, plan);
  folder.write(script.name(), script.text());
  folder.publish();
  if (options.json) {
    const nlohmann::ordered_json tree{{"job", (options.out / script.name()).string()},
                                      {"tasks", options.tasks},
                                      {"points", exploration.size()},
                                      {"submit", script.submit()},
                                      {"merge", script.merge()}};
    context.out << json_text(tree, 2) << '\n';
  } else if (context.verbosity != Verbosity::kQuiet) {
    context.out << fmt::format(
        "job                 {} tasks, {} points; a shard each\nsubmit              {}\nthen                "
        "{}\n",
        options.tasks, exploration.size(), script.submit(), script.merge());
  }
  return 0;
}

}  // namespace

int explore(const ExploreOptions& options, CommandContext& context) {
  if (!options.emit.empty()) return write_job(options, context);
  if (options.tasks != 0) throw UserError("--tasks says how many --emit writes a job for");
  const Interruption interruption;
  Exploration exploration(options.spec, options.out, read_share(options.shard));
  ExplorationReport report;
  {
    Notes notes(context);
    Progress progress(context.err, shows_progress(context), "points",
                      static_cast<std::int64_t>(exploration.size()), notes.sink());
    report = exploration.run({[&] { return interruption.requested(); },
                              [&](std::size_t more) { progress.advance(static_cast<std::int64_t>(more)); }});
  }
  ExplorationPrinter(exploration, report, options.json, context).print();
  if (!report.counts.whole)
    return interrupted_after(fmt::format("{} of {} points", report.counts.points, exploration.size()),
                             context, interruption);
  // Whether any point satisfies, all shards together show.
  return options.shard.empty() && report.outcome.satisfied.empty() ? kNotAsExpected : 0;
}

int merge(const MergeOptions& options, CommandContext& context) {
  Exploration exploration(options.spec, options.out);
  const ExplorationReport report = exploration.merge(options.folders);
  ExplorationPrinter(exploration, report, options.json, context).print();
  if (!report.counts.whole) {
    Notes notes(context);
    notes(fmt::format("{} of {} points are missing; parallax explore {} --out {} evaluates them",
                      exploration.size() - report.counts.points, exploration.size(),
                      shell_word(options.spec.string()), shell_word(options.out.string())));
    return kNotAsExpected;
  }
  return report.outcome.satisfied.empty() ? kNotAsExpected : 0;
}

}  // namespace parallax
