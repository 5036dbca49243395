// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/estimate_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>

#include "platform/commands/command_context.hpp"
#include "platform/commands/common_options.hpp"
#include "platform/commands/exit_codes.hpp"
#include "platform/config/preset.hpp"
#include "platform/estimate/estimate_metrics.hpp"
#include "platform/estimate/estimate_text.hpp"
#include "tlm/error.hpp"
#include "traces/json_text.hpp"

namespace parallax {
namespace {

constexpr const char* kFamily = "7-series";  // where no device is named

struct EstimateOptions {
  ConfigurationRequest request;
  std::string size;
  std::string device;
  bool json = false;
};

EstimateSize size_of(const std::string& text) {
  EstimateSize size;
  if (text.empty()) return size;
  constexpr int kMost = 65536;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%5dx%5d%c", &size.width, &size.height, &rest) != 2 || size.width < 1 ||
      size.height < 1 || size.width > kMost || size.height > kMost) {
    throw UserError(fmt::format("--size is '{}', expected width x height such as 640x480", excerpt(text)));
  }
  return size;
}

int estimate_for_device(const EstimateOptions& options, const MachineConfig& machine,
                        CommandContext& context) {
  const DeviceFile device = load_device(options.device, preset_folders());
  const ResourceEstimate result = estimate(machine, device, size_of(options.size));
  if (options.json) {
    MetricGroup tree;
    add_resources(tree, result, device);
    add_device(tree, result, device);
    context.out << json_text(to_json(tree), 2) << '\n';
  } else if (context.verbosity != Verbosity::kQuiet) {
    context.out << estimate_as_text(result, device) << device_as_text(result, device)
                << deep_fifos_as_text(result, device);
  }
  return fits(device_shares(result.total, device)) ? 0 : kNotAsExpected;
}

int estimate_for_family(const EstimateOptions& options, const MachineConfig& machine,
                        CommandContext& context) {
  const DeviceFile family = load_family(kFamily, preset_folders());
  const EstimateSize size = size_of(options.size);
  const ResourceEstimate result = estimate(machine, family, size);
  MetricGroup tree;
  add_resources(tree, result, family);
  std::string lines;
  for (const std::string& name : device_names(preset_folders())) {
    const DeviceFile device = load_device(name, preset_folders());
    const ResourceEstimate in_device = estimate(machine, device, size);
    add_device(tree, in_device, device);
    lines += device_as_line(in_device, device);
  }
  if (options.json) {
    context.out << json_text(to_json(tree), 2) << '\n';
  } else if (context.verbosity != Verbosity::kQuiet) {
    context.out << estimate_as_text(result, family) << "fits\n"
                << lines << deep_fifos_as_text(result, family);
  }
  return 0;
}

}  // namespace

void add_estimate_command(CLI::App& app, CommandContext& context) {
  const auto options = std::make_shared<EstimateOptions>();
  CLI::App& command =
      *app.add_subcommand("estimate", "Estimate what the machine takes of an FPGA, and whether it fits");
  add_configuration_options(command, options->request);
  command.add_option("--size", options->size,
                     "Size of the images that the machine is built for; the largest it takes if not given");
  command.add_option("--device", options->device,
                     "Device: a name such as zynq-7020, or a file; all that there are if not given");
  add_json_option(command, options->json);
  command.callback([options, &context] {
    context.action = [options, &context] {
      const Configuration configuration = load_configuration(options->request, preset_folders());
      return options->device.empty() ? estimate_for_family(*options, configuration.machine, context)
                                     : estimate_for_device(*options, configuration.machine, context);
    };
  });
}

}  // namespace parallax
