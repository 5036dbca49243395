// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace parallax {

struct CommandContext;

/// parallax fifos: the smallest depths of the pipeline's FIFOs.
void add_fifos_command(CLI::App& app, CommandContext& context);

}  // namespace parallax
