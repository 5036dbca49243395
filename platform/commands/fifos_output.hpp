// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "platform/config/configuration.hpp"
#include "platform/evaluation/fifo_sizing.hpp"

namespace parallax {

/// "100.26 fps, at which the host limits": what a sizing was for, in words.
std::string goal_text(const FifoSizing& sizing);

/// The table for a reader. `frames`: of each run.
std::string to_text(const FifoSizing& sizing, std::int64_t frames);

/// What fifos.json holds.
nlohmann::ordered_json to_json(const FifoSizing& sizing, std::int64_t frames, const std::string& command);

/// A preset: the machine as it was configured, on top of the preset that it came from, with the depths found.
/// `command` found them.
std::string depths_preset(const FifoSizing& sizing, const Configuration& configuration,
                          const std::string& command);

}  // namespace parallax
