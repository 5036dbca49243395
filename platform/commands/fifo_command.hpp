// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace parallax {

struct CommandContext;

/// parallax fifo: how a FIFO in a simulator is described as a stream.
void add_fifo_command(CLI::App& app, CommandContext& context);

}  // namespace parallax
