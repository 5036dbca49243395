// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/circuit_arguments.hpp"

#include <CLI/CLI.hpp>

namespace parallax {
namespace {

constexpr const char* kGroup = "Circuit";
// What counts cycles and tokens.
const CLI::Range kCount(std::uint64_t{0}, std::uint64_t{1} << 40);
const CLI::Range kPositive(std::uint64_t{1}, std::uint64_t{1} << 40);

}  // namespace

void add_circuit_build_options(CLI::App& command, CircuitOptions& options) {
  command.add_option("--circuit-top", options.top, "Top module of the Verilog, if it has several")
      ->type_name("NAME")
      ->group(kGroup);
  command.add_option("--circuit-parameter", options.parameters, "A parameter of the top module. Repeated")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false)
      ->take_all()
      ->group(kGroup);
}

void add_circuit_options(CLI::App& command, CircuitOptions& options) {
  command
      .add_option("--circuit", options.circuit,
                  "A circuit in the place of a stage, beside what the model's stage does: Verilog, or a "
                  "library of parallax circuit")
      ->type_name("STAGE=FILE,...")
      ->group(kGroup);
  add_circuit_build_options(command, options);
  command
      .add_option("--circuit-pins", options.pins,
                  "Which pin is what, where names do not tell: clock=clk_i, in_left.data=pixel, "
                  "out_left.valid=strobe. Repeated")
      ->type_name("ROLE=PIN")
      ->allow_extra_args(false)
      ->take_all()
      ->group(kGroup);
  command
      .add_option("--circuit-set", options.constants,
                  "An input that stays as it is, such as a mode. Repeated")
      ->type_name("PIN=VALUE")
      ->allow_extra_args(false)
      ->take_all()
      ->group(kGroup);
  command
      .add_option("--circuit-interval", options.interval,
                  "Least cycles from one token to the next at an input")
      ->check(kPositive)
      ->capture_default_str()
      ->group(kGroup);
  command
      .add_option("--circuit-latency", options.latency,
                  "Clock edges from a token to its result, of a circuit without valid at its outputs")
      ->check(kCount)
      ->capture_default_str()
      ->group(kGroup);
  command
      .add_option("--circuit-flush", options.flush,
                  "Tokens of zeros that it gets behind each frame, to push out what is in it; as many as "
                  "--circuit-latency if not given")
      ->check(kCount)
      ->group(kGroup);
  command
      .add_option("--circuit-skip", options.skip,
                  "Tokens that come out before the first one of a frame and count for nothing")
      ->check(kCount)
      ->capture_default_str()
      ->group(kGroup);
  command
      .add_option("--circuit-stall", options.stall,
                  "Of 1000 cycles, those in which each side is stalled at random")
      ->check(CLI::Range(0, 999))
      ->capture_default_str()
      ->group(kGroup);
  command
      .add_option("--circuit-seed", options.seed, "Of the stalls, and of registers without an initial value")
      ->check(kCount)
      ->capture_default_str()
      ->group(kGroup);
  command
      .add_option(
          "--circuit-timeout", options.timeout,
          "Cycles without a token, while one is due, after which it is given up; 100000 if not given, "
          "or four for each token of a frame")
      ->check(kPositive)
      ->group(kGroup);
  command
      .add_option("--circuit-bound", options.bound,
                  "Most cycles by which a token may leave later than from the model's stage; more is a "
                  "failure")
      ->group(kGroup);
}

}  // namespace parallax
