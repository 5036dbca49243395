// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/ask.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <utility>

#include "platform/commands/command_context.hpp"
#include "platform/commands/exit_codes.hpp"
#include "platform/commands/interruption.hpp"
#include "platform/commands/notes.hpp"
#include "platform/config/nearest_key.hpp"
#include "platform/config/preset.hpp"
#include "platform/evaluation/evaluation_inputs.hpp"
#include "platform/evaluation/evaluation_pool.hpp"
#include "platform/explore/candidates.hpp"
#include "platform/explore/judgement.hpp"
#include "platform/explore/threshold_search.hpp"
#include "platform/input/run_input.hpp"
#include "platform/results/glossary.hpp"
#include "platform/results/progress.hpp"
#include "tlm/error.hpp"
#include "traces/json_text.hpp"
#include "traces/metric_text.hpp"
#include "traces/number_text.hpp"

namespace parallax {
namespace {

// Where no bounds are given: so many times less and more than the value that the machine has.
constexpr double kReach = 8;

bool read_which(const std::string& which) {
  if (which != "least" && which != "most")
    throw UserError(fmt::format("ask '{}': must be least or most", excerpt(which)));
  return which == "most";
}

// "performance/frame_rate>=60".
Constraint read_hold(const std::string& text) {
  const std::string before = fmt::format("--hold {}: ", excerpt(text));
  const std::size_t sign = text.find_first_of("<>");
  if (sign == std::string::npos || text.compare(sign + 1, 1, "=") != 0)
    throw UserError(before +
                    "must have the form NUMBER>=VALUE or NUMBER<=VALUE, as performance/frame_rate>=60");
  const auto trimmed = [](std::string word) {
    word.erase(0, word.find_first_not_of(' '));
    return word.substr(0, word.find_last_not_of(' ') + 1);
  };
  Constraint constraint{trimmed(text.substr(0, sign)), {}, {}, ""};
  const std::string number = trimmed(text.substr(sign + 2));
  double bound = 0;
  const auto [last, error] = std::from_chars(number.data(), number.data() + number.size(), bound);
  if (error != std::errc() || last != number.data() + number.size())
    throw UserError(fmt::format("{}'{}' is no number", before, excerpt(number)));
  if (find_run_metric(constraint.metric) == nullptr) {
    throw UserError(fmt::format("{}no number of a run is called {}; the nearest is {} (parallax glossary)",
                                before, excerpt(constraint.metric),
                                nearest_key(constraint.metric, run_metric_names())));
  }
  if (constraint.metric.rfind("quality/", 0) == 0)
    throw UserError(fmt::format("{}{} needs images, and none are computed", before, constraint.metric));
  if (find_run_metric(constraint.metric)->unit.empty())
    throw UserError(fmt::format("{}{} is a word, and has no bounds", before, constraint.metric));
  (text[sign] == '>' ? constraint.at_least : constraint.at_most) = bound;
  return constraint;
}

class Question {
 public:
  Question(const AskOptions& options, CommandContext& context)
      : options_(options),
        context_(context),
        most_(read_which(options.which)),
        hold_(read_hold(options.hold)),
        inputs_(options.run),
        pool_([this](const Variant& variant, const NoticeSink& notice) { return prepare(variant, notice); }) {
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
    return one;
  }

  Configuration configuration(const std::string& assignment) const {
    ConfigurationRequest request = options_.run.configuration;
    request.changes = {assignment};
    return load_configuration(request, preset_folders());
  }

  std::string assignment(std::size_t index) const { return options_.key + "=" + values_[index]; }

  std::string command(const std::string& assignment) const {
    // What this command has beside the options of a run goes.
    return context_.command_line.with({"--hold", "--from", "--to"}, {"--set", assignment})
        .beginning({"run", "--timing-only", "--no-verdict"},
                   {"ask", most_ ? "most" : "least", options_.key, "--json"})
        .text();
  }

  // Those that are no possible machine are left out, where looking at all of them takes no time.
  void find_values() {
    constexpr std::size_t kLookedAt = 400;
    const Configuration now = load_configuration(options_.run.configuration, preset_folders());
    MachineConfig machine = now.machine;
    Schema schema;
    describe(schema, machine);
    const Key* const key = schema.find(options_.key);
    if (key == nullptr) {
      std::vector<std::string> names;
      for (const Key& known : schema.keys()) names.push_back(known.path);
      throw UserError(fmt::format("unknown key {}; the nearest is {}", excerpt(options_.key),
                                  nearest_key(options_.key, names)));
    }
    const bool whole = key->type == KeyType::kInteger;
    if (!whole && key->type != KeyType::kReal)
      throw UserError(fmt::format("{} is no number: it is {}", options_.key, key->expected()));
    const auto [least, most] = reach(*key, whole);
    values_ = candidates(least, most, whole);
    if (values_.size() <= kLookedAt) {
      const auto impossible = [this](const std::string& value) {
        try {
          configuration(options_.key + "=" + value);
          return false;
        } catch (const UserError&) {
          return true;
        }
      };
      values_.erase(std::remove_if(values_.begin(), values_.end(), impossible), values_.end());
    }
    if (values_.empty())
      throw UserError(
          fmt::format("{}: no value from {} to {} makes a possible machine", options_.key, least, most));
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
      throw UserError(fmt::format("{} is {}: --from and --to have to say where to look", options_.key, now));
    const double lowest = whole ? static_cast<double>(key.integers.least) : key.reals.least;
    const double highest = whole ? static_cast<double>(key.integers.most) : key.reals.most;
    const double least = std::max(options_.from.value_or(now / kReach), lowest);
    const double most = std::min(options_.to.value_or(now * kReach), highest);
    if (least > most)
      throw UserError(fmt::format("{}: nothing between {} and {}; it takes {}", options_.key, least, most,
                                  key.expected()));
    return {least, most};
  }

  Threshold search(const Interruption& interruption) {
    Notes notes(context_);
    // So many steps at most, as each leaves a part of the gap.
    Progress progress(context_.err, shows_progress(context_), "runs", 0, notes.sink());
    return find_threshold(values_.size(), start_, EvaluationPool::usual_processes(),
                          [&](const std::vector<std::size_t>& indices) {
                            std::vector<Variant> variants;
                            for (const std::size_t index : indices) variants.push_back({{assignment(index)}});
                            std::vector<bool> answers;
                            pool_.evaluate(
                                variants, [&] { return interruption.requested(); },
                                [&](std::size_t number, EvaluationResult result) {
                                  for (const std::string& note : result.notes) notes(note);
                                  answers.push_back(holds(result));
                                  runs_.insert_or_assign(indices[number], std::move(result));
                                  progress.advance();
                                });
                            return answers;
                          });
  }

  std::optional<double> value_of(const EvaluationResult& result) const {
    const Metric* const metric = result.done() ? result.metrics.find(hold_.metric) : nullptr;
    return metric != nullptr && metric->is_number() ? std::optional(metric->number()) : std::nullopt;
  }

  bool holds(const EvaluationResult& result) const { return miss(hold_, value_of(result)) == 0; }

  std::string said_of(std::size_t index) const {
    const EvaluationResult& result = runs_.at(index);
    const Metric* const metric = result.done() ? result.metrics.find(hold_.metric) : nullptr;
    if (metric != nullptr) return metric_text(*metric);
    return result.done() ? "has no such number" : fmt::format("{}: {}", name(result.status), result.advice());
  }

  std::string bound_text() const {
    const std::string unit = find_run_metric(hold_.metric)->unit;
    return fmt::format("{} {}", hold_.at_least ? "at least" : "at most",
                       with_unit(stated_text(hold_.at_least ? *hold_.at_least : *hold_.at_most, unit), unit));
  }

  std::string answer_text(std::optional<std::size_t> at) const {
    if (!at) {
      return fmt::format("none from {} to {} has {} {}; with {}: {}", values_.front(), values_.back(),
                         hold_.metric, bound_text(), values_.back(), said_of(values_.size() - 1));
    }
    const std::string found =
        fmt::format("{} = {} has {} {}", options_.key, values_[*at], hold_.metric, said_of(*at));
    if (*at == 0)
      return found + fmt::format("; it is the {} that was looked at", most_ ? "largest" : "least");
    return found + fmt::format("; with {}: {}", values_[*at - 1], said_of(*at - 1));
  }

  std::string text(std::optional<std::size_t> at) const {
    std::string lines = fmt::format("answer              {}\n", answer_text(at));
    std::size_t widest = options_.key.size();
    for (const auto& [index, result] : runs_) widest = std::max(widest, values_[index].size());
    lines += fmt::format("runs                {}\n{:>{}}  {}, what limits\n", runs_.size(), options_.key,
                         widest, hold_.metric);
    for (const auto& [index, result] : runs_)
      lines += fmt::format("{:>{}}  {}{}\n", values_[index], widest, said_of(index),
                           result.done() ? ", " + result.limit.part : "");
    return lines;
  }

  nlohmann::ordered_json tree(std::optional<std::size_t> at) const {
    using Json = nlohmann::ordered_json;
    Json runs = Json::array();
    for (const auto& [index, result] : runs_) {
      Json run{{"value", values_[index]}, {"status", name(result.status)}, {"holds", holds(result)}};
      if (const std::optional<double> value = value_of(result)) run[hold_.metric] = *value;
      if (result.done()) run["limit"] = result.limit.part;
      if (!result.done()) run["message"] = result.message;
      run["command"] = command(assignment(index));
      runs.push_back(std::move(run));
    }
    return {{"key", options_.key},
            {"answer", at ? Json(values_[*at]) : Json()},
            {"sentence", answer_text(at)},
            {"unit", find_run_metric(hold_.metric)->unit},
            {"runs", runs}};
  }

  const AskOptions& options_;
  CommandContext& context_;
  const bool most_;  // the largest value is looked for, not the least
  const Constraint hold_;
  EvaluationInputs inputs_;
  EvaluationPool pool_;
  std::vector<std::string> values_;               // in the order in which they come to hold
  std::size_t start_ = 0;                         // the value that the machine has, or the next one
  std::map<std::size_t, EvaluationResult> runs_;  // by index of the value
};

}  // namespace

int ask(const AskOptions& options, CommandContext& context) { return Question(options, context).run(); }

}  // namespace parallax
