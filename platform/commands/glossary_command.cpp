// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/glossary_command.hpp"

#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "platform/commands/command_context.hpp"
#include "platform/results/glossary.hpp"
#include "traces/json_text.hpp"

namespace parallax {
namespace {

struct GlossaryOptions {
  bool markdown = false;
  bool json = false;
};

}  // namespace

void add_glossary_command(CLI::App& app, CommandContext& context) {
  const auto options = std::make_shared<GlossaryOptions>();
  CLI::App& command =
      *app.add_subcommand("glossary", "Print what every number of a run means, its unit and its window");
  CLI::Option* markdown = command.add_flag("--markdown", options->markdown, "As tables in Markdown");
  command.add_flag("--json", options->json, "As JSON")->excludes(markdown);
  command.callback([options, &context] {
    context.action = [options, &context] {
      context.out << (options->markdown ? glossary_as_markdown()
                      : options->json   ? json_text(glossary_as_json(), 2) + "\n"
                                        : glossary_as_text());
      return 0;
    };
  });
}

}  // namespace parallax
