// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "platform/config/stream_config.hpp"
#include "platform/cosim/circuit_library.hpp"
#include "platform/cosim/circuit_outcome.hpp"
#include "platform/cosim/circuit_pins.hpp"
#include "platform/cosim/circuit_stage.hpp"
#include "platform/cosim/stage_record.hpp"
#include "platform/input/circuit_options.hpp"
#include "platform/machine/machine_input.hpp"

namespace parallax {

/// Circuits in a run of the machine, each in the place of a stage, beside what the model's stage did on the
/// same tokens.
///
/// Of several, each stands behind the real output of those before it, which is recorded first: in a machine
/// with the circuits upstream and the model's stage in its own place. That machine says what the model does
/// on these tokens, and what a token's value is that the circuit reads before the stages between have it, as
/// these work on whole rows.
///
/// As shadows, each runs in a machine of its own in which all else is the model; nothing of theirs is in the
/// run.
class CircuitRun {
 public:
  /// Builds circuits that are given as Verilog, loads them, and runs the model (record_stages) on the
  /// `model.frames` frames with images, after a look at the stages (check_stages). Throws UserError, as these
  /// do, and for two circuits of one stage. When `interrupted` said yes, nothing else may be called.
  /// `keeps_waves`: files() are wanted.
  CircuitRun(const std::vector<CircuitOptions>& circuits, bool shadow, bool keeps_waves,
             const MachineConfig& config, const MachineInput& model,
             const std::function<bool()>& interrupted);
  ~CircuitRun();

  /// For the machine that they are to stand in, which they must outlive; `stop` ends the simulation.
  StageReplacements replacements(const std::function<void()>& stop);

  /// After the simulation, once.
  void conclude();
  /// Whether all did as the model does.
  bool as_model() const;
  /// Which one was given up, and why; empty: none was.
  std::string fault() const;
  std::string text() const;
  nlohmann::ordered_json json() const;  ///< an array, upstream first
  /// What shows where they differ.
  std::vector<CircuitOutcome::File> files() const;

 private:
  struct Placed {
    const CircuitOptions* options;
    std::string stage;
    std::unique_ptr<Circuit> circuit;
    StageRecord model;
    CircuitPins pins;
    CircuitStage* module = nullptr;  // belongs to the machine
  };

  std::vector<std::string> stages() const;
  void record(const MachineConfig& config, const MachineInput& model,
              const std::function<bool()>& interrupted);
  void check_ready_paths(const StreamConfig& streams) const;
  void run_shadows(const MachineConfig& config, const MachineInput& model,
                   const std::function<bool()>& interrupted);
  StageReplacements replacements(std::size_t begin, std::size_t end, const std::function<void()>& stop);
  static CircuitOutcome outcome(const Placed& placed);

  const bool shadow_;
  const bool keeps_waves_;
  std::vector<Placed> circuits_;  // upstream first
  std::size_t in_place_ = 0;      // of these, behind none that was given up before
  std::vector<CircuitOutcome> outcomes_;
};

}  // namespace parallax
