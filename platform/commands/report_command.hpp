// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace parallax {

struct CommandContext;

/// parallax report: a page of HTML from the folder of a run's results.
void add_report_command(CLI::App& app, CommandContext& context);

}  // namespace parallax
