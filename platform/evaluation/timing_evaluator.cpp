// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/timing_evaluator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <exception>
#include <new>
#include <utility>

#include "platform/evaluation/forked_call.hpp"
#include "platform/input/image_padding.hpp"
#include "platform/machine/machine.hpp"
#include "platform/machine/steady_state.hpp"
#include "platform/results/deadlock_report.hpp"
#include "platform/results/peak_memory.hpp"
#include "platform/results/run_metrics.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

using Status = TimingResult::Status;

constexpr Status kStatuses[] = {Status::kDone, Status::kInvalid, Status::kStuck, Status::kFailed,
                                Status::kInterrupted};

TimingResult simulate(const TimingInput& input, const MachineConfig& config) {
  const auto began = std::chrono::steady_clock::now();
  sc_core::sc_report_handler::set_actions(sc_core::SC_INFO, sc_core::SC_DO_NOTHING);
  MachineInput machine_input;
  machine_input.width = input.map->width;
  machine_input.height = input.map->height;
  machine_input.map = input.map;
  machine_input.frames = frames_to_simulate(config, input.frames, input.timing_frames);
  machine_input.timing_only = true;
  const Machine machine("machine", config, machine_input);
  sc_core::sc_start();
  TimingResult result;
  if (!machine.finished()) {
    result.status = Status::kStuck;
    result.message = message(find_deadlock(machine));
    return result;
  }
  RunTotals totals;
  totals.command = input.command;
  totals.scene_seed = input.scene_seed;
  totals.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  totals.peak_megabytes = peak_memory_megabytes();
  result.status = Status::kDone;
  result.metrics = to_json(measure(machine, totals, input.width, input.height));
  return result;
}

TimingResult failure(Status status, std::string message) { return {status, nullptr, std::move(message)}; }

// What the child says, whatever happens.
std::string simulate_to_text(const TimingInput& input, const MachineConfig& config) {
  TimingResult result;
  try {
    result = simulate(input, config);
  } catch (const UserError& error) {
    result = failure(Status::kInvalid, error.what());
  } catch (const sc_core::sc_report& report) {
    result = failure(Status::kFailed, fmt::format("{}: {}", report.get_msg_type(), report.get_msg()));
  } catch (const std::bad_alloc&) {
    result = failure(Status::kFailed, "out of memory");
  } catch (const std::exception& error) {
    result = failure(Status::kFailed, error.what());
  }
  return to_json(result).dump();
}

TimingResult read(const ForkedCall& call) {
  if (call.interrupted) return failure(Status::kInterrupted, "interrupted");
  if (call.signal != 0) {
    return failure(Status::kFailed, fmt::format("the simulation was ended by signal {} ({})", call.signal,
                                                ::strsignal(call.signal)));
  }
  return timing_result(nlohmann::ordered_json::parse(call.output, nullptr, false));
}

// Whether the map is one for this machine.
void check_map(const TimingInput& input, const MachineConfig& config) {
  const EncodedMap& map = *input.map;
  const cv::Size processed = padded_size(
      {input.width, input.height},
      {static_cast<int>(config.image.width_granularity), static_cast<int>(config.image.height_granularity)});
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

const char* name(TimingResult::Status status) {
  switch (status) {
    case Status::kDone:
      return "done";
    case Status::kInvalid:
      return "invalid";
    case Status::kStuck:
      return "stuck";
    case Status::kFailed:
      return "failed";
    case Status::kInterrupted:
      return "interrupted";
  }
  return "";
}

nlohmann::ordered_json to_json(const TimingResult& result) {
  return {{"status", name(result.status)}, {"message", result.message}, {"metrics", result.metrics}};
}

TimingResult timing_result(const nlohmann::ordered_json& tree) {
  if (!tree.is_object() || !tree.contains("status")) {
    return failure(Status::kFailed, "the simulation ended without a result");
  }
  const std::string word = tree.at("status");
  const auto* const status =
      std::find_if(std::begin(kStatuses), std::end(kStatuses), [&](Status s) { return word == name(s); });
  return {*status, tree.at("metrics"), tree.at("message")};
}

std::string TimingResult::advice() const {
  std::string line = message;
  while (!line.empty() && line.back() == '\n') line.pop_back();
  line.erase(0, line.rfind('\n') + 1);
  return line.erase(0, line.find_first_not_of(' '));
}

TimingEvaluator::TimingEvaluator(TimingInput input, std::function<bool()> interrupted)
    : input_(std::move(input)), interrupted_(std::move(interrupted)) {}

TimingResult TimingEvaluator::evaluate(const MachineConfig& config) const {
  try {
    config.validate();
    check_map(input_, config);
    return read(call_in_fork([&] { return simulate_to_text(input_, config); }, interrupted_));
  } catch (const UserError& error) {
    return failure(Status::kInvalid, error.what());
  } catch (const std::exception& error) {
    return failure(Status::kFailed, error.what());
  }
}

}  // namespace parallax
