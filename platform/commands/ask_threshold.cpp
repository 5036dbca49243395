// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/ask_threshold.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "platform/commands/case_estimate.hpp"
#include "platform/commands/command_context.hpp"
#include "platform/commands/exit_codes.hpp"
#include "platform/commands/interruption.hpp"
#include "platform/commands/notes.hpp"
#include "platform/commands/question.hpp"
#include "platform/config/nearest_key.hpp"
#include "platform/config/preset.hpp"
#include "platform/evaluation/evaluation_inputs.hpp"
#include "platform/evaluation/evaluation_pool.hpp"
#include "platform/explore/bounds_search.hpp"
#include "platform/explore/candidates.hpp"
#include "platform/explore/judgement.hpp"
#include "platform/input/run_input.hpp"
#include "platform/results/progress.hpp"
#include "tlm/error.hpp"
#include "traces/json_text.hpp"

namespace parallax {
namespace {

// Where no bounds are given: so many times less and more than the value that the machine has.
constexpr double kReach = 8;

class ThresholdQuestion {
 public:
  ThresholdQuestion(const AskOptions& options, CommandContext& context)
      : options_(options),
        context_(context),
        key_(options.subjects.front()),
        most_(options.which == "most"),
        holds_(read_holds(options)),
        names_(names_of(holds_)),
        estimate_(options.device, names_),
        inputs_(options.run),
        pool_([this](const Variant& variant, const NoticeSink& notice) { return prepare(variant, notice); }) {
    check_question();
    check_options(options_.run);
    find_values();
  }

  int run() {
    const Interruption interruption;
    const Threshold threshold = search(interruption);
    if (!threshold.complete)
      return interrupted_after(fmt::format("{} runs", runs_.size()), context_, interruption);
    if (options_.run.json) {
      context_.out << json_text(tree(threshold.at), 2) << '\n';
    } else if (context_.verbosity != Verbosity::kQuiet) {
      context_.out << text(threshold.at);
    }
    return threshold.at ? 0 : kNotAsExpected;
  }

 private:
  EvaluationCase prepare(const Variant& variant, const NoticeSink& notice) {
    EvaluationCase one{configuration(variant.assignments.front()), {}};
    one.input = inputs_.prepare(one.configuration.machine, notice);
    one.input.command = command(variant.assignments.front());
    estimate_.add_to(one);
    return one;
  }

  Configuration configuration(const std::string& assignment) const {
    ConfigurationRequest request = options_.run.configuration;
    request.changes = {assignment};
    return load_configuration(request, preset_folders());
  }

  std::string assignment(std::size_t index) const { return key_ + "=" + values_[index]; }

  std::string command(const std::string& assignment) const {
    return run_command(context_.command_line, options_, {"--set", assignment});
  }

  void check_question() const {
    if (key_.find('/') != std::string::npos)
      throw UserError(
          fmt::format("{} is no key; if it is a number, --vary has to say of which machines", excerpt(key_)));
    if (holds_.empty())
      throw UserError(
          fmt::format("ask {} {}: --hold has to say what must hold, as performance/frame_rate>=60",
                      options_.which, excerpt(key_)));
    for (const auto& [option, value] : {std::pair("--from", options_.from), {"--to", options_.to}}) {
      if (value && !std::isfinite(*value)) throw UserError(fmt::format("{} must be a number", option));
    }
  }

  // Those that are no possible machine are left out, where looking at all of them takes no time.
  void find_values() {
    constexpr std::size_t kLookedAt = 400;
    const Configuration now = load_configuration(options_.run.configuration, preset_folders());
    MachineConfig machine = now.machine;
    Schema schema;
    describe(schema, machine);
    const Key* const key = schema.find(key_);
    if (key == nullptr) {
      std::vector<std::string> names;
      for (const Key& known : schema.keys()) names.push_back(known.path);
      throw UserError(
          fmt::format("unknown key {}; the nearest is {}", excerpt(key_), nearest_key(key_, names)));
    }
    const bool whole = key->type == KeyType::kInteger;
    if (!whole && key->type != KeyType::kReal)
      throw UserError(fmt::format("{} is no number: it is {}", key_, key->expected()));
    const auto [least, most] = reach(*key, whole);
    values_ = candidates(least, most, whole);
    if (values_.size() <= kLookedAt) {
      const auto impossible = [this](const std::string& value) {
        try {
          configuration(key_ + "=" + value);
          return false;
        } catch (const UserError&) {
          return true;
        }
      };
      values_.erase(std::remove_if(values_.begin(), values_.end(), impossible), values_.end());
    }
    if (values_.empty())
      throw UserError(fmt::format("{}: no value from {} to {} makes a possible machine", key_, least, most));
    start_ = nearest_to(now_value(*key));
    if (most_) {
      std::reverse(values_.begin(), values_.end());
      start_ = values_.size() - 1 - start_;
    }
  }

  static double now_value(const Key& key) {
    const ConfigValue held = key.get();
    const auto* const whole = std::get_if<std::int64_t>(&held);
    return whole != nullptr ? static_cast<double>(*whole) : std::get<double>(held);
  }

  std::size_t nearest_to(double number) const {
    const auto above = std::find_if(values_.begin(), values_.end(), [number](const std::string& value) {
      return std::stod(value) >= number;
    });
    return std::min(static_cast<std::size_t>(above - values_.begin()), values_.size() - 1);
  }

  std::pair<double, double> reach(const Key& key, bool whole) const {
    const double now = now_value(key);
    if (options_.from && *options_.from <= 0) throw UserError("--from must be above 0");
    if (now <= 0 && !(options_.from && options_.to))
      throw UserError(fmt::format("{} is {}: --from and --to have to say where to look", key_, now));
    const double lowest = whole ? static_cast<double>(key.integers.least) : key.reals.least;
    const double highest = whole ? static_cast<double>(key.integers.most) : key.reals.most;
    const double least = std::max(options_.from.value_or(now / kReach), lowest);
    const double most = std::min(options_.to.value_or(now * kReach), highest);
    if (least > most)
      throw UserError(
          fmt::format("{}: nothing between {} and {}; it takes {}", key_, least, most, key.expected()));
    return {least, most};
  }

  Threshold search(const Interruption& interruption) {
    Notes notes(context_);
    // So many steps at most, as each leaves a part of the gap.
    Progress progress(context_.err, shows_progress(context_), "runs", 0, notes.sink());
    return find_bounds(values_.size(), start_, EvaluationPool::usual_processes(),
                       [&](const std::vector<std::size_t>& indices) {
                         std::vector<Variant> variants;
                         for (const std::size_t index : indices) variants.push_back({{assignment(index)}});
                         std::vector<FailedBounds> answers;
                         pool_.evaluate(
                             variants, [&] { return interruption.requested(); },
                             [&](std::size_t number, EvaluationResult result) {
                               for (const std::string& note : result.notes) notes(note);
                               answers.push_back(failed(result));
                               runs_.insert_or_assign(indices[number], std::move(result));
                               progress.advance();
                             });
                         return answers;
                       });
  }

  // What does not run fails a bound of its own: of the others nothing is known.
  FailedBounds failed(const EvaluationResult& result) const {
    if (!result.done()) return {holds_.size()};
    FailedBounds bounds;
    for (std::size_t i = 0; i < holds_.size(); ++i) {
      if (miss(holds_[i], number_of(result, holds_[i].metric)) > 0) bounds.push_back(i);
    }
    return bounds;
  }

  std::string said(std::size_t index) const { return said_of(runs_.at(index), names_); }

  std::string answer_text(std::optional<std::size_t> at) const {
    if (!at) {
      return fmt::format("none from {} to {} has {}; with {}: {}", values_.front(), values_.back(),
                         bounds_text(holds_), values_.back(), said(values_.size() - 1));
    }
    const std::string found = fmt::format("{} = {} has {}{}", key_, values_[*at],
                                          names_.size() > 1 ? "" : names_.front() + " ", said(*at));
    if (*at == 0)
      return found + fmt::format("; it is the {} that was looked at", most_ ? "largest" : "least");
    return found + fmt::format("; with {}: {}", values_[*at - 1], said(*at - 1));
  }

  std::string text(std::optional<std::size_t> at) const {
    std::vector<std::vector<std::string>> rows{{key_}};
    rows.front().insert(rows.front().end(), names_.begin(), names_.end());
    rows.front().emplace_back("what limits");
    for (const auto& [index, result] : runs_) {
      std::vector<std::string> cells = cells_of(result, names_);
      cells.insert(cells.begin(), values_[index]);
      rows.push_back(std::move(cells));
    }
    return fmt::format("answer              {}\nruns                {}\n{}", answer_text(at), runs_.size(),
                       table_text(rows));
  }

  nlohmann::ordered_json tree(std::optional<std::size_t> at) const {
    using Json = nlohmann::ordered_json;
    Json runs = Json::array();
    for (const auto& [index, result] : runs_) {
      Json run{{"value", values_[index]}, {"status", name(result.status)}, {"holds", holds(holds_, result)}};
      add_numbers(run, result, names_);
      if (result.done()) run["limit"] = result.limit.part;
      if (!result.done()) run["message"] = result.message;
      run["command"] = command(assignment(index));
      runs.push_back(std::move(run));
    }
    return {{"key", key_},
            {"answer", at ? Json(values_[*at]) : Json()},
            {"sentence", answer_text(at)},
            {"units", units_of(names_)},
            {"runs", runs}};
  }

  const AskOptions& options_;
  CommandContext& context_;
  const std::string& key_;
  const bool most_;  // the largest value is looked for, not the least
  const std::vector<Constraint> holds_;
  const std::vector<std::string> names_;  // of the numbers that these are about
  const CaseEstimate estimate_;
  EvaluationInputs inputs_;
  EvaluationPool pool_;
  std::vector<std::string> values_;               // in the order in which they come to hold
  std::size_t start_ = 0;                         // the value that the machine has, or the next one
  std::map<std::size_t, EvaluationResult> runs_;  // by index of the value
};

}  // namespace

int ask_threshold(const AskOptions& options, CommandContext& context) {
  return ThresholdQuestion(options, context).run();
}

}  // namespace parallax
