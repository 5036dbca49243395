// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace parallax {

struct CommandContext;

/// `parallax explore`.
void add_explore_command(CLI::App& app, CommandContext& context);

void add_merge_command(CLI::App& app, CommandContext& context);

}  // namespace parallax
