// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "platform/commands/command_context.hpp"
#include "platform/commands/interruption.hpp"
#include "platform/commands/relax.hpp"
#include "platform/commands/vary.hpp"
#include "platform/config/config_writer.hpp"
#include "platform/config/preset.hpp"
#include "platform/evaluation/relaxed_limits.hpp"
#include "platform/evaluation/standby_evaluator.hpp"
#include "platform/evaluation/verdict.hpp"
#include "platform/input/image_padding.hpp"
#include "platform/input/rectification_choice.hpp"
#include "platform/input/run_input.hpp"
#include "platform/machine/machine.hpp"
#include "platform/machine/steady_state.hpp"
#include "platform/report/report_file.hpp"
#include "platform/results/deadlock_report.hpp"
#include "platform/results/frame_results.hpp"
#include "platform/results/peak_memory.hpp"
#include "platform/results/progress.hpp"
#include "platform/results/result_names.hpp"
#include "platform/results/run_metrics.hpp"
#include "platform/results/strip_gif.hpp"
#include "platform/tracing/run_profile.hpp"
#include "platform/tracing/tracing.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr int kMachineStuck = 1;
constexpr int kSignalled = 128;  // as shells report a program that a signal ended

// One run: what the machine asks for and hands over, frame by frame.
class Run {
 public:
  Run(const RunOptions& options, CommandContext& context)
      : options_(options),
        context_(context),
        configuration_(load_configuration(options.configuration, preset_folders())),
        notice_([this](const std::string& line) { note(line); }),
        source_(open_source(options, configuration_.machine, notice_)),
        granularity_{static_cast<int>(configuration_.machine.image.width_granularity),
                     static_cast<int>(configuration_.machine.image.height_granularity)},
        size_(source_->width(), source_->height()),
        padded_(padded_size(size_, granularity_)),
        rectification_(choose_rectification(options, configuration_.machine.rectification.range, *source_,
                                            padded_, notice_)),
        total_frames_(frames_to_simulate(configuration_.machine, source_->frames(), options.timing_frames)),
        trace_choice_(read_trace_options(options.trace)),
        writing_{disparity_scale(configuration_.machine.matching.range().offset,
                                 configuration_.machine.matching.range().last()),
                 options.point_cloud ? rectification_.q : std::nullopt} {
    if (const std::string line = padding_notice(size_, granularity_); !line.empty()) note(line);
  }

  int execute() {
    const Interruption interruption;
    if (!options_.out.empty()) {
      folder_ = std::make_unique<OutputFolder>(options_.out);
      folder_->replace(is_result_name);
    }
    progress_ = std::make_unique<Progress>(
        context_.err, context_.verbosity != Verbosity::kQuiet && standard_error_is_terminal(), "frames",
        total_frames_);
    MachineInput input;
    input.width = padded_.width;
    input.height = padded_.height;
    input.map = &rectification_.map;
    input.frames = total_frames_;
    input.timing_only = options_.timing_only;
    input.expose = [&](std::int64_t frame) {
      if (interruption.requested()) stop();
      return guarded(frame, [&] { return expose(frame); });
    };
    input.step = [&](std::int64_t frame, FrameStep step) {
      if (tracing_) tracing_->frame_step(frame, step);
      if (profile_) profile_->frame_step(frame, step);
    };
    input.deliver = [&](const FrameResult& result) {
      if (tracing_) tracing_->delivered(result.index);
      if (interruption.requested() && delivered_ + 1 < total_frames_) stop();
      guarded(delivered_, [&] { return take(result), 0; });
    };
    // Before this process simulates.
    if (options_.verdict || options_.report)
      standby_ = std::make_unique<StandbyEvaluator>(timing_input(), options_.configuration);
    const Machine machine("machine", configuration_.machine, input);
    Pace pace("pace");
    if (folder_) profile_ = std::make_unique<RunProfile>(machine, pace);
    if (options_.trace.wanted()) tracing_ = std::make_unique<Tracing>(trace_choice_, machine, pace, *folder_);
    tell_notes();
    simulate([&] { return interruption.requested(); });
    progress_.reset();
    if (failure_) std::rethrow_exception(failure_);
    if (stopping_) return interrupted(interruption.signal());
    if (tracing_) tracing_->finish();
    if (profile_) profile_->finish();
    totals_.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
    totals_.peak_megabytes = peak_memory_megabytes();
    totals_.command = context_.command_line.text();
    if (options_.left.empty() && options_.input.empty()) totals_.scene_seed = options_.scene.seed;
    if (!machine.finished()) return report_stuck(machine);
    MetricGroup metrics = measure(machine, totals_, size_.width, size_.height);
    if (!judge(machine, metrics, [&] { return interruption.requested(); })) {
      write(tree_of(metrics));
      return interrupted(interruption.signal());
    }
    report(metrics);
    return 0;
  }

 private:
  // A fault inside the simulation ends it, when the frames before `frame` are at the host; the kernel must
  // not see the exception, it would lose its line.
  template <class Action>
  auto guarded(std::int64_t frame, const Action& action) -> decltype(action()) {
    if (stopping_) return {};
    try {
      if (frame < broken_) return action();
    } catch (...) {
      failure_ = std::current_exception();
      broken_ = frame;
      if (delivered_ >= broken_) stop();
    }
    return {};
  }

  // In pieces of simulated time that take this computer some hundredths of a second, and asks in between.
  void simulate(const std::function<bool()>& interrupted) {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds kShort(10), kLong(100);
    sc_core::sc_time piece(1, sc_core::SC_MS);
    // A short piece in which nothing happens is no news.
    sc_core::sc_report_handler::set_actions(sc_core::SC_ID_NO_SC_START_ACTIVITY_, sc_core::SC_DO_NOTHING);
    do {
      const Clock::time_point began = Clock::now();
      sc_core::sc_start(piece, sc_core::SC_EXIT_ON_STARVATION);
      const Clock::duration took = Clock::now() - began;
      if (took < kShort && piece < sc_core::sc_time(1000, sc_core::SC_SEC)) piece = piece * 2;
      if (took > kLong && piece > sc_core::sc_time(1, sc_core::SC_US)) piece = piece / 2;
      if (sc_core::sc_get_status() == sc_core::SC_STOPPED) return;
      if (interrupted()) return stop();
    } while (sc_core::sc_pending_activity());
  }

  void stop() {
    if (!std::exchange(stopping_, true)) sc_core::sc_stop();
  }

  // Told when the run can begin: an error is one line.
  void note(const std::string& line) {
    if (context_.verbosity == Verbosity::kQuiet) return;
    if (running_) {
      context_.err << "parallax: note: " << line << '\n';
    } else {
      notes_.push_back(line);
    }
  }

  void tell_notes() {
    running_ = true;
    for (const std::string& line : notes_) note(line);
    notes_.clear();
  }

  StereoFrame expose(std::int64_t frame) {
    if (options_.timing_only || frame >= source_->frames()) return {};
    const StereoImages images = pad_images(source_->load(frame), granularity_);
    const auto pixels = [](const cv::Mat& image) {
      return std::make_shared<const std::vector<Gray>>(image.begin<Gray>(), image.end<Gray>());
    };
    return {pixels(images.left), pixels(images.right)};
  }

  void take(const FrameResult& result) {
    progress_->advance();
    if (!result.disparities.empty()) keep(result);
    if (++delivered_ == broken_) stop();
  }

  void keep(const FrameResult& result) {
    FrameImages frame;
    frame.disparities = crop_disparities(result.disparities, padded_.width, size_);
    ++totals_.frames;
    totals_.pixels += size_.area();
    totals_.valid += std::count_if(frame.disparities.begin(), frame.disparities.end(),
                                   [](const Disparity& d) { return d.valid(); });
    frame.truth = source_->truth(result.index);
    if (frame.truth) {
      totals_.has_truth = true;
      totals_.score += score(frame.disparities, size_.width, *frame.truth);
    }
    if (!folder_) return;
    cv::Mat left(padded_, CV_8UC1);
    std::copy(result.left.begin(), result.left.end(), left.begin<Gray>());
    frame.left = crop_image(left, size_);
    const std::string prefix = source_->frames() == 1 ? "" : fmt::format("frame_{:04}/", result.index);
    write_frame(*folder_, prefix, frame, writing_);
    if (source_->frames() == 1) return;  // a single pair's results appear together with its timing
    folder_->publish_written();
    if (!strip_) strip_ = std::make_unique<StripGif>(folder_->path() / "strip.gif", size_, writing_.colors);
    strip_->add(frame.left, {frame.disparities, size_.width, size_.height},
                sc_core::sc_time_stamp().to_seconds() * 1e3);
  }

  // The files say how far it came.
  int report_stuck(const Machine& machine) {
    const Deadlock deadlock = find_deadlock(machine);
    context_.err << "parallax: error: " << message(deadlock);
    const nlohmann::ordered_json tree =
        tree_of(measure_stuck(machine, deadlock, totals_, size_.width, size_.height));
    write(tree);
    if (options_.json) context_.out << tree.dump(2) << '\n';
    return kMachineStuck;
  }

  TimingInput timing_input() const {
    TimingInput input;
    input.width = size_.width;
    input.height = size_.height;
    input.map = &rectification_.map;
    // A run that was asked to be short is compared with short ones.
    const std::int64_t usual = frames_to_simulate(configuration_.machine, 1, std::nullopt);
    if (options_.timing_frames && *options_.timing_frames < usual)
      input.timing_frames = options_.timing_frames;
    return input;
  }

  // What limits, by taking limits away: first that of the busiest part; if it gains nothing, or all are to be
  // reported, all the others.
  // Says no when it was interrupted.
  bool judge(const Machine& machine, MetricGroup& metrics, const std::function<bool()>& interrupted) {
    if (!standby_ || metrics.number("performance/frame_rate") == 0) return true;
    const nlohmann::ordered_json base = to_json(metrics);
    const Part* const part = machine.find_part(base.at("limit").at("part").at("value"));
    std::vector<Relaxation> left = relaxations(configuration_.machine, base);
    std::vector<Relaxation> tried;
    std::vector<TimingResult> results;
    const auto try_all = [&](const std::vector<Relaxation>& wanted) {
      std::vector<std::vector<std::string>> variants;
      for (const Relaxation& relaxation : wanted) variants.push_back(relaxation.assignments);
      Progress progress(context_.err, context_.verbosity != Verbosity::kQuiet && standard_error_is_terminal(),
                        "limits", static_cast<std::int64_t>(variants.size()));
      for (TimingResult& result : standby_->evaluate(variants, interrupted, [&] { progress.advance(); }))
        results.push_back(std::move(result));
      tried.insert(tried.end(), wanted.begin(), wanted.end());
    };
    const auto first = std::find_if(left.begin(), left.end(), [part](const Relaxation& relaxation) {
      return part != nullptr && part->is_relieved_by(relaxation.limit);
    });
    if (first != left.end() && !options_.report) {
      const Relaxation relaxation = *first;
      left.erase(first);
      try_all({relaxation});
    }
    RelaxedLimits limits = relaxed_limits(base, tried, results);
    if (limits.limit() == nullptr) {
      try_all(left);
      limits = relaxed_limits(base, tried, results);
    }
    if (interrupted()) return false;
    if (options_.report) folder_->write("relaxations.json", to_json(limits).dump(2) + "\n");
    add_verdict(metrics, verdict(base, part, limits), limits);
    return true;
  }

  nlohmann::ordered_json tree_of(const MetricGroup& metrics) const {
    nlohmann::ordered_json tree = to_json(metrics);
    tree["configuration"] = to_json(configuration_, false);
    return tree;
  }

  void write(const nlohmann::ordered_json& tree) {
    if (!folder_) return;
    if (profile_) folder_->write("profile.json", profile_->to_json().dump() + "\n");
    folder_->write("timing.json", tree.dump(2) + "\n");
    if (strip_) strip_->complete();
    folder_->publish();
    if (strip_) strip_->publish();
    if (!options_.report) return;
    folder_->write("report.html", report_of(folder_->path()));
    folder_->publish();
  }

  void report(const MetricGroup& metrics) {
    const nlohmann::ordered_json tree = tree_of(metrics);
    write(tree);
    if (options_.json) {
      context_.out << tree.dump(2) << '\n';
    } else if (context_.verbosity != Verbosity::kQuiet) {
      context_.out << summary(metrics);
      if (context_.verbosity == Verbosity::kVerbose) context_.out << stage_summary(metrics);
      if (folder_) context_.out << fmt::format("results             {}\n", options_.out.string());
      if (options_.report)
        context_.out << fmt::format("report              {}\n", (options_.out / "report.html").string());
    }
  }

  int interrupted(int signal) {
    context_.err << fmt::format("parallax: interrupted after {} frame{}\n", totals_.frames,
                                totals_.frames == 1 ? "" : "s");
    return kSignalled + signal;
  }

  bool running_ = false;
  std::vector<std::string> notes_;
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  const RunOptions& options_;
  CommandContext& context_;
  const Configuration configuration_;
  const NoticeSink notice_;
  const std::unique_ptr<FrameSource> source_;
  const Granularity granularity_;
  const cv::Size size_;
  const cv::Size padded_;
  const RectificationChoice rectification_;
  const std::int64_t total_frames_;
  std::unique_ptr<OutputFolder> folder_;
  std::unique_ptr<StripGif> strip_;  ///< of a sequence
  const TraceChoice trace_choice_;
  const FrameResultOptions writing_;
  std::unique_ptr<Tracing> tracing_;
  std::unique_ptr<RunProfile> profile_;
  std::unique_ptr<StandbyEvaluator> standby_;
  std::unique_ptr<Progress> progress_;
  RunTotals totals_;
  std::int64_t delivered_ = 0;
  std::int64_t broken_ = std::numeric_limits<std::int64_t>::max();  // the frame at which the run fails
  std::exception_ptr failure_;
  bool stopping_ = false;
};

}  // namespace

int run(const RunOptions& options, CommandContext& context) {
  check_options(options);
  if (options.relax) return relax(options, context);
  return options.vary.empty() ? Run(options, context).execute() : vary(options, context);
}

}  // namespace parallax
