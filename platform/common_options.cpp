// SPDX-License-Identifier: Apache-2.0
#include "platform/common_options.hpp"

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

void add_json_option(CLI::App& command, bool& json) { command.add_flag("--json", json, "Print JSON"); }

}  // namespace parallax
