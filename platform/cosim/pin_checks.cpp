// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/pin_checks.hpp"

#include <fmt/format.h>

#include "tlm/error.hpp"

namespace parallax {
namespace {

void check_clock(const PinList& circuit, const CircuitPins& pins) {
  for (const PortPins& port : pins.ports) {
    if (pins.clock == nullptr && (port.valid || port.ready)) {
      throw UserError(
          fmt::format("circuit {} has no clock, such as clk, but a handshake at {}; --circuit-pins clock=PIN "
                      "names it",
                      circuit.name, port.port));
    }
  }
}

// Where valid says when a result is there, nothing else can.
void check_latency(const PinList& circuit, const CircuitPins& pins, const CircuitOptions& options) {
  if (options.latency == 0) return;
  for (const PortPins& port : pins.ports) {
    if (!port.is_input && !port.valid) return;
  }
  throw UserError(fmt::format(
      "--circuit-latency {}: circuit {} says itself when a result is there, by {}; leave it out, or "
      "--circuit-pins {}.valid= has it count edges; --circuit-flush sends tokens behind a frame",
      options.latency, circuit.name, pins.ports.back().valid.name(), pins.ports.back().port));
}

// What tells the circuit of a gap, so that its clock can run in it.
void check_gaps(const PinList& circuit, const CircuitPins& pins, const VectorManifest& stage,
                const CircuitOptions& options) {
  bool rows = false;
  for (const VectorStream& stream : stage.streams) rows |= stream.is_input && stream.shape.row_tokens > 0;
  if (options.row_gap > 0 && !rows) {
    throw UserError(fmt::format("--circuit-row-gap {}: the inputs of {} know no rows; leave it out",
                                options.row_gap, stage.stage));
  }
  if (pins.enable) return;
  for (const PortPins& port : pins.ports) {
    if (!port.is_input || port.valid || port.line_valid) continue;
    if (options.row_gap > 0) {
      throw UserError(fmt::format(
          "--circuit-row-gap {}: circuit {} has neither valid nor line_valid at {}, which would tell it of a "
          "gap; --circuit-pins {}.line_valid=PIN names one",
          options.row_gap, circuit.name, port.port, port.port));
    }
    if (options.frame_gap > 0 && !port.frame_valid) {
      throw UserError(fmt::format(
          "--circuit-frame-gap {}: circuit {} has neither valid, line_valid nor frame_valid at {}, which "
          "would tell it of a gap; --circuit-pins {}.frame_valid=PIN names one",
          options.frame_gap, circuit.name, port.port, port.port));
    }
  }
}

}  // namespace

void check_pins(const PinList& circuit, const CircuitPins& pins, const VectorManifest& stage,
                const CircuitOptions& options) {
  check_clock(circuit, pins);
  check_latency(circuit, pins, options);
  check_gaps(circuit, pins, stage, options);
}

std::vector<std::string> half_handshakes(const CircuitPins& pins) {
  std::vector<std::string> notes;
  const auto compare = [&](const PortPins& with, const PortPins& without, const char* role,
                           PinBits PortPins::*of) {
    if (with.is_input != without.is_input || !(with.*of) || without.*of) return;
    notes.push_back(fmt::format("{0} has no {1}, {2} has {3}: --circuit-pins {0}.{1}={3}, if it is of both",
                                without.port, role, with.port, (with.*of).name()));
  };
  for (const PortPins& with : pins.ports) {
    for (const PortPins& without : pins.ports) {
      compare(with, without, "valid", &PortPins::valid);
      compare(with, without, "ready", &PortPins::ready);
    }
  }
  return notes;
}

}  // namespace parallax
