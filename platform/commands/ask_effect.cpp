// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/ask_effect.hpp"

#include <fmt/format.h>

#include <utility>

#include "platform/commands/case_estimate.hpp"
#include "platform/commands/command_context.hpp"
#include "platform/commands/exit_codes.hpp"
#include "platform/commands/interruption.hpp"
#include "platform/commands/notes.hpp"
#include "platform/commands/question.hpp"
#include "platform/config/preset.hpp"
#include "platform/estimate/estimate_metrics.hpp"
#include "platform/evaluation/evaluation_inputs.hpp"
#include "platform/evaluation/evaluation_pool.hpp"
#include "platform/input/run_input.hpp"
#include "tlm/error.hpp"
#include "traces/json_text.hpp"
#include "traces/metric_text.hpp"
#include "traces/number_text.hpp"

namespace parallax {
namespace {

// What a change can be good for, and what it costs.
std::vector<std::string> shown_names(const std::string& device) {
  std::vector<std::string> names{"performance/frame_rate",
                                 "performance/evaluations_per_second",
                                 "latency/exposure_to_host_mean",
                                 "latency/exposure_to_host_p99",
                                 "limit/part",
                                 "limit/utilisation",
                                 "memory/share",
                                 "energy/frame_total",
                                 "resources/lut",
                                 "resources/ff",
                                 "resources/block_ram",
                                 "resources/dsp"};
  if (!device.empty()) names.push_back("devices/" + device_group(device) + "/fits");
  return names;
}

class EffectQuestion {
 public:
  EffectQuestion(const AskOptions& options, CommandContext& context)
      : options_(options),
        context_(context),
        names_(shown_names(options.device)),
        estimate_(options.device, names_),
        inputs_(options.run) {
    check_options(options_.run);
    for (const std::string& change : options_.subjects) {
      if (change.find('=') == std::string::npos)
        throw UserError(fmt::format("ask effect {}: must have the form KEY=VALUE", excerpt(change)));
    }
    // What is wrong with the machine, or with the changes, is wrong with the question.
    machine({});
    machine(options_.subjects);
  }

  int run() {
    const Interruption interruption;
    std::vector<EvaluationResult> results;
    {
      EvaluationPool pool([this](const Variant& variant, const NoticeSink& notice) {
        EvaluationCase one{machine(variant.assignments), {}};
        one.input = inputs_.prepare(one.configuration.machine, notice);
        one.input.command = command(variant.assignments);
        estimate_.add_to(one);
        return one;
      });
      Notes notes(context_);
      pool.evaluate(
          {Variant{}, Variant{options_.subjects}}, [&] { return interruption.requested(); },
          [&](std::size_t, EvaluationResult result) {
            for (const std::string& note : result.notes) notes(note);
            results.push_back(std::move(result));
          });
    }
    if (results.size() < 2)
      return interrupted_after(fmt::format("{} of 2 runs", results.size()), context_, interruption);
    for (const EvaluationResult& result : results) {
      if (!result.done() && result.status == EvaluationResult::Status::kInvalid)
        throw UserError(result.advice());
    }
    if (options_.run.json) {
      context_.out << json_text(tree(results[0], results[1]), 2) << '\n';
    } else if (context_.verbosity != Verbosity::kQuiet) {
      context_.out << text(results[0], results[1]);
    }
    return results[0].done() && results[1].done() ? 0 : kNotAsExpected;
  }

 private:
  Configuration machine(const std::vector<std::string>& changes) const {
    ConfigurationRequest request = options_.run.configuration;
    request.changes = changes;
    return load_configuration(request, preset_folders());
  }

  std::string command(const std::vector<std::string>& changes) const {
    std::vector<std::string> words;
    for (const std::string& change : changes) words.insert(words.end(), {"--set", change});
    return run_command(context_.command_line, options_, words);
  }

  // "+39.4 %"; of shares in points of percent; nothing where there are no two numbers, or nothing to relate
  // to.
  static std::string change(const Metric& before, const Metric& after) {
    if (!before.is_number() || !after.is_number()) return "";
    const double was = before.number(), is = after.number();
    if (before.unit == "%") return change_text(is - was, "%") + " points";
    return was == 0 ? "" : change_text(100 * (is / was - 1), "%") + " %";
  }

  std::string text(const EvaluationResult& before, const EvaluationResult& after) const {
    const auto said = [](const Metric* metric) { return metric == nullptr ? "-" : metric_text(*metric); };
    std::vector<std::vector<std::string>> rows{
        {fmt::format("{}", fmt::join(options_.subjects, " ")), "without", "with", "change"}};
    for (const std::string& each : names_) {
      const Metric* const was = before.metrics.find(each);
      const Metric* const is = after.metrics.find(each);
      if (was == nullptr && is == nullptr) continue;
      rows.push_back({each, said(was), said(is), was != nullptr && is != nullptr ? change(*was, *is) : ""});
    }
    std::string lines = table_text(rows);
    for (const auto& [which, result] : {std::pair("without", &before), {"with", &after}}) {
      if (!result->done())
        lines += fmt::format("{:<20}{}: {}\n", which, name(result->status), result->advice());
    }
    return lines;
  }

  nlohmann::ordered_json tree(const EvaluationResult& before, const EvaluationResult& after) const {
    using Json = nlohmann::ordered_json;
    const auto side = [this](const EvaluationResult& result, const std::vector<std::string>& changes) {
      Json tree{{"status", name(result.status)}, {"numbers", Json::object()}};
      for (const std::string& each : names_) {
        if (const Metric* const metric = result.metrics.find(each)) tree["numbers"][each] = to_json(*metric);
      }
      if (!result.done()) tree["message"] = result.message;
      tree["command"] = command(changes);
      return tree;
    };
    return {{"changes", options_.subjects},
            {"without", side(before, {})},
            {"with", side(after, options_.subjects)}};
  }

  const AskOptions& options_;
  CommandContext& context_;
  const std::vector<std::string> names_;  // of the numbers that are shown
  const CaseEstimate estimate_;
  EvaluationInputs inputs_;
};

}  // namespace

int ask_effect(const AskOptions& options, CommandContext& context) {
  return EffectQuestion(options, context).run();
}

}  // namespace parallax
