// SPDX-License-Identifier: Apache-2.0
// Options that several commands share, with one wording and one meaning.
#pragma once

#include <cstdint>
#include <string>

#include "platform/config/configuration.hpp"

namespace CLI {
class App;
}

namespace parallax {

/// What --cameras is for.
constexpr const char* kCamerasHelp =
    "Left and right camera of a calibration with several (KITTI: 0,1 grey, 2,3 colour; Kalibr): 0,1 if not "
    "given";

/// --preset, --set, --disparities: the configuration of the machine.
void add_configuration_options(CLI::App& command, ConfigurationRequest& request);

/// --seed of the built-in scene, a whole number of at most 18 digits.
void add_seed_option(CLI::App& command, std::uint64_t& seed, const std::string& description);

/// Every option of every command, and every argument, takes no empty value: a script's unset variable must
/// not turn into another run than the one that was meant. For a line whose commands are all there.
void refuse_empty_values(CLI::App& app);

/// --json: machine-readable output.
void add_json_option(CLI::App& command, bool& json);

}  // namespace parallax
