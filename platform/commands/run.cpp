// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>

#include "platform/commands/command_context.hpp"
#include "platform/commands/exit_codes.hpp"
#include "platform/commands/interruption.hpp"
#include "platform/commands/notes.hpp"
#include "platform/commands/relax.hpp"
#include "platform/commands/right_images.hpp"
#include "platform/commands/run_folder.hpp"
#include "platform/commands/run_frames.hpp"
#include "platform/commands/run_images.hpp"
#include "platform/commands/run_results.hpp"
#include "platform/commands/simulation.hpp"
#include "platform/commands/trial_pool.hpp"
#include "platform/commands/vary.hpp"
#include "platform/config/preset.hpp"
#include "platform/cosim/circuit_run.hpp"
#include "platform/evaluation/verdict.hpp"
#include "platform/input/run_input.hpp"
#include "platform/machine/machine.hpp"
#include "platform/machine/simulated_time.hpp"
#include "platform/machine/steady_state.hpp"
#include "platform/results/deadlock_report.hpp"
#include "platform/results/peak_memory.hpp"
#include "platform/results/progress.hpp"
#include "platform/results/rate_metrics.hpp"
#include "platform/results/run_metrics.hpp"
#include "platform/tracing/run_profile.hpp"
#include "platform/tracing/tracing.hpp"
#include "traces/json_text.hpp"

namespace parallax {
namespace {

using WallClock = std::chrono::steady_clock;

// Trials may take four times as long as the run itself, and a minute in any case.
constexpr std::chrono::seconds kLeastForTrials{60};
constexpr int kTrialsForRun = 4;
// Of trials that take longer a note says why.
constexpr std::chrono::seconds kUntold{10};

// One run, from the options to the exit code.
class Run {
 public:
  Run(const RunOptions& options, CommandContext& context)
      : options_(options),
        context_(context),
        notes_(context, true),
        configuration_(load_configuration(options.configuration, preset_folders())),
        images_(options, configuration_.machine, [this](const std::string& line) { notes_(line); }),
        length_(run_length(configuration_.machine, images_.frames(), options.timing_frames)),
        trace_choice_(read_trace_options(options.trace)) {}

  int execute() {
    if (!options_.out.empty()) {
      folder_ = std::make_unique<OutputFolder>(options_.out, folder_plan(options_, plan()));
    }
    RunFrames writer(images_, folder_.get(), listener(), frame_options(),
                     configuration_.machine.matching.range().last());
    Simulation simulation(length_.most, interrupted_);
    progress_ = std::make_unique<Progress>(context_.err, shows_progress(context_), "frames", length_.least,
                                           notes_.sink());
    progress_->may_go_on_to(length_.most);
    // Before this process simulates.
    if (!options_.circuits.empty()) {
      circuits_ = std::make_unique<CircuitRun>(options_.circuits, options_.circuit_shadow, folder_ != nullptr,
                                               configuration_.machine, model_input(), interrupted_);
      if (interrupted_()) return interrupted(writer);
    }
    if ((options_.verdict && !circuits_) || options_.report)
      trials_.emplace(options_.configuration, timing_input(), context_, interruption_);
    const Machine machine("machine", configuration_.machine, machine_input(simulation, writer));
    if (options_.take) right_images_ = std::make_unique<RightImages>(machine);
    SamplingTimer timer("sampling_timer");
    if (folder_) profile_ = std::make_unique<RunProfile>(machine, timer);
    if (options_.trace.wanted())
      tracing_ = std::make_unique<Tracing>(trace_choice_, machine, timer, *folder_);
    const double total = shortest_frame_time(machine) * static_cast<double>(length_.least);
    notes_.begin();
    simulation.run([&](double seconds) { progress_->reached(seconds / total); });
    progress_.reset();
    for (const std::string& remark : writer.remarks()) notes_(remark);
    if (simulation.stopped()) return interrupted(writer);
    if (tracing_) tracing_->finish();
    if (profile_) profile_->finish();
    return conclude(machine, writer);
  }

 private:
  ResultPlan plan() const {
    ResultPlan plan;
    plan.frames = !options_.timing_only;
    plan.sequence = images_.frames() > 1;
    plan.truth = images_.is_scene() || !options_.ground_truth.empty();
    plan.points = options_.point_cloud && images_.q().has_value();
    plan.timing = true;
    plan.report = plan.relaxations = options_.report;
    plan.circuits = !options_.circuits.empty();
    plan.traces = trace_choice_.formats;
    return plan;
  }

  RunFrames::Listener listener() {
    if (!options_.take) return {};
    return [this](std::int64_t index, FrameImages& frame) {
      frame.right = crop_image(right_images_->take(), images_.size());
      options_.take(index, frame);
    };
  }

  FrameResultOptions frame_options() const {
    const DisparityRange range = configuration_.machine.matching.range();
    return {disparity_scale(range.offset, range.last()), options_.point_cloud ? images_.q() : std::nullopt};
  }

  MachineInput machine_input(Simulation& simulation, RunFrames& writer) {
    MachineInput input;
    input.width = images_.padded().width;
    input.height = images_.padded().height;
    input.map = &images_.map();
    input.frames = length_.most;
    input.least_frames = length_.least;
    input.enough = frames_are_enough;
    input.timing_only = options_.timing_only;
    if (circuits_) input.replacements = circuits_->replacements([] { sc_core::sc_stop(); });
    input.expose = [this, &simulation](std::int64_t frame) {
      const bool has_images = !options_.timing_only && frame < images_.frames();
      return simulation.at_exposure(frame, [&] { return has_images ? images_.load(frame) : StereoFrame{}; });
    };
    input.step = [this](std::int64_t frame, FrameStep step) {
      if (tracing_) tracing_->frame_step(frame, step);
      if (profile_) profile_->frame_step(frame, step);
    };
    input.deliver = [this, &simulation, &writer](const FrameResult& result) {
      if (tracing_) tracing_->delivered(result.index);
      simulation.at_delivery([&] {
        progress_->advance();
        if (!result.disparities.empty()) writer.take(result);
      });
    };
    return input;
  }

  // Of the model without circuits, on the frames with images alone.
  MachineInput model_input() const {
    MachineInput input;
    input.width = images_.padded().width;
    input.height = images_.padded().height;
    input.map = &images_.map();
    input.frames = images_.frames();
    input.expose = [this](std::int64_t frame) {
      return frame < images_.frames() ? images_.load(frame) : StereoFrame{};
    };
    return input;
  }

  EvaluationInput timing_input() const {
    EvaluationInput input;
    input.width = images_.size().width;
    input.height = images_.size().height;
    input.map = &images_.map();
    // A run that was asked to be short is compared with short ones.
    const RunLength usual = run_length(configuration_.machine, 1, std::nullopt);
    if (options_.timing_frames && *options_.timing_frames < usual.least)
      input.timing_frames = options_.timing_frames;
    return input;
  }

  int conclude(const Machine& machine, RunFrames& writer) {
    RunTotals totals = writer.totals();
    totals.wall_seconds = std::chrono::duration<double>(WallClock::now() - began_).count();
    totals.peak_megabytes = peak_memory_megabytes();
    totals.command = context_.command_line.text();
    if (images_.is_scene()) totals.scene_seed = options_.scene.seed;
    const RunResults results(options_, configuration_, context_, folder_.get());
    if (circuits_) {
      machine.dataflow().bring_up_to_date();
      circuits_->conclude();
      if (!circuits_->fault().empty())
        context_.err << fmt::format("parallax: error: {}\n", circuits_->fault());
    }
    if (!machine.finished() && sc_core::sc_get_status() == sc_core::SC_STOPPED) {  // by a circuit
      if (options_.json) {
        context_.out << json_text(nlohmann::ordered_json{{"circuits", circuits_->json()}}, 2) << '\n';
      } else {
        tell_of_circuits();
      }
      write_of_circuits();
      return kNotAsExpected;
    }
    if (!machine.finished()) {  // the files say how far it came
      const Deadlock deadlock = find_deadlock(machine);
      context_.err << "parallax: error: " << message(deadlock);
      const nlohmann::ordered_json tree =
          results.write(measure_stuck(machine, deadlock, totals, images_.size().width, images_.size().height),
                        profile_.get(), writer);
      if (options_.json) context_.out << json_text(tree, 2) << '\n';
      return kNotAsExpected;
    }
    MetricGroup metrics = measure(machine, totals, images_.size().width, images_.size().height);
    const bool judged = !trials_ || judge(metrics);
    nlohmann::ordered_json tree = results.write(metrics, profile_.get(), writer);
    if (!judged) return interrupted(writer);
    if (circuits_) tree["circuits"] = circuits_->json();
    results.print(metrics, tree);
    if (!circuits_) return 0;
    if (!options_.json) tell_of_circuits();
    write_of_circuits();
    return circuits_->as_model() ? 0 : kNotAsExpected;
  }

  void tell_of_circuits() const {
    if (context_.verbosity == Verbosity::kQuiet) return;
    context_.out << circuits_->text();
    if (!folder_) return;
    const char* head = "where it differs";
    for (const CircuitOutcome::File& file : circuits_->files()) {
      context_.out << fmt::format("{:20}{}\n", head, (folder_->path() / file.name).string());
      head = "";
    }
  }

  void write_of_circuits() const {
    if (!folder_) return;
    for (const CircuitOutcome::File& file : circuits_->files()) folder_->write(file.name, file.content);
    folder_->publish();
  }

  // Adds what limits, but not of a single frame, which has no rate. Says no when it was interrupted.
  bool judge(MetricGroup& metrics) {
    const EvaluationResult base = measured(metrics);
    if (base.rate == 0) return true;
    const WallClock::time_point began = WallClock::now();
    // A page says what all limits gain, whatever time that takes.
    if (!options_.report) {
      const WallClock::time_point now = WallClock::now();
      trials_->end_at(now + std::max<WallClock::duration>(kLeastForTrials, kTrialsForRun * (now - began_)));
    }
    const Verdict verdict = find_verdict(
        configuration_.machine, base, options_.report ? Thoroughness::kAll : Thoroughness::kUntilCertain,
        [&](const std::vector<Relaxation>& relaxations) {
          if (WallClock::now() - began > kUntold)
            notes_("finding out what limits takes more runs of the machine; --no-verdict leaves them out");
          return trials_->try_out(relaxations);
        });
    if (interrupted_()) return false;
    if (options_.report) folder_->write("relaxations.json", json_text(to_json(verdict.limits), 2) + "\n");
    add_verdict(metrics, verdict);
    return true;
  }

  int interrupted(const RunFrames& writer) const {
    const std::int64_t frames = writer.totals().frames;
    return interrupted_after(fmt::format("{} frame{}", frames, frames == 1 ? "" : "s"), context_,
                             interruption_);
  }

  const WallClock::time_point began_ = WallClock::now();
  const RunOptions& options_;
  CommandContext& context_;
  Notes notes_;
  const Configuration configuration_;
  const RunImages images_;
  const RunLength length_;
  const TraceChoice trace_choice_;
  const Interruption interruption_;
  const std::function<bool()> interrupted_ = [this] { return interruption_.requested(); };
  std::unique_ptr<OutputFolder> folder_;
  std::unique_ptr<Progress> progress_;
  std::unique_ptr<CircuitRun> circuits_;  // in the place of stages, if there are any
  std::optional<TrialPool> trials_;
  std::unique_ptr<RightImages> right_images_;  // where a program takes frames
  std::unique_ptr<Tracing> tracing_;
  std::unique_ptr<RunProfile> profile_;
};

}  // namespace

int run(const RunOptions& options, CommandContext& context) {
  if (!options.vary.empty()) return vary(options, context);
  check_options(options);
  return options.relax ? relax(options, context) : Run(options, context).execute();
}

}  // namespace parallax
