// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/common_options.hpp"

#include <CLI/CLI.hpp>

namespace parallax {

void add_configuration_options(CLI::App& command, ConfigurationRequest& request) {
  command.add_option("-p,--preset", request.preset, "Preset: a name or the path of a .toml file")
      ->type_name("NAME")
      ->capture_default_str();
  command
      .add_option("-s,--set", request.assignments,
                  "Set a configuration key; may be repeated, the last one wins")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command
      .add_option("-d,--disparities", request.disparity_range,
                  "Disparity range: sets matching.iterations to this divided by matching.parallelism")
      ->type_name("COUNT");
}

void add_seed_option(CLI::App& command, std::uint64_t& seed, const std::string& description) {
  // CLI11 would take -1 for the largest number.
  constexpr std::size_t kMostDigits = 18;
  const CLI::Validator whole(
      [](const std::string& text) {
        const bool digits = text.find_first_not_of("0123456789") == std::string::npos;
        if (digits && text.size() <= kMostDigits) return std::string();
        return "'" + text + "' is not a whole number of at most 18 digits";
      },
      "");
  command.add_option("--seed", seed, description)->check(whole)->capture_default_str();
}

void refuse_empty_values(CLI::App& app) {
  const CLI::Validator not_empty(
      [](const std::string& value) { return std::string(value.empty() ? "the value is empty" : ""); }, "");
  for (CLI::Option* option : app.get_options()) {
    // Before an option's own checks, which would call it a number out of range.
    if (option->get_items_expected_max() > 0) option->transform(not_empty);
  }
  // All of them, groups of options too.
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    refuse_empty_values(*command);
}

void add_json_option(CLI::App& command, bool& json) { command.add_flag("--json", json, "Print JSON"); }

}  // namespace parallax
