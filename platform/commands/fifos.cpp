// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/fifos.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <utility>

#include "platform/commands/command_context.hpp"
#include "platform/commands/exit_codes.hpp"
#include "platform/commands/fifos_output.hpp"
#include "platform/commands/interruption.hpp"
#include "platform/commands/notes.hpp"
#include "platform/commands/run_folder.hpp"
#include "platform/commands/trial_pool.hpp"
#include "platform/config/preset.hpp"
#include "platform/evaluation/evaluation_inputs.hpp"
#include "platform/evaluation/trials.hpp"
#include "platform/input/run_input.hpp"
#include "platform/machine/steady_state.hpp"
#include "tlm/error.hpp"
#include "traces/json_text.hpp"
#include "traces/number_text.hpp"

namespace parallax {
namespace {

constexpr const char* kNumbers = "fifos.json";
constexpr const char* kPreset = "depths.toml";

FifoGoal goal_of(const FifosOptions& options) {
  FifoGoal goal;
  if (options.goal == "deadlock-free") {
    goal.kind = FifoGoal::Kind::kDeadlockFree;
  } else if (options.goal != "full-rate") {
    throw UserError(
        fmt::format("--goal is '{}', allowed is full-rate or deadlock-free", excerpt(options.goal)));
  }
  if (options.rate) {
    if (goal.kind == FifoGoal::Kind::kDeadlockFree)
      throw UserError("--rate and --goal deadlock-free exclude each other: each is a goal");
    if (!std::isfinite(*options.rate) || *options.rate <= 0)
      throw UserError(fmt::format("--rate is {}, it must be more than 0 frames/s", *options.rate));
    goal.kind = FifoGoal::Kind::kRate;
    goal.rate = *options.rate;
  }
  if (options.tolerance && goal.kind != FifoGoal::Kind::kFullRate)
    throw UserError("--tolerance is of the full rate, but the goal is another");
  const double tolerance = options.tolerance.value_or(FifosOptions::kUsualTolerance);
  if (!(tolerance >= 0 && tolerance <= 100))
    throw UserError(fmt::format("--tolerance is {}, allowed is 0 to 100 %", tolerance));
  goal.tolerance = tolerance / 100;
  goal.front = options.front;
  return goal;
}

// The same for each run, so that all are measured over the same frames.
std::int64_t frames_of(const RunOptions& options, const MachineConfig& config, const EvaluationInput& input) {
  const std::int64_t usual = run_length(config, input.frames, std::nullopt).least;
  if (!options.timing_frames) return usual;
  if (*options.timing_frames < usual) {
    throw UserError(fmt::format("--timing-frames is {}, but three frames of the steady state take {}",
                                *options.timing_frames, usual));
  }
  return *options.timing_frames;
}

// The first rows of a map.
EncodedMap top_of(const EncodedMap& map, int rows) {
  EncodedMap top = map;
  top.height = rows;
  top.row_bytes.resize(rows);
  top.bytes.resize(std::accumulate(top.row_bytes.begin(), top.row_bytes.end(), std::size_t{0}));
  return top;
}

// Rows that show what FIFOs between stages have to hold: the window of the rectification and some more.
int few_rows(const MachineConfig& config, int height) {
  constexpr int kMore = 16;
  const int granularity = config.image.granularity().height;
  const int rows = (config.rectification.range.window + kMore + granularity - 1) / granularity * granularity;
  return 2 * rows <= height ? rows : height;
}

FolderPlan plan(const RunOptions& options) {
  FolderPlan plan = folder_plan(options, {});
  plan.writes = [](const std::string& name) { return name == kNumbers || name == kPreset; };
  plan.replaces = [](const std::string&) { return false; };
  return plan;
}

int not_reached(const FifoSizing& sizing, CommandContext& context) {
  if (sizing.deep.done) {
    context.err << fmt::format(
        "parallax: error: --rate {} is not reached: with deep FIFOs the machine has {}\n", sizing.goal.rate,
        quantity_text(sizing.deep.period.rate(), "frames/s"));
  } else {
    context.err << fmt::format("parallax: error: with deep FIFOs, too, the machine is stuck: {}\n",
                               sizing.deep.message);
  }
  return kNotAsExpected;
}

// The machine on its input, sized.
class Sizing {
 public:
  Sizing(const FifosOptions& options, const EvaluationInput& input, CommandContext& context,
         const Interruption& interruption)
      : options_(options), input_(input), context_(context), interruption_(interruption) {}

  /// Throws TrialsEnded.
  FifoSizing find(const MachineConfig& config, const FifoGoal& goal) {
    const auto interrupted = [this] { return interruption_.requested(); };
    const std::optional<std::vector<MachineFifo>> fifos = machine_fifos(config, input_, interrupted);
    if (!fifos) throw TrialsEnded();
    fifos_ = *fifos;
    const Depths guessed = goal.kind == FifoGoal::Kind::kDeadlockFree ? Depths{} : guess(config, goal);
    return size(input_, goal, guessed);
  }
  /// Of the machine, so far.
  std::size_t runs() const { return runs_; }

 private:
  FifoSizing size(EvaluationInput input, const FifoGoal& goal, const Depths& guess) {
    std::optional<TrialPool> pool;
    FifoSizer sizer(fifos_, [&](const std::vector<std::vector<std::string>>& all, std::int64_t longest) {
      if (!pool || input.longest_frame_ps != longest) {
        input.longest_frame_ps = longest;
        pool.emplace(options_.run.configuration, input, context_, interruption_);
      }
      std::vector<Variant> variants;
      for (const std::vector<std::string>& assignments : all) variants.push_back({assignments});
      return pool->evaluate(variants, [this] { ++runs_; });
    });
    return sizer.size(goal, guess);
  }

  // Shallow FIFOs keep the simulation from going over many tokens at once, so that few rows or frames are
  // looked at first. What limits decides which: a core shows it in few rows, what waits for something slower
  // in how long it takes for a frame.
  Depths guess(const MachineConfig& config, const FifoGoal& goal) {
    TrialPool pool(options_.run.configuration, input_, context_, interruption_);
    const std::vector<EvaluationResult> deep = pool.evaluate({{assignments(fifos_, deep_depths(fifos_))}});
    if (deep.empty()) throw TrialsEnded();
    if (!deep[0].done() || deep[0].rate < goal.rate) return {};
    FifoGoal quick = goal;
    quick.front = false;
    EvaluationInput less = input_;
    if (goal.kind == FifoGoal::Kind::kRate || deep[0].limit.part != "core") {
      quick.by_core = true;
      quick.kind = FifoGoal::Kind::kRate;
      if (goal.kind == FifoGoal::Kind::kFullRate) quick.rate = deep[0].rate / (1 + goal.tolerance);
      less.timing_frames = config.software.queue_frames ? 3 : 2;
      return size(less, quick, {}).found.depths;
    }
    const int rows = few_rows(config, input_.map->height);
    if (rows == input_.map->height) return {};
    const EncodedMap top = top_of(*input_.map, rows);
    less.height = rows;
    less.map = &top;
    return size(less, quick, {}).found.depths;
  }

  const FifosOptions& options_;
  const EvaluationInput input_;
  CommandContext& context_;
  const Interruption& interruption_;
  std::vector<MachineFifo> fifos_;
  std::size_t runs_ = 0;
};

}  // namespace

int fifos(const FifosOptions& options, CommandContext& context) {
  const FifoGoal goal = goal_of(options);
  check_options(options.run);
  const Interruption interruption;
  Notes notes(context);
  EvaluationInputs inputs(options.run);
  const Configuration configuration = load_configuration(options.run.configuration, preset_folders());
  EvaluationInput input =
      inputs.prepare(configuration.machine, [&](const std::string& line) { notes(line); });
  const std::int64_t frames = frames_of(options.run, configuration.machine, input);
  input.timing_frames = frames;
  const std::string command = context.command_line.text();
  std::optional<OutputFolder> folder;
  if (!options.run.out.empty()) folder.emplace(options.run.out, plan(options.run));

  Sizing search(options, input, context, interruption);
  FifoSizing sizing;
  try {
    sizing = search.find(configuration.machine, goal);
  } catch (const TrialsEnded&) {
    return interrupted_after(fmt::format("{} run{}", search.runs(), search.runs() == 1 ? "" : "s"), context,
                             interruption);
  }
  if (sizing.found.depths.empty()) return not_reached(sizing, context);
  const nlohmann::ordered_json tree = to_json(sizing, frames, command);
  if (folder) {
    folder->write(kNumbers, json_text(tree, 2) + "\n");
    folder->write(kPreset, depths_preset(sizing, configuration, command));
    folder->publish();
  }
  if (options.run.json) {
    context.out << json_text(tree, 2) << '\n';
  } else if (context.verbosity != Verbosity::kQuiet) {
    context.out << to_text(sizing, frames);
    if (folder) {
      context.out << fmt::format("results             {}\npreset              {}\n", folder->path().string(),
                                 (folder->path() / kPreset).string());
    }
  }
  return 0;
}

}  // namespace parallax
