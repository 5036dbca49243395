// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace parallax {

struct CommandContext;

/// `parallax estimate`: what the machine takes of an FPGA, and whether it fits a device.
void add_estimate_command(CLI::App& app, CommandContext& context);

}  // namespace parallax
