// SPDX-License-Identifier: Apache-2.0
// The reference circuits that work on groups of costs.
#include <algorithm>
#include <string>

#include "platform/estimate/circuit_parts.hpp"
#include "platform/estimate/memory_mapping.hpp"

namespace parallax {
namespace {

// What a path remembers of the row above: its costs, and the lowest of each pixel
// (modules/rtl/step_delay.sv).
struct LineMemory {
  Resources costs;
  Resources minima;
  std::int64_t registers;  // behind their outputs, and their addresses
};

LineMemory line_memory(const MatchingCircuit& c, std::int64_t pixels, const DeviceFile& device) {
  const std::int64_t group = std::int64_t{c.parallelism} * c.path_bits;
  const std::int64_t words = pixels * c.iterations;
  const auto delay = [&](std::int64_t length, std::int64_t bits) {
    return map_memory({length, bits, MemoryShape::Read::kRegistered, true}, device).resources;
  };
  return {delay(words, group), delay(pixels, c.path_bits),
          group + c.path_bits + 2 * (bits_of(words) + bits_of(pixels))};
}

// A path whose predecessor is the pixel before.
Resources horizontal_path(const MatchingCircuit& c, const DeviceFile& device) {
  const std::int64_t group = std::int64_t{c.parallelism} * c.path_bits;
  Resources made = map_delay(c.iterations, group, device);
  made.registers += c.path_bits;                     // the minimum
  if (made.shift_luts > 0) made.registers += group;  // the predecessor's, behind the shift register
  return made;
}

void add_lines(const MatchingCircuit& c, const DeviceFile& device, CircuitEstimate& made) {
  constexpr int kLinePaths = 3;
  // Diagonal predecessors lie one pixel farther, and one nearer.
  const std::int64_t away[kLinePaths] = {1, 0, -1};
  for (int path = 0; path < c.line_paths; ++path) {
    const std::int64_t distance = away[path % kLinePaths];
    const std::int64_t pixels =
        c.lines_on_chip ? c.stage.width + distance : std::max<std::int64_t>(distance, 0) + 1;
    const LineMemory line = line_memory(c, pixels, device);
    made.logic.registers += line.registers;
    const std::string name = "path_costs_" + std::to_string(path);
    made.memories.push_back({name, line.costs + line.minima});
  }
}

}  // namespace

CircuitEstimate matching_circuit(const MatchingCircuit& c, const DeviceFile& device) {
  constexpr int kPlaceBits = 5;
  constexpr int kComputing = 4;  // registers
  const std::int64_t p = c.parallelism;
  const std::int64_t rows = c.rows_at_once;
  const std::int64_t window = c.window > 0 ? c.window : p * c.iterations;
  const std::int64_t paths = c.horizontal_paths + c.line_paths;
  const std::int64_t group = p * c.path_bits;

  CircuitEstimate made;
  // The window; a group's codes, costs and path costs; their sum, as it is handed on.
  const std::int64_t late = std::max(0, c.stage.latency - kComputing);
  made.logic.registers =
      rows * (window * c.code_bits + 2 * c.code_bits + p * c.code_bits + 2 * kPlaceBits + p * c.cost_bits +
              paths * (group + 2 * c.path_bits) + (1 + late) * p * c.sum_bits) +
      control_registers(c.stage, 0, c.iterations);
  made.logic += rows * (c.horizontal_paths * horizontal_path(c, device));
  add_lines(c, device, made);
  // Between two rows at once lie the costs of two columns; what waits for its row's turn is held.
  for (std::int64_t row = 1; row < rows; ++row) {
    constexpr int kRowLag = 2;
    for (int path = 0; path < c.line_paths; ++path) made.logic += line_memory(c, kRowLag, device).costs;
    made.memories.push_back(line_buffer("waiting_codes_" + std::to_string(row), c.stage,
                                        2 * c.code_bits + kDisparityWireBits, device));
  }
  if (c.keeps_row) {
    made.memories.push_back({"costs_of_a_row", map_memory({std::int64_t{c.stage.width} * c.iterations,
                                                           rows * p * (c.cost_bits + c.sum_bits)},
                                                          device)
                                                   .resources});
  }
  const CircuitCosts& costs = device.costs;
  made.logic.logic_luts +=
      stage_luts(c.stage,
                 costs.matching_base + costs.matching_code_bit * static_cast<double>(rows * p * c.code_bits) +
                     costs.matching_path_bit * static_cast<double>(rows * paths * group) +
                     costs.matching_window_bit * static_cast<double>(rows * window * c.code_bits),
                 device);
  return made;
}

CircuitEstimate subpixel_circuit(const CostCircuit& circuit, const DeviceFile& device) {
  constexpr int kQuotientBits = 4;
  constexpr int kAboutBits = 10;
  constexpr int kComputing = 7;  // registers
  const std::int64_t c = circuit.cost_bits;
  const std::int64_t rest = c + kQuotientBits;
  const std::int64_t n = circuit.stage.at_once;
  const std::int64_t late = std::max(0, circuit.stage.latency - kComputing);
  CircuitEstimate made;
  // The best cost and its neighbours; the same again; the division, a register a bit; the disparity.
  made.logic.registers = control_registers(circuit.stage, 0, circuit.iterations) +
                         n * (4 * c + kIndexBits + 1 + 3 * c + kIndexBits + 2 + rest + c + kAboutBits +
                              kQuotientBits * (c + kAboutBits) + (kQuotientBits - 1) * rest + 10 +
                              (1 + late) * kDisparityWireBits);
  made.logic.logic_luts =
      stage_luts(circuit.stage,
                 static_cast<double>(n) *
                     (device.costs.subpixel_base +
                      device.costs.subpixel_cost_bit * static_cast<double>(circuit.parallelism * c)),
                 device);
  return made;
}

CircuitEstimate uniqueness_circuit(const CostCircuit& circuit, const DeviceFile& device) {
  constexpr int kFactorBits = 13;
  constexpr int kComputing = 3;  // registers
  const std::int64_t c = circuit.cost_bits;
  const std::int64_t n = circuit.stage.at_once;
  const std::int64_t late = std::max(0, circuit.stage.latency - kComputing);
  CircuitEstimate made;
  // The product lies in the DSP's register.
  made.logic.registers = control_registers(circuit.stage, 0, circuit.iterations) +
                         n * (4 * c + 1 + 2 * c + c + (3 + late) * kDisparityWireBits);
  made.logic.dsps = n * multipliers(c, kFactorBits, device);
  made.logic.logic_luts =
      stage_luts(circuit.stage,
                 static_cast<double>(n) *
                     (device.costs.uniqueness_base +
                      device.costs.uniqueness_cost_bit * static_cast<double>(circuit.parallelism * c)),
                 device);
  return made;
}

}  // namespace parallax
