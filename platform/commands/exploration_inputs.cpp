// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/exploration_inputs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "platform/commands/input_contents.hpp"
#include "platform/commands/timed_run.hpp"
#include "platform/config/configuration_hash.hpp"
#include "platform/config/preset.hpp"
#include "platform/input/quoted_text.hpp"
#include "platform/input/run_input.hpp"

namespace parallax {
namespace {

// Of each a map is kept, some megabytes.
constexpr std::size_t kInputsKept = 4;

}  // namespace

ExplorationInputs::ExplorationInputs(const ExplorationSpec& spec)
    : spec_(spec), estimate_(spec.device, spec.named_metrics()) {}

std::vector<RunWord> ExplorationInputs::words(const ExplorationPoint& point) const {
  std::vector<RunWord> all = spec_.run;
  for (RunWord& word : run_words_of(spec_, point)) all.push_back(std::move(word));
  return all;
}

RunOptions ExplorationInputs::options(const ExplorationPoint& point) const {
  RunOptions options = timed_run(words(point));
  check_options(options);
  return options;
}

ExplorationInputs::Opened& ExplorationInputs::opened(const ExplorationPoint& point) {
  const std::vector<std::string> text = command_words(words(point));
  const auto found =
      std::find_if(opened_.begin(), opened_.end(), [&](const auto& opened) { return opened->words == text; });
  if (found != opened_.end()) return **found;
  auto next = std::make_unique<Opened>(text, options(point));
  next->content = input_contents(next->options);
  if (opened_.size() == kInputsKept) opened_.pop_front();
  opened_.push_back(std::move(next));
  return *opened_.back();
}

Configuration ExplorationInputs::configuration(const RunOptions& options,
                                               const ExplorationPoint& point) const {
  ConfigurationRequest request = options.configuration;
  request.assignments = spec_.assignments;
  for (std::string& assignment : assignments_of(spec_, point))
    request.assignments.push_back(std::move(assignment));
  return load_configuration(request, preset_folders());
}

std::string ExplorationInputs::command(const ExplorationPoint& point) const {
  std::string text = "parallax run --timing-only --no-verdict";
  for (const std::string& word : command_words(words(point))) text += ' ' + shell_word(word);
  for (const std::string& assignment : spec_.assignments) text += " --set " + shell_word(assignment);
  for (const std::string& assignment : assignments_of(spec_, point))
    text += " --set " + shell_word(assignment);
  return text;
}

void ExplorationInputs::check_input(const ExplorationPoint& point) {
  Opened& input = opened(point);
  ConfigurationRequest request = input.options.configuration;
  request.assignments = spec_.assignments;
  input.inputs.open(load_configuration(request, preset_folders()).machine, [](const std::string&) {});
}

PointIdentity ExplorationInputs::identify(const ExplorationPoint& point) {
  const Opened& input = opened(point);
  PointIdentity identity;
  identity.configuration = configuration_hash(configuration(input.options, point).machine);
  // The preset and the range are in the configuration.
  for (const RunWord& word : words(point)) {
    if (word.option == "preset" || word.option == "disparities") continue;
    for (const std::string& text : command_words({word}))
      identity.input += (identity.input.empty() ? "" : " ") + shell_word(text);
  }
  identity.input += input.content;
  identity.input += estimate_.identity();
  identity.command = command(point);
  identity.seed = input.options.scene.seed;
  return identity;
}

EvaluationCase ExplorationInputs::prepare(const ExplorationPoint& point, const NoticeSink& notice) {
  Opened& input = opened(point);
  EvaluationCase one{configuration(input.options, point), {}};
  one.input = input.inputs.prepare(one.configuration.machine, notice);
  one.input.command = command(point);
  estimate_.add_to(one);
  return one;
}

}  // namespace parallax
