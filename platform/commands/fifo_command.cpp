// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/fifo_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "platform/commands/command_context.hpp"
#include "platform/commands/common_options.hpp"
#include "platform/commands/exit_codes.hpp"
#include "platform/config/nearest_name.hpp"
#include "platform/config/stream_config.hpp"
#include "platform/cosim/fifo_bench.hpp"
#include "platform/cosim/fifo_description.hpp"
#include "platform/results/output_folder.hpp"
#include "tlm/error.hpp"
#include "traces/json_text.hpp"
#include "traces/number_text.hpp"

namespace parallax {
namespace {

struct FifoOptions {
  std::vector<std::string> waves;
  std::vector<std::string> signals;
  std::string stream = "NAME";
  bool json = false;
  std::string bench;
  std::string module;
  std::vector<std::string> parameters;
  std::vector<std::string> connections;
  bool no_reset = false;
};

std::string counted(std::size_t count) { return grouped(std::to_string(count)); }

std::string text(const FifoFinding& finding, const std::string& stream) {
  if (!finding.description) {
    std::string out = fmt::format("{}: {}\n", finding.needs_stalls ? "not enough stalls" : "no description",
                                  finding.reason);
    if (finding.place) {
      out += fmt::format("first at            {}, token {}, cycle {}, {} token{} held\n",
                         excerpt(finding.place->file), finding.place->token, finding.place->cycle,
                         finding.place->fill, finding.place->fill == 1 ? "" : "s");
    }
    return out;
  }
  std::string out;
  for (const auto& [key, value] : finding.description->keys(stream))
    out += fmt::format("{} = {}\n", key, value);
  out += fmt::format("# exact for all {} tokens; {} were awaited by the reader, {} by the writer\n",
                     counted(finding.tokens), counted(finding.awaited), counted(finding.refused));
  if (finding.description->two_clocks)
    out += "# for clocks of these periods; simulate those of your design\n";
  return out;
}

nlohmann::ordered_json to_json(const FifoFinding& finding, const std::string& stream) {
  nlohmann::ordered_json tree{{"described", finding.description.has_value()}};
  if (finding.description) {
    const FifoDescription& found = *finding.description;
    tree["kind"] = name_of(found.kind());
    tree["clocks"] = found.two_clocks ? 2 : 1;
    tree["depth"] = found.depth;
    tree["write_to_read"] = found.write_to_read;
    tree["read_to_write"] = found.read_to_write;
    tree["not_ready_cycles"] = found.not_ready_cycles;
    nlohmann::ordered_json lines = nlohmann::ordered_json::array();
    for (const auto& [key, value] : found.keys(stream)) lines.push_back(key + " = " + value);
    tree["preset"] = std::move(lines);
  } else {
    tree["reason"] = finding.reason;
    tree["needs_stalls"] = finding.needs_stalls;
    if (finding.place) {
      tree["first"] = {{"file", finding.place->file},
                       {"token", finding.place->token},
                       {"cycle", finding.place->cycle},
                       {"held", finding.place->fill}};
    }
  }
  tree["tokens"] = finding.tokens;
  tree["awaited_by_reader"] = finding.awaited;
  tree["awaited_by_writer"] = finding.refused;
  return tree;
}

int describe_waves(const FifoOptions& options, CommandContext& context) {
  const std::vector<std::string>& names = pipeline_stream_names();
  if (options.stream != FifoOptions{}.stream &&
      std::find(names.begin(), names.end(), options.stream) == names.end()) {
    throw UserError(fmt::format("--stream: there is no stream '{}'; the nearest is {}",
                                excerpt(options.stream), nearest_name(options.stream, names)));
  }
  const FifoSignals signals = FifoSignals::from(options.signals, "--signals");
  std::vector<FifoCapture> captures;
  for (const std::string& file : options.waves) captures.push_back(read_fifo_capture(file, signals));
  const FifoFinding finding = describe_fifo(captures);
  if (options.json) {
    context.out << json_text(to_json(finding, options.stream), 2) << '\n';
  } else if (context.verbosity != Verbosity::kQuiet) {
    context.out << text(finding, options.stream);
  }
  return finding.description ? 0 : kNotAsExpected;
}

bool is_identifier(const std::string& name) {
  const auto fits = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '$';
  };
  return !name.empty() && std::isdigit(static_cast<unsigned char>(name.front())) == 0 &&
         name.front() != '$' && std::all_of(name.begin(), name.end(), fits);
}

void check_identifier(const char* option, const std::string& name) {
  if (!is_identifier(name))
    throw UserError(fmt::format("{}: '{}' is no name that Verilog has", option, excerpt(name)));
}

FifoModule::Bindings read_bindings(const char* option, const std::vector<std::string>& words) {
  FifoModule::Bindings all;
  for (const std::string& word : words) {
    const std::size_t equals = std::min(word.find('='), word.size());
    if (equals + 1 >= word.size())
      throw UserError(fmt::format("{}: '{}' is not NAME=VALUE", option, excerpt(word)));
    check_identifier(option, word.substr(0, equals));
    if (word.find_first_of("\r\n@") != std::string::npos)
      throw UserError(fmt::format("{}: '{}' is no value that Verilog has", option, excerpt(word)));
    all.emplace_back(word.substr(0, equals), word.substr(equals + 1));
  }
  return all;
}

int write_bench(const FifoOptions& options, CommandContext& context) {
  if (options.module.empty()) throw UserError("--bench needs --module NAME, the module of the FIFO");
  FifoModule module;
  check_identifier("--module", options.module);
  module.name = options.module;
  module.ports = FifoSignals::from(options.signals, "--signals");
  for (const FifoSignals::Role& role : FifoSignals::roles()) {
    if (const std::string& port = module.ports.*role.signal; !port.empty())
      check_identifier("--signals", port);
  }
  module.has_reset = !options.no_reset;
  if (options.no_reset && !(module.ports.reset + module.ports.reset_n).empty())
    throw UserError("--no-reset: --signals names a reset");
  module.parameters = read_bindings("--parameters", options.parameters);
  module.connections = read_bindings("--connect", options.connections);

  const std::string name = std::string(kFifoBench) + ".sv";
  FolderPlan plan;
  plan.writes = [&](const std::string& file) { return file == name; };
  OutputFolder folder(options.bench, plan);
  folder.write(name, fifo_bench(module));
  folder.publish();
  if (options.json) {
    context.out << json_text(nlohmann::ordered_json{{"bench", (folder.path() / name).string()},
                                                    {"module", module.name}},
                             2)
                << '\n';
  } else if (context.verbosity != Verbosity::kQuiet) {
    context.out << fmt::format("test bench          {}, for the module {}\n", (folder.path() / name).string(),
                               module.name);
  }
  return 0;
}

int run_fifo(const FifoOptions& options, CommandContext& context) {
  const bool writes = !options.bench.empty();
  if (writes == !options.waves.empty())
    throw UserError("parallax fifo takes either waves to describe, or --bench DIR to write a test bench");
  if (writes) return write_bench(options, context);
  if (!options.module.empty() || !options.parameters.empty() || !options.connections.empty() ||
      options.no_reset)
    throw UserError("--module, --parameters, --connect and --no-reset belong to --bench");
  return describe_waves(options, context);
}

}  // namespace

void add_fifo_command(CLI::App& app, CommandContext& context) {
  const auto options = std::make_shared<FifoOptions>();
  CLI::App& command = *app.add_subcommand(
      "fifo", "From the waves of a FIFO in a simulator: the kind, delays and depth that describe it exactly");
  command.add_option("waves", options->waves,
                     "VCD of the FIFO under random stalls, or CSV with a row for each cycle; of several, one "
                     "description for all");
  command.add_option("--stream", options->stream, "Stream of the machine whose keys are printed")
      ->type_name("NAME");
  command
      .add_option(
          "--signals", options->signals,
          "Signals of the FIFO, or with --bench ports: write_valid, write_ready (or full), read_valid (or "
          "empty), read_ready, clock (or write_clock and read_clock), reset (or reset_n); if not given, "
          "s_axis_tvalid and so on, and clk, rst")
      ->type_name("ROLE=NAME,...")
      ->delimiter(',');
  command
      .add_option(
          "--bench", options->bench,
          "Write a test bench there, fifo_bench.sv, that stalls a FIFO at random and writes its waves")
      ->type_name("DIR");
  command.add_option("--module", options->module, "With --bench: module of the FIFO")->type_name("NAME");
  command.add_option("--parameters", options->parameters, "With --bench: parameters of the module")
      ->type_name("NAME=VALUE,...")
      ->delimiter(',');
  command
      .add_option(
          "--connect", options->connections,
          "With --bench: another port of the module and what it is connected to. Repeated for several")
      ->type_name("PORT=VALUE")
      ->allow_extra_args(false);
  command.add_flag("--no-reset", options->no_reset, "With --bench: the module has no reset");
  add_json_option(command, options->json);
  command.callback(
      [options, &context] { context.action = [options, &context] { return run_fifo(*options, context); }; });
}

}  // namespace parallax
