// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/circuit_command.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <vector>

#include "platform/commands/circuit_arguments.hpp"
#include "platform/commands/command_context.hpp"
#include "platform/cosim/circuit_build.hpp"

namespace parallax {
namespace {

struct CircuitCommandOptions {
  std::vector<std::filesystem::path> sources;
  CircuitOptions circuit;
  std::filesystem::path out;
};

}  // namespace

void add_circuit_command(CLI::App& app, CommandContext& context) {
  const auto options = std::make_shared<CircuitCommandOptions>();
  CLI::App& command = *app.add_subcommand(
      "circuit", "Make a library of a circuit in Verilog, with Verilator, for parallax run --circuit");
  command.add_option("FILE", options->sources, "Verilog or SystemVerilog")->type_name("FILE")->required();
  add_circuit_build_options(command, options->circuit);
  command.add_option("--out", options->out, "The library")->type_name("FILE.so")->required();
  command.callback([options, &context] {
    context.action = [options] {
      build_circuit(options->sources, options->circuit, options->out);
      return 0;
    };
  });
}

}  // namespace parallax
