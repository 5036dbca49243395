// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace parallax {

struct CommandContext;

/// `parallax memory`: replays an address trace against the DRAM model alone (tlm/dram_replay.hpp).
void add_memory_command(CLI::App& app, CommandContext& context);

}  // namespace parallax
