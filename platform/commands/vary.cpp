// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/vary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "platform/commands/command_context.hpp"
#include "platform/commands/exit_codes.hpp"
#include "platform/commands/interruption.hpp"
#include "platform/commands/notes.hpp"
#include "platform/commands/run_folder.hpp"
#include "platform/commands/vary_axes.hpp"
#include "platform/commands/vary_inputs.hpp"
#include "platform/commands/vary_table.hpp"
#include "platform/config/preset_file.hpp"
#include "platform/evaluation/verdict.hpp"
#include "platform/results/output_folder.hpp"
#include "platform/results/progress.hpp"
#include "traces/json_text.hpp"

namespace parallax {
namespace {

// {"key": value}; what no key can hold stays text.
nlohmann::ordered_json as_json(const std::string& assignment) {
  const auto [key, raw] = read_assignment(assignment);
  const auto* value = std::get_if<ConfigValue>(&raw.value);
  if (value == nullptr) return {{key, assignment.substr(assignment.find('=') + 1)}};
  return {{key, std::visit([](const auto& held) { return nlohmann::ordered_json(held); }, *value)}};
}

class Sweep {
 public:
  Sweep(const RunOptions& options, CommandContext& context)
      : options_(options), context_(context), notes_(context), grid_(options), inputs_(options, grid_) {
    inputs_.open([this](const std::string& line) { notes_(line); });
  }

  int run() {
    const Interruption interruption;
    if (!options_.out.empty()) folder_ = std::make_unique<OutputFolder>(options_.out, plan());
    // At a terminal the growing table is progress enough.
    Progress progress(context_.err, options_.json && shows_progress(context_), "points", grid_.size(),
                      notes_.sink());
    if (prints_table()) context_.out << table_.header() << std::flush;
    EvaluationPool pool(
        [this](const Variant& variant, const NoticeSink& notice) { return prepare(variant, notice); });
    const auto interrupted = [&] { return interruption.requested(); };
    const std::size_t taken =
        options_.relax ? relax_each(pool, interrupted, progress) : evaluate_all(pool, interrupted, progress);
    if (options_.json)
      context_.out << json_text(all_, 2) << '\n';  // of a grid that was interrupted, what there is
    if (taken < grid_.size())
      return interrupted_after(fmt::format("{} of {} points", taken, grid_.size()), context_, interruption);
    return all_done_ ? 0 : kNotAsExpected;
  }

 private:
  using Question = std::function<bool()>;

  // None of the inputs, at whichever point, may be replaced.
  FolderPlan plan() const {
    ResultPlan results;
    results.sweep = true;
    results.relaxations = options_.relax;
    FolderPlan plan = folder_plan(options_, results);
    for (const std::size_t point : grid_.firsts_of_options()) {
      try {
        for (NamedInput& input : folder_plan(grid_.options(options_, point), results).inputs)
          plan.inputs.push_back(std::move(input));
      } catch (const UserError&) {  // its row says so
      }
    }
    return plan;
  }

  EvaluationCase prepare(const Variant& variant, const NoticeSink& notice) {
    EvaluationCase one = inputs_.prepare(variant.base, variant.assignments, notice);
    one.input.command = command(variant.base);
    return one;
  }

  // That runs the point alone.
  std::string command(std::size_t point) const {
    return context_.command_line.with({"--vary", "--out"}, grid_.words(point)).text();
  }

  std::size_t evaluate_all(EvaluationPool& pool, const Question& interrupted, Progress& progress) {
    std::vector<Variant> points;
    for (std::size_t i = 0; i < grid_.size(); ++i) points.push_back({{}, i});
    return pool.evaluate(points, interrupted, [&](std::size_t point, EvaluationResult result) {
      take(point, std::move(result), std::nullopt);
      progress.advance();
    });
  }

  // One point after the other, so that those that were begun are whole when it is interrupted.
  std::size_t relax_each(EvaluationPool& pool, const Question& interrupted, Progress& progress) {
    for (std::size_t point = 0; point < grid_.size(); ++point) {
      const auto evaluate = [&](const std::vector<Variant>& variants) {
        std::vector<EvaluationResult> results;
        pool.evaluate(variants, interrupted,
                      [&](std::size_t, EvaluationResult result) { results.push_back(std::move(result)); });
        return results;
      };
      std::vector<EvaluationResult> base = evaluate({{{}, point}});
      if (base.empty()) return point;
      std::optional<Verdict> verdict;
      if (base[0].done() && base[0].rate > 0) {
        verdict = find_verdict(inputs_.configuration(point, {}).machine, base[0], Thoroughness::kAll,
                               [&](const std::vector<Relaxation>& relaxations) {
                                 std::vector<Variant> variants;
                                 for (const Relaxation& relaxation : relaxations)
                                   variants.push_back({relaxation.assignments, point});
                                 return evaluate(variants);
                               });
        if (interrupted()) return point;
        add_verdict(base[0].metrics, *verdict);
      }
      take(point, std::move(base[0]), verdict);
      progress.advance();
    }
    return grid_.size();
  }

  void take(std::size_t point, EvaluationResult result, const std::optional<Verdict>& verdict) {
    for (const std::string& note : result.notes) notes_(note);
    all_done_ = all_done_ && result.done();
    if (prints_table())
      context_.out << table_.row(point, result, verdict ? &verdict->limits : nullptr) << std::flush;
    if (folder_ && result.done()) {
      const std::string name = fmt::format("point_{:04}/", point);
      folder_->write(name + "timing.json", json_text(timing_json(result), 2) + "\n");
      if (verdict) folder_->write(name + "relaxations.json", json_text(to_json(verdict->limits), 2) + "\n");
      folder_->publish();
    }
    if (options_.json) all_.push_back(entry(point, std::move(result), verdict));
  }

  bool prints_table() const { return !options_.json && context_.verbosity != Verbosity::kQuiet; }

  nlohmann::ordered_json entry(std::size_t point, EvaluationResult result,
                               const std::optional<Verdict>& verdict) const {
    nlohmann::ordered_json entry{{"point", point}, {"status", name(result.status)}};
    for (std::size_t i = 0; i < grid_.axes().size(); ++i) {
      const VaryAxis& axis = grid_.axes()[i];
      if (axis.option == nullptr) {
        entry["set"].update(as_json(axis.name + "=" + grid_.value(point, i)));
      } else {
        entry["options"][axis.name] = grid_.value(point, i);
      }
    }
    entry["command"] = command(point);
    if (result.done()) {
      entry["timing"] = timing_json(result);
      if (verdict) entry["relaxations"] = to_json(verdict->limits);
    } else {
      entry["message"] = std::move(result.message);
    }
    return entry;
  }

  const RunOptions& options_;
  CommandContext& context_;
  Notes notes_;
  const VaryGrid grid_;
  VaryInputs inputs_;
  const VaryTable table_{grid_, options_};
  std::unique_ptr<OutputFolder> folder_;
  nlohmann::ordered_json all_ = nlohmann::ordered_json::array();  // for --json
  bool all_done_ = true;
};

}  // namespace

int vary(const RunOptions& options, CommandContext& context) { return Sweep(options, context).run(); }

}  // namespace parallax
