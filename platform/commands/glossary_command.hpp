// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace parallax {

struct CommandContext;

/// `parallax glossary`: what every number of a run means, as text, Markdown or JSON.
void add_glossary_command(CLI::App& app, CommandContext& context);

}  // namespace parallax
