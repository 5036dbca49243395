// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace parallax {

struct CommandContext;

/// `parallax map encode`, `map decode` and `map info`.
void add_map_command(CLI::App& app, CommandContext& context);

}  // namespace parallax
