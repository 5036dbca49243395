// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/relax.hpp"

#include <fmt/format.h>

#include <optional>

#include "platform/commands/command_context.hpp"
#include "platform/commands/exit_codes.hpp"
#include "platform/commands/interruption.hpp"
#include "platform/commands/notes.hpp"
#include "platform/commands/run_folder.hpp"
#include "platform/commands/trial_pool.hpp"
#include "platform/config/preset.hpp"
#include "platform/evaluation/evaluation_inputs.hpp"
#include "platform/evaluation/verdict.hpp"
#include "traces/json_text.hpp"

namespace parallax {
namespace {

int not_measured(const EvaluationResult& base, CommandContext& context) {
  context.err << "parallax: error: " << base.message << (base.message.back() == '\n' ? "" : "\n");
  return base.status == EvaluationResult::Status::kInvalid ? kBadInput : kNotAsExpected;
}

void report(const Verdict& verdict, const RunOptions& options, OutputFolder* folder,
            CommandContext& context) {
  const nlohmann::ordered_json tree = to_json(verdict.limits);
  if (folder != nullptr) {
    folder->write("relaxations.json", json_text(tree, 2) + "\n");
    folder->publish();
  }
  if (options.json) {
    context.out << json_text(tree, 2) << '\n';
  } else if (context.verbosity != Verbosity::kQuiet) {
    context.out << to_text(verdict.limits) << "verdict             " << verdict.sentence << '\n';
  }
}

}  // namespace

int relax(const RunOptions& options, CommandContext& context) {
  const Interruption interruption;
  const auto stopped = [&](std::size_t measured) {
    return interrupted_after(fmt::format("{} limits", measured), context, interruption);
  };
  Notes notes(context);
  EvaluationInputs inputs(options);
  const Configuration configuration = load_configuration(options.configuration, preset_folders());
  EvaluationInput input =
      inputs.prepare(configuration.machine, [&](const std::string& line) { notes(line); });
  input.command = context.command_line.text();
  std::optional<OutputFolder> folder;
  if (!options.out.empty()) {
    ResultPlan plan;
    plan.relaxations = true;
    folder.emplace(options.out, folder_plan(options, plan));
  }
  TrialPool pool(options.configuration, input, context, interruption);
  const std::vector<EvaluationResult> base = pool.evaluate({{}});
  if (base.empty()) return stopped(0);
  if (!base[0].done()) return not_measured(base[0], context);
  if (base[0].rate == 0)
    throw UserError("--relax needs a frame rate: a single frame has none; --timing-frames 2 or more has one");
  const Verdict verdict =
      find_verdict(configuration.machine, base[0], Thoroughness::kAll,
                   [&pool](const std::vector<Relaxation>& relaxations) { return pool.try_out(relaxations); });
  if (interruption.requested()) return stopped(verdict.limits.alone.size());
  report(verdict, options, folder ? &*folder : nullptr, context);
  return 0;
}

}  // namespace parallax
