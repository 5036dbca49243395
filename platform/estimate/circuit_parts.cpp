// SPDX-License-Identifier: Apache-2.0
#include "platform/estimate/circuit_parts.hpp"

#include <cmath>

#include "platform/estimate/memory_mapping.hpp"

namespace parallax {

int bits_of(std::int64_t values) {
  int bits = 0;
  while ((std::int64_t{1} << bits) < values) ++bits;
  return bits;
}

Resources CircuitEstimate::all() const {
  Resources sum = logic;
  for (const CircuitMemory& memory : memories) sum += memory.resources;
  return sum;
}

std::int64_t control_registers(const StageCircuit& stage, std::int64_t ahead_pixels, int groups) {
  const std::int64_t pixels = std::int64_t{stage.width} * stage.height;
  const int group = groups > 1 ? bits_of(groups + 1) : 0;
  return bits_of(pixels + ahead_pixels + 1) + bits_of(stage.width + 1) + bits_of(stage.height + 1) + group +
         stage.latency;
}

std::int64_t stage_luts(const StageCircuit& stage, double others, const DeviceFile& device) {
  return std::llround(others + device.costs.latency_register * stage.latency);
}

CircuitMemory line_buffer(const std::string& name, const StageCircuit& stage, std::int64_t bits_a_column,
                          const DeviceFile& device) {
  const std::int64_t words = (stage.width + stage.at_once - 1) / stage.at_once;
  return {name, map_memory({words, stage.at_once * bits_a_column}, device).resources};
}

}  // namespace parallax
