// SPDX-License-Identifier: Apache-2.0
// Options that several commands share, with one wording and one meaning.
#pragma once

#include "platform/configuration.hpp"

namespace CLI {
class App;
}

namespace parallax {

/// --preset, --set, --disparities: the configuration of the machine.
void add_configuration_options(CLI::App& command, ConfigurationRequest& request);

/// --json: machine-readable output.
void add_json_option(CLI::App& command, bool& json);

}  // namespace parallax
