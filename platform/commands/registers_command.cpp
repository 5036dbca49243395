// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/registers_command.hpp"

#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "platform/commands/command_context.hpp"
#include "platform/registers/register_map.hpp"

namespace parallax {
namespace {

struct RegistersOptions {
  bool markdown = false;
  bool header = false;
};

}  // namespace

void add_registers_command(CLI::App& app, CommandContext& context) {
  const auto options = std::make_shared<RegistersOptions>();
  CLI::App& command = *app.add_subcommand("registers", "Print the core's control registers");
  CLI::Option* markdown = command.add_flag("--markdown", options->markdown, "As tables in Markdown");
  command.add_flag("--header", options->header, "As a C header of offsets, shifts and masks")
      ->excludes(markdown);
  command.callback([options, &context] {
    context.action = [options, &context] {
      context.out << (options->markdown ? registers_as_markdown()
                      : options->header ? registers_as_header()
                                        : registers_as_text());
      return 0;
    };
  });
}

}  // namespace parallax
