// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/relax.hpp"

#include <fmt/format.h>

#include <set>

#include "platform/commands/command_context.hpp"
#include "platform/commands/interruption.hpp"
#include "platform/commands/timing_inputs.hpp"
#include "platform/config/preset.hpp"
#include "platform/evaluation/relaxation.hpp"
#include "platform/evaluation/relaxed_limits.hpp"
#include "platform/evaluation/standby_evaluator.hpp"
#include "platform/results/output_folder.hpp"
#include "platform/results/progress.hpp"
#include "platform/results/result_names.hpp"

namespace parallax {
namespace {

constexpr int kNotMeasured = 1;
constexpr int kSignalled = 128;  // as shells report a program that a signal ended

using Status = TimingResult::Status;

class Relaxing {
 public:
  Relaxing(const RunOptions& options, CommandContext& context)
      : options_(options), context_(context), inputs_(options, [this](const std::string& line) {
          if (context_.verbosity != Verbosity::kQuiet && said_.insert(line).second) {
            context_.err << "parallax: note: " << line << '\n';
          }
        }) {}

  int run() {
    const MachineConfig config = load_configuration(options_.configuration, preset_folders()).machine;
    TimingInput input = inputs_.prepare(config);
    input.command = context_.command_line.text();
    StandbyEvaluator evaluator(input, options_.configuration);
    const auto interrupted = [this] { return interruption_.requested(); };
    const TimingResult base = evaluator.evaluate({{}}, interrupted, [] {}).front();
    if (interrupted()) return stopped(0);
    if (base.status != Status::kDone) {
      context_.err << "parallax: error: " << base.message << (base.message.back() == '\n' ? "" : "\n");
      return base.status == Status::kInvalid ? 2 : kNotMeasured;
    }
    const std::vector<Relaxation> all = relaxations(config, base.metrics);
    std::vector<std::vector<std::string>> variants;
    for (const Relaxation& relaxation : all) variants.push_back(relaxation.assignments);
    std::size_t measured = 0;
    std::vector<TimingResult> results;
    {
      Progress progress(context_.err, context_.verbosity != Verbosity::kQuiet && standard_error_is_terminal(),
                        "limits", static_cast<std::int64_t>(all.size()));
      results = evaluator.evaluate(variants, interrupted, [&] {
        ++measured;
        progress.advance();
      });
    }
    if (interrupted()) return stopped(measured);
    report(relaxed_limits(base.metrics, all, results));
    return 0;
  }

 private:
  void report(const RelaxedLimits& limits) {
    const nlohmann::ordered_json tree = to_json(limits);
    if (!options_.out.empty()) {
      OutputFolder folder(options_.out);
      folder.replace(is_result_name);
      folder.write("relaxations.json", tree.dump(2) + "\n");
      folder.publish();
    }
    if (options_.json) {
      context_.out << tree.dump(2) << '\n';
    } else if (context_.verbosity != Verbosity::kQuiet) {
      context_.out << to_text(limits);
    }
  }

  int stopped(std::size_t measured) {
    context_.err << fmt::format("parallax: interrupted after {} limits\n", measured);
    return kSignalled + interruption_.signal();
  }

  const RunOptions& options_;
  CommandContext& context_;
  const Interruption interruption_;
  std::set<std::string> said_;  // notes, once each
  TimingInputs inputs_;
};

}  // namespace

int relax(const RunOptions& options, CommandContext& context) { return Relaxing(options, context).run(); }

}  // namespace parallax
