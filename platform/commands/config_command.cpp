// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/config_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "platform/commands/command_context.hpp"
#include "platform/commands/common_options.hpp"
#include "platform/config/config_writer.hpp"
#include "platform/config/preset.hpp"
#include "platform/registers/run_time_parameters.hpp"
#include "traces/json_text.hpp"

namespace parallax {
namespace {

struct ConfigOptions {
  ConfigurationRequest request;
  bool documented = false;
  bool json = false;
  bool list = false;
};

void print_presets(const ConfigOptions& options, std::ostream& out) {
  const auto presets = list_presets(preset_folders());
  if (options.json) {
    auto tree = nlohmann::ordered_json::object();
    for (const PresetSummary& preset : presets) tree[preset.name] = preset.description;
    out << json_text(tree, 2) << '\n';
    return;
  }
  std::size_t width = 0;
  for (const PresetSummary& preset : presets) width = std::max(width, preset.name.size());
  for (const PresetSummary& preset : presets) {
    out << fmt::format("{:<{}}  {}\n", preset.name, width, preset.description);
  }
}

int run_config(const ConfigOptions& options, std::ostream& out) {
  if (options.list) {
    print_presets(options, out);
    return 0;
  }
  Configuration configuration = load_configuration(options.request, preset_folders());
  add_run_time_remarks(configuration.keys);
  if (options.json) {
    out << json_text(to_json(configuration, options.documented), 2) << '\n';
  } else {
    out << to_toml(configuration, options.documented);
  }
  return 0;
}

}  // namespace

void add_config_command(CLI::App& app, CommandContext& context) {
  const auto options = std::make_shared<ConfigOptions>();
  CLI::App& command =
      *app.add_subcommand("config", "Print the effective configuration, as a preset that can be read back");
  add_configuration_options(command, options->request);
  add_json_option(command, options->json);
  command.add_flag("--docs", options->documented,
                   "With documentation, allowed values, tag and source of every key");
  command.add_flag("--list", options->list, "Print the presets there are");
  command.callback([options, &context] {
    context.action = [options, &context] { return run_config(*options, context.out); };
  });
}

}  // namespace parallax
