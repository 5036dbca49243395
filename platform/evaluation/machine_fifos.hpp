// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "platform/evaluation/evaluate.hpp"

namespace parallax {

/// A FIFO of the pipeline, between two stages. Those of DMA engines, which hold bursts, are none.
struct MachineFifo {
  std::string stream;
  std::string kind;                ///< of circuit: "registered"
  std::int64_t width = 0;          ///< bits of a token
  std::int64_t depth = 0;          ///< tokens, as configured
  std::int64_t automatic = 0;      ///< tokens, as the model derives it: streams.<stream>.depth = 0
  std::int64_t write_to_read = 0;  ///< edges until a token can be read
  std::int64_t read_to_write = 0;  ///< edges until its slot can be written
  /// With these depths of all FIFOs no stage waits for ever, by the numbers of tokens alone
  /// (smallest_remedy()); 1 for all where these do not tell.
  std::int64_t deadlock_free = 1;

  std::string key() const { return "streams." + stream + ".depth"; }
};

/// Upstream to downstream. The machine is made, but not simulated, in processes of its own; nothing when
/// `interrupted` said yes. Throws UserError for what is not possible.
std::optional<std::vector<MachineFifo>> machine_fifos(const MachineConfig& config,
                                                      const EvaluationInput& input,
                                                      const std::function<bool()>& interrupted);

}  // namespace parallax
