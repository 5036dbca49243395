// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/circuit_arguments.hpp"

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>

namespace parallax {
namespace {

constexpr const char* kGroup = "Circuit";
// What counts cycles and tokens.
const CLI::Range kCount(std::uint64_t{0}, std::uint64_t{1} << 40);
constexpr std::uint64_t kMostWaves = 1000000;
const CLI::Range kPositive(std::uint64_t{1}, std::uint64_t{1} << 40);

/// Options of the circuit that is being described.
class CircuitOptionAdder {
 public:
  CircuitOptionAdder(CLI::App& command, std::function<CircuitOptions&()> circuit)
      : command_(command), circuit_(std::move(circuit)) {}

  /// `set` is called wherever the option stands, in the order of the line.
  template <class T, class Set>
  CLI::Option& add(const char* name, const char* type, const Set& set, const char* help) const {
    return *command_
                .add_option_function<T>(
                    name, [circuit = circuit_, set](const T& value) { set(circuit(), value); }, help)
                ->type_name(type)
                ->trigger_on_parse()
                ->group(kGroup);
  }

 private:
  CLI::App& command_;
  std::function<CircuitOptions&()> circuit_;
};

void add_build_options(const CircuitOptionAdder& options, const std::function<void(CLI::Option&)>& also) {
  also(options.add<std::string>(
      "--circuit-top", "NAME", [](CircuitOptions& of, const std::string& top) { of.top = top; },
      "Top module of the Verilog, if it has several"));
  also(options.add<std::string>(
      "--circuit-parameter", "NAME=VALUE",
      [](CircuitOptions& of, const std::string& one) { of.parameters.push_back(one); },
      "A parameter of the top module. Repeated"));
  also(options.add<std::string>(
      "--circuit-include", "DIR",
      [](CircuitOptions& of, const std::string& folder) { of.includes.push_back(folder); },
      "A folder in which `include files and modules are looked for, beside those of the sources. Repeated"));
  also(options.add<std::string>(
      "--circuit-define", "NAME[=VALUE]",
      [](CircuitOptions& of, const std::string& one) { of.defines.push_back(one); },
      "A macro of the preprocessor, as `define. Repeated"));
}

}  // namespace

void add_circuit_build_options(CLI::App& command, CircuitOptions& circuit) {
  add_build_options({command, [&circuit]() -> CircuitOptions& { return circuit; }}, [](CLI::Option&) {});
}

void add_circuit_options(CLI::App& command, std::vector<CircuitOptions>& circuits, bool& shadow) {
  // What stands before the first circuit is of all of them.
  const auto common = std::make_shared<CircuitOptions>();
  CLI::Option* const first =
      command
          .add_option_function<std::string>(
              "--circuit",
              [common, &circuits](const std::string& circuit) {
                circuits.push_back(*common);
                circuits.back().circuit = circuit;
              },
              "A circuit in the place of a stage, beside what the model's stage does: Verilog, or a "
              "library of parallax circuit. Repeated, for several stages: the options below are of the "
              "circuit before them, or of all if they stand before the first")
          ->type_name("STAGE=FILE,...")
          ->trigger_on_parse()
          ->group(kGroup);
  const auto needs_it = [first](CLI::Option& option) { option.needs(first); };
  const CircuitOptionAdder options(command, [common, &circuits]() -> CircuitOptions& {
    return circuits.empty() ? *common : circuits.back();
  });
  const auto add_number = [&](const char* name, const auto& set, const CLI::Validator& range,
                              const char* fallback, const char* help) {
    CLI::Option& option = options.add<std::uint64_t>(name, "NUMBER", set, help);
    option.check(range)->default_str(fallback);
    needs_it(option);
  };
  add_build_options(options, needs_it);
  needs_it(options.add<std::string>(
      "--circuit-pins", "ROLE=PIN",
      [](CircuitOptions& of, const std::string& pin) { of.pins.push_back(pin); },
      "Which pin is what, where names do not tell: clock=clk_i, in_left.data=pixel, out_left.valid=strobe. "
      "Repeated"));
  needs_it(options.add<std::string>(
      "--circuit-set", "PIN=VALUE",
      [](CircuitOptions& of, const std::string& pin) { of.constants.push_back(pin); },
      "An input that stays as it is, such as a mode. Repeated"));
  add_number(
      "--circuit-interval", [](CircuitOptions& of, std::uint64_t cycles) { of.interval = cycles; }, kPositive,
      "1", "Least cycles from one token to the next at an input");
  add_number(
      "--circuit-row-gap", [](CircuitOptions& of, std::uint64_t edges) { of.row_gap = edges; }, kCount, "0",
      "Least clock edges without a token behind each row, as in horizontal blanking");
  add_number(
      "--circuit-frame-gap", [](CircuitOptions& of, std::uint64_t edges) { of.frame_gap = edges; }, kCount,
      "0", "Least clock edges without a token behind each frame, or tile of it");
  add_number(
      "--circuit-latency", [](CircuitOptions& of, std::uint64_t edges) { of.latency = edges; }, kCount, "0",
      "Clock edges from a token to its result, of a circuit without valid at its outputs");
  add_number(
      "--circuit-flush", [](CircuitOptions& of, std::uint64_t tokens) { of.flush = tokens; }, kCount, "",
      "Tokens of zeros that it gets behind each frame, to push out what is in it; as many as "
      "--circuit-latency if not given");
  add_number(
      "--circuit-skip", [](CircuitOptions& of, std::uint64_t tokens) { of.skip = tokens; }, kCount, "0",
      "Tokens that come out before the first one of a frame and count for nothing");
  add_number(
      "--circuit-stall", [](CircuitOptions& of, std::uint64_t share) { of.stall = share; },
      CLI::Range(0, 999), "0", "Of 1000 cycles, those in which each side is stalled at random");
  add_number(
      "--circuit-seed", [](CircuitOptions& of, std::uint64_t seed) { of.seed = seed; }, kCount, "1",
      "Of the stalls, and of registers without an initial value");
  add_number(
      "--circuit-timeout", [](CircuitOptions& of, std::uint64_t cycles) { of.timeout = cycles; }, kPositive,
      "",
      "Cycles without a token, while one is due, after which it is given up; 100000 if not given, or four "
      "for "
      "each token of a frame");
  add_number(
      "--circuit-seconds", [](CircuitOptions& of, std::uint64_t seconds) { of.seconds = seconds; }, kPositive,
      "60", "Seconds that it may take to evaluate one clock edge, after which the run ends");
  needs_it(options.add<std::int64_t>(
      "--circuit-bound", "NUMBER", [](CircuitOptions& of, std::int64_t cycles) { of.bound = cycles; },
      "Most cycles by which a token may leave later than from the model's stage; more is a failure"));
  CLI::Option& waves = options.add<std::uint64_t>(
      "--circuit-waves", "NUMBER", [](CircuitOptions& of, std::uint64_t cycles) { of.waves = cycles; },
      "With --out: cycles before and behind the first difference of which circuit_STAGE.vcd and .pftrace "
      "have the waves");
  waves.check(CLI::Range(std::uint64_t{0}, kMostWaves))->default_str(std::to_string(kCircuitWaves));
  needs_it(waves);
  command
      .add_flag("--circuit-shadow", shadow,
                "Circuits run beside the model: each gets what the model's stage gets, and what flows on is "
                "the model's")
      ->needs(first)
      ->group(kGroup);
}

}  // namespace parallax
