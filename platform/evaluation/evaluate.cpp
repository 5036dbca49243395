// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/evaluate.hpp"

#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <new>

#include "platform/evaluation/worker_process.hpp"
#include "platform/input/image_padding.hpp"
#include "platform/machine/machine.hpp"
#include "platform/machine/simulated_time.hpp"
#include "platform/machine/steady_state.hpp"
#include "platform/results/deadlock_report.hpp"
#include "platform/results/peak_memory.hpp"
#include "platform/results/rate_metrics.hpp"
#include "platform/results/run_metrics.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

using Status = EvaluationResult::Status;
using State = WorkerProcess::State;

constexpr double kNoPhase = 1e-4;  // of a frame: more than the phases of the memory change it

// Picoseconds that the core took for a frame whose results are in memory; 0 where it may have waited for it.
double taken(const Machine& machine, std::int64_t frame) {
  const FrameTimes& times = machine.times()[frame];
  const SoftwareConfig& software = machine.config().software;
  if (!software.queue_frames) {  // the next one cannot be started before the software has responded
    const double response = 1e3 * static_cast<double>(software.response_ns);
    return (times.results_in_memory - times.core_started).to_seconds() * 1e12 + response;
  }
  if (frame == 0) return 0;
  const sc_core::sc_time& before = machine.times()[frame - 1].results_in_memory;
  return times.in_memory > before ? 0 : (times.results_in_memory - before).to_seconds() * 1e12;
}

// In the process that is for this simulation.
EvaluationResult simulate(const MachineConfig& config, const EvaluationInput& input) {
  const auto began = std::chrono::steady_clock::now();
  sc_core::sc_report_handler::set_actions(sc_core::SC_INFO, sc_core::SC_DO_NOTHING);
  // A piece of time in which nothing happens is no news.
  sc_core::sc_report_handler::set_actions(sc_core::SC_ID_NO_SC_START_ACTIVITY_, sc_core::SC_DO_NOTHING);
  MachineInput machine_input;
  machine_input.width = input.map->width;
  machine_input.height = input.map->height;
  machine_input.map = input.map;
  const RunLength length = run_length(config, input.frames, input.timing_frames);
  machine_input.frames = length.most;
  machine_input.least_frames = length.least;
  machine_input.enough = frames_are_enough;
  machine_input.timing_only = true;
  const Machine* made = nullptr;
  bool too_slow = false;
  machine_input.step = [&](std::int64_t frame, FrameStep step) {
    if (input.longest_frame_ps == 0 || step != FrameStep::kResultsInMemory || too_slow) return;
    too_slow = taken(*made, frame) > (1 + kNoPhase) * static_cast<double>(input.longest_frame_ps);
    if (too_slow) sc_core::sc_stop();
  };
  const Machine machine("machine", config, machine_input);
  made = &machine;
  shortest_frame_time(machine);
  do {
    simulate_for(sc_core::sc_time(1000, sc_core::SC_SEC));
  } while (sc_core::sc_get_status() != sc_core::SC_STOPPED && sc_core::sc_pending_activity());
  if (too_slow) return not_measured(Status::kTooSlow, "a frame takes the core longer");
  if (!machine.finished()) return not_measured(Status::kStuck, message(find_deadlock(machine)));
  RunTotals totals;
  totals.command = input.command;
  totals.scene_seed = input.scene_seed;
  totals.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  totals.peak_megabytes = peak_memory_megabytes();
  return measured(measure(machine, totals, input.width, input.height));
}

// What that process says, whatever happens.
std::string simulate_to_bytes(const MachineConfig& config, const EvaluationInput& input) {
  EvaluationResult result;
  try {
    result = simulate(config, input);
  } catch (const UserError& error) {
    result = not_measured(Status::kInvalid, error.what());
  } catch (const sc_core::sc_report& report) {
    result = not_measured(Status::kFailed, fmt::format("{}: {}", report.get_msg_type(), report.get_msg()));
  } catch (const std::bad_alloc&) {
    result = not_measured(Status::kFailed, "out of memory");
  } catch (const std::exception& error) {
    result = not_measured(Status::kFailed, error.what());
  }
  return to_bytes(result);
}

// Whether the map is one for this machine.
void check_map(const MachineConfig& config, const EvaluationInput& input) {
  const EncodedMap& map = *input.map;
  const cv::Size processed = padded_size({input.width, input.height}, config.image.granularity());
  if (processed.width != map.width || processed.height != map.height) {
    throw UserError(fmt::format("images of {}x{} are processed as {}x{}, but the map has {}x{}", input.width,
                                input.height, processed.width, processed.height, map.width, map.height));
  }
  if (!(map.range == config.rectification.range)) {
    throw UserError(fmt::format(
        "rectification.window is {} and rectification.fraction_bits {}, but the map has {} and {}",
        config.rectification.range.window, config.rectification.range.fraction_bits, map.range.window,
        map.range.fraction_bits));
  }
}

}  // namespace

EvaluationResult evaluate(const MachineConfig& config, const EvaluationInput& input,
                          const std::function<bool()>& interrupted) {
  try {
    config.validate();
    check_map(config, input);
    WorkerProcess process([&](const std::string&) { return simulate_to_bytes(config, input); });
    process.ask({});
    while (process.state() == State::kWorking) {
      if (interrupted()) return not_measured(Status::kInterrupted, "interrupted");
      process.receive(WorkerProcess::kPollMilliseconds);
    }
    if (process.state() == State::kAnswered) return evaluation_result(process.take_answer());
    // A signal from the terminal reaches both: this process has noted it, the other has ended.
    if (interrupted()) return not_measured(Status::kInterrupted, "interrupted");
    return without_result(process.signal());
  } catch (const UserError& error) {
    return not_measured(Status::kInvalid, error.what());
  } catch (const std::exception& error) {
    return not_measured(Status::kFailed, error.what());
  }
}

}  // namespace parallax
