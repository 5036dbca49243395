// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/vary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <ostream>
#include <utility>

#include "platform/commands/command_context.hpp"
#include "platform/commands/exit_codes.hpp"
#include "platform/commands/input_contents.hpp"
#include "platform/commands/interruption.hpp"
#include "platform/commands/notes.hpp"
#include "platform/commands/run_folder.hpp"
#include "platform/commands/sweep_folder.hpp"
#include "platform/commands/vary_axes.hpp"
#include "platform/commands/vary_inputs.hpp"
#include "platform/commands/vary_table.hpp"
#include "platform/config/configuration_hash.hpp"
#include "platform/config/preset_file.hpp"
#include "platform/evaluation/verdict.hpp"
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

// The same text as that of a whole array, without keeping it: a sweep may have many points.
class JsonArray {
 public:
  explicit JsonArray(std::ostream& out) : out_(out) {}

  void add(const nlohmann::ordered_json& entry) {
    std::string text = json_text(entry, kIndent);
    for (std::size_t line = 0; (line = text.find('\n', line)) != std::string::npos; ++line)
      text.insert(line + 1, kIndent, ' ');
    out_ << (any_ ? ",\n" : "[\n") << std::string(kIndent, ' ') << text;
    any_ = true;
  }
  void end() { out_ << (any_ ? "\n]\n" : "[]\n"); }

 private:
  static constexpr int kIndent = 2;
  std::ostream& out_;
  bool any_ = false;
};

class Sweep {
 public:
  Sweep(const RunOptions& options, CommandContext& context)
      : options_(options), context_(context), notes_(context), grid_(options), inputs_(options, grid_) {
    inputs_.open([this](const std::string& line) { notes_(line); });
  }

  int run() {
    const Interruption interruption;
    if (!options_.out.empty()) folder_ = std::make_unique<SweepFolder>(options_.out, plan(), text(), names());
    // At a terminal the growing table is progress enough.
    Progress progress(context_.err, options_.json && shows_progress(context_), "points", grid_.size(),
                      notes_.sink());
    if (prints_table()) context_.out << table_.header() << std::flush;
    EvaluationPool pool(
        [this](const Variant& variant, const NoticeSink& notice) { return prepare(variant, notice); });
    const auto interrupted = [&] { return interruption.requested(); };
    const std::size_t taken =
        options_.relax ? relax_each(pool, interrupted, progress) : evaluate_all(pool, interrupted, progress);
    if (options_.json) all_.end();  // of a grid that was interrupted, what there is
    if (taken == grid_.size() && folder_) folder_->end();
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
    plan.replaces = [](const std::string&) { return false; };
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

  // Known ones in between, so that the table is in the order of the points.
  std::size_t evaluate_all(EvaluationPool& pool, const Question& interrupted, Progress& progress) {
    std::vector<Variant> unknown;
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      if (!known(i)) unknown.push_back({{}, i});
    }
    std::size_t next = 0;
    const auto take_known_before = [&](std::size_t end) {
      for (; next < end; ++next) {
        show(next,
             folder_->result(next).value_or(
                 not_measured(EvaluationResult::Status::kFailed, "its file was changed")),
             std::nullopt);
        progress.advance();
      }
    };
    const std::size_t taken =
        pool.evaluate(unknown, interrupted, [&](std::size_t number, EvaluationResult result) {
          const std::size_t point = unknown[number].base;
          take_known_before(point);
          take(point, std::move(result), std::nullopt);
          ++next;
          progress.advance();
        });
    if (taken == unknown.size()) take_known_before(grid_.size());
    return next;
  }

  bool known(std::size_t point) {
    if (!folder_ || !folder_->begun()) return false;
    const std::optional<PointIdentity> what = identity(point);
    return what && folder_->knows(point, *what);
  }

  // None where the point is no possible machine, or has no possible options.
  std::optional<PointIdentity> identity(std::size_t point) {
    try {
      const RunOptions options = grid_.options(options_, point);
      PointIdentity what;
      what.configuration = configuration_hash(inputs_.configuration(point, {}).machine);
      what.input = text() + input_contents(options);
      for (const std::string& value : grid_.option_values(point)) what.input += " " + value;
      what.command = command(point);
      what.seed = options.scene.seed;
      return what;
    } catch (const UserError&) {
      return std::nullopt;
    }
  }

  // What is swept: the command line without what bears on its output alone.
  std::string text() const {
    return context_.command_line.with({"--out"}, {}).beginning({}, {"--json", "-q", "--quiet"}).text();
  }

  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const VaryAxis& axis : grid_.axes()) all.push_back(axis.name);
    return all;
  }

  std::vector<std::string> values(std::size_t point) const {
    std::vector<std::string> all;
    for (std::size_t i = 0; i < grid_.axes().size(); ++i) all.push_back(grid_.value(point, i));
    return all;
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
    if (folder_) {
      const PointIdentity what =
          identity(point).value_or(PointIdentity{"", command(point), command(point), 0});
      folder_->keep(point, values(point), what, result,
                    verdict ? json_text(to_json(verdict->limits), 2) + "\n" : "");
    }
    show(point, std::move(result), verdict);
  }

  void show(std::size_t point, EvaluationResult result, const std::optional<Verdict>& verdict) {
    all_done_ = all_done_ && result.done();
    if (prints_table())
      context_.out << table_.row(point, result, verdict ? &verdict->limits : nullptr) << std::flush;
    if (options_.json) all_.add(entry(point, std::move(result), verdict));
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
  std::unique_ptr<SweepFolder> folder_;
  JsonArray all_{context_.out};  // for --json
  bool all_done_ = true;
};

}  // namespace

int vary(const RunOptions& options, CommandContext& context) { return Sweep(options, context).run(); }

}  // namespace parallax
