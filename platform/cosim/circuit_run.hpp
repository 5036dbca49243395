// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "platform/cosim/circuit_library.hpp"
#include "platform/cosim/circuit_pins.hpp"
#include "platform/cosim/circuit_stage.hpp"
#include "platform/cosim/stage_record.hpp"
#include "platform/cosim/token_comparison.hpp"
#include "platform/input/circuit_options.hpp"
#include "platform/machine/machine_input.hpp"

namespace parallax {

/// A circuit in a run of the machine, in the place of a stage, beside what the model's stage did there.
class CircuitRun {
 public:
  /// Builds the circuit if it is given as Verilog, loads it, and runs the model (record_stage) on the first
  /// `frames` frames, those with images; `model` brings them. Throws UserError, as these do.
  CircuitRun(const CircuitOptions& options, const MachineConfig& config, const MachineInput& model,
             const std::function<bool()>& interrupted);
  ~CircuitRun();

  /// For the machine that it is to stand in, which it must outlive; `stop` ends the simulation.
  StageReplacements replacements(const std::function<void()>& stop);

  /// After the simulation, once.
  void conclude();
  /// Whether it did as the model does: values, handshake, and the bound on its dates if there is one.
  bool as_model() const { return as_model_; }
  /// Why it was given up; empty: it was not.
  const std::string& fault() const;
  std::string text() const;
  nlohmann::ordered_json json() const;

 private:
  struct Timing {  // of an output stream, in cycles
    std::string stream;
    std::vector<std::int64_t> circuit, model;  ///< from its first frame's first token to each one's last
    std::int64_t latest = 0;                   ///< most that a token is behind the model's
    std::uint64_t latest_token = 0;
  };

  const CircuitOptions& options_;
  const std::int64_t frames_;
  std::string stage_name_;
  std::unique_ptr<Circuit> circuit_;
  StageRecord model_;
  CircuitPins pins_;
  CircuitStage* stage_ = nullptr;  // belongs to the machine
  std::vector<TokenComparison> comparisons_;
  std::vector<Timing> timings_;
  bool as_model_ = false;
};

}  // namespace parallax
