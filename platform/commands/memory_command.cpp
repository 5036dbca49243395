// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/memory_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "platform/commands/command_context.hpp"
#include "platform/commands/notes.hpp"
#include "platform/config/dram_device.hpp"
#include "platform/config/preset.hpp"
#include "platform/input/address_trace.hpp"
#include "platform/results/replay_metrics.hpp"
#include "tlm/dram_replay.hpp"
#include "tlm/error.hpp"
#include "traces/json_text.hpp"
#include "traces/metric_text.hpp"
#include "traces/metrics.hpp"

namespace parallax {
namespace {

struct MemoryOptions {
  std::string trace;
  std::string config;
  std::string mapping = "rbc";
  std::int64_t window = 16;
  std::int64_t efficiency = 100;
  std::optional<std::int64_t> request_bytes;
  std::optional<double> trace_mhz;
  bool no_refresh = false;
  bool json = false;
};

const std::map<std::string, DramMapping>& mappings() {
  static const std::map<std::string, DramMapping> all{{"rbc", DramMapping::kRowBankColumn},
                                                      {"brc", DramMapping::kBankRowColumn},
                                                      {"rbcg", DramMapping::kRowBankColumnGroup}};
  return all;
}

std::string text(const MetricGroup& group) {
  std::string lines;
  for (const Metric& metric : group.metrics) {
    lines += fmt::format("{:16} {:>14}{}{}\n", metric.name, value_text(metric),
                         metric.unit.empty() ? "" : " ", metric.unit);
  }
  return lines;
}

int replay_trace(const MemoryOptions& options, CommandContext& context) {
  const auto within = [](const char* option, std::int64_t value, std::int64_t least, std::int64_t most) {
    if (value < least || value > most) {
      throw UserError(fmt::format("{} is {}, allowed is {} to {}", option, value, least, most));
    }
  };
  within("--window", options.window, 1, 1'000'000);
  within("--efficiency", options.efficiency, 1, 100);
  within("--request-bytes", options.request_bytes.value_or(1), 1, 1 << 20);
  if (options.trace_mhz && !(*options.trace_mhz >= 0.001 && *options.trace_mhz <= 1e6))
    throw UserError(fmt::format("--trace-mhz is {:g}, allowed is 0.001 to 1000000", *options.trace_mhz));
  const auto mapping = mappings().find(options.mapping);
  if (mapping == mappings().end()) {
    throw UserError(fmt::format("--mapping is '{}', expected rbc, brc or rbcg", excerpt(options.mapping)));
  }
  DramTiming timing = load_dram_device(options.config, preset_folders());
  if (options.no_refresh) timing.refi = 0;
  DramPolicy policy;
  policy.efficiency = options.efficiency;
  TraceReading reading;
  reading.cycle_ns = static_cast<double>(timing.clock_period_ps) / 1000;
  reading.mhz = options.trace_mhz;
  if (options.request_bytes) reading.bytes = *options.request_bytes;
  Notes notes(context);
  const std::vector<TraceRequest> trace =
      read_address_trace(options.trace, reading, [&](const std::string& line) { notes(line); });
  const auto beyond = std::count_if(trace.begin(), trace.end(), [&](const TraceRequest& request) {
    return request.address + request.bytes > static_cast<std::uint64_t>(timing.bytes());
  });
  if (beyond > 0) {
    notes(fmt::format("{} of {} requests reach beyond the devices' {} bytes and begin anew there", beyond,
                      trace.size(), timing.bytes()));
  }
  const ReplayResult result = replay(trace, timing, policy, mapping->second, options.window);
  const MetricGroup metrics = measure(result, timing);
  if (options.json) {
    context.out << json_text(to_json(metrics), 2) << '\n';
  } else if (context.verbosity != Verbosity::kQuiet) {
    context.out << text(metrics);
  }
  return 0;
}

}  // namespace

void add_memory_command(CLI::App& app, CommandContext& context) {
  const auto options = std::make_shared<MemoryOptions>();
  CLI::App& command = *app.add_subcommand("memory", "Replay an address trace against the DRAM model alone");
  command
      .add_option("trace", options->trace,
                  "CSV (time_ns,rw,addr,bytes), or a trace of Ramulator, DRAMsim3 or DRAMSys; plain or gzip")
      ->required();
  command.add_option("--config", options->config, "DRAM device: a name such as ddr3-1066-x32, or a file")
      ->required();
  command.add_option("--window", options->window, "Reads of 64 bytes under way at most")
      ->capture_default_str();
  command
      .add_option("--mapping", options->mapping,
                  "Address bits from high to low: rbc (row, bank, column), brc, or rbcg (bursts go to the "
                  "bank groups "
                  "in turn)")
      ->capture_default_str();
  command
      .add_option("--efficiency", options->efficiency, "Percent of the time that column commands may take")
      ->capture_default_str();
  command
      .add_option("--request-bytes", options->request_bytes,
                  "Bytes of a request whose trace does not say, 64 if not given")
      ->type_name("COUNT");
  command
      .add_option("--trace-mhz", options->trace_mhz,
                  "Clock whose cycles a trace of DRAMsim3 or DRAMSys counts; the devices' if not given")
      ->type_name("MHZ");
  command.add_flag("--no-refresh", options->no_refresh, "Leave out refreshes");
  command.add_flag("--json", options->json, "Print the numbers as JSON, with unit and description");
  command.callback([options, &context] {
    context.action = [options, &context] { return replay_trace(*options, context); };
  });
}

}  // namespace parallax
