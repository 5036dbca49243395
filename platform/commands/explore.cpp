// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/explore.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "platform/commands/command_context.hpp"
#include "platform/commands/exit_codes.hpp"
#include "platform/commands/exploration.hpp"
#include "platform/commands/interruption.hpp"
#include "platform/commands/notes.hpp"
#include "platform/explore/exploration_table.hpp"
#include "platform/results/progress.hpp"
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
    if (outcome.front.empty()) return;
    context_.out << (exploration_.spec().objectives.empty()
                         ? ""
                         : fmt::format("front               {}\n", outcome.front.size()))
                 << table.text(outcome.front, kMostRows);
  }

 private:
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

}  // namespace

int explore(const ExploreOptions& options, CommandContext& context) {
  const Interruption interruption;
  Exploration exploration(options.spec, options.out);
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
  return report.outcome.satisfied.empty() ? kNotAsExpected : 0;
}

}  // namespace parallax
