// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "platform/config/machine_config.hpp"

namespace parallax {

/// One limit of a machine taken away, as configuration keys.
struct Relaxation {
  std::string name;
  std::string meaning;                   ///< a few words
  std::string remedy;                    ///< the same in a sentence: "... gives 143 fps"
  std::vector<std::string> assignments;  ///< "key=value"
};

/// Whether a relaxation makes a part faster (PartLoad::part).
bool relieves(const Relaxation& relaxation, const std::string& part);

/// All that make sense for a machine: those that would change nothing are left out. `metrics` is its timing
/// (timing.json), for the depths that its FIFOs have.
std::vector<Relaxation> relaxations(const MachineConfig& config, const nlohmann::ordered_json& metrics);

}  // namespace parallax
