// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "platform/cosim/circuit_stage.hpp"
#include "platform/cosim/stage_record.hpp"
#include "platform/input/circuit_options.hpp"

namespace parallax {

/// What a run says of a circuit beside what the model's stage did.
struct CircuitOutcome {
  std::string text;
  nlohmann::ordered_json json;
  /// Whether it did as the model does: values, handshake, and the bound on its dates if there is one.
  bool as_model = false;
  std::string fault;  ///< why it was given up; empty: it was not
  /// What shows where it differs: waves, if they were kept, and an image of each output that does.
  struct File {
    std::string name;
    std::string content;
  };
  std::vector<File> files{};
};

/// After the simulation. `module`: what it is called. `model`: what the model's stage did on the same tokens.
CircuitOutcome circuit_outcome(const std::string& module, const CircuitStage& circuit,
                               const StageRecord& model, const CircuitOptions& options);

}  // namespace parallax
