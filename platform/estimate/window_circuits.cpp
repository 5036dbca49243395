// SPDX-License-Identifier: Apache-2.0
// The reference circuits of stages with a window in the image.
#include <algorithm>

#include "platform/estimate/circuit_parts.hpp"
#include "platform/estimate/memory_mapping.hpp"

namespace parallax {
namespace {

// Registers behind the last one that computes.
std::int64_t pass_registers(const StageCircuit& stage, int computing, std::int64_t bits) {
  return std::max(0, stage.latency - computing) * bits;
}

constexpr int kImages = 2;

}  // namespace

CircuitEstimate census_circuit(const CensusCircuit& circuit, const DeviceFile& device) {
  const StageCircuit& stage = circuit.stage;
  const std::int64_t rows = circuit.window_height;
  const std::int64_t columns = circuit.window_width;
  const std::int64_t window = rows * columns * kGreyPixelBits;
  const std::int64_t code = rows * columns - 1;
  const std::int64_t n = stage.at_once;
  // The columns shifted; the window as it was, with its rows, with its columns right; the code.
  const std::int64_t held = rows * (columns - 1) * kGreyPixelBits;
  const std::int64_t image = held + n * (3 * window + code + pass_registers(stage, 4, code));

  CircuitEstimate made;
  made.logic.registers = kImages * image + control_registers(stage, rows / 2 * stage.width + columns / 2) +
                         bits_of(stage.width) + 2 * columns + rows + kImages;
  const double compared = static_cast<double>(kImages * n * code * kGreyPixelBits);
  const double border =
      static_cast<double>(kImages * n * kGreyPixelBits * (columns * (rows - 1) + rows * (columns - 1)));
  const CircuitCosts& costs = device.costs;
  made.logic.logic_luts = stage_luts(
      stage, costs.census_base + costs.census_compared_bit * compared + costs.census_border_bit * border,
      device);
  for (const char* image_name : {"census_left_lines", "census_right_lines"})
    made.memories.push_back(line_buffer(image_name, stage, (rows - 1) * kGreyPixelBits, device));
  return made;
}

CircuitEstimate rectification_circuit(const RectificationCircuit& circuit, const DeviceFile& device) {
  const StageCircuit& stage = circuit.stage;
  const std::int64_t f = circuit.fraction_bits;
  const std::int64_t o = circuit.offset_bits;
  const std::int64_t n = stage.at_once;
  const std::int64_t slots = circuit.window + 1;
  const std::int64_t x_bits = bits_of(stage.width);
  const std::int64_t y_bits = bits_of(stage.height);
  const std::int64_t slot_bits = bits_of(slots);
  // Rows of which 2 x 2 pixels are read at once: even and odd columns and rows lie apart, for each pixel that
  // passes at once (modules/rtl/pixel_square.sv).
  constexpr int kBanks = 4;
  const std::int64_t words = slots / 2 * ((stage.width + 1) / 2);
  const std::int64_t reach = circuit.window / 2;

  CircuitEstimate made;
  const std::int64_t image = 2 * o + 2 * (x_bits + slot_bits) + 2 * kBanks + kBanks * bits_of(words) + 6 * f +
                             kBanks * kGreyPixelBits + 3 * f + 2 * (kGreyPixelBits + f) + kGreyPixelBits +
                             2 * f + kGreyPixelBits + pass_registers(stage, 8, kGreyPixelBits);
  made.logic.registers = n * kImages * image + x_bits + y_bits + slot_bits + x_bits + 2 * slot_bits +
                         control_registers(stage, reach * stage.width + reach);
  // (S - f) a + f b for two rows, and for their results.
  const std::int64_t products = 4 * multipliers(kGreyPixelBits + f, f + 1, device) +
                                2 * multipliers(kGreyPixelBits + 2 * f, f + 1, device);
  made.logic.dsps = n * kImages * products;
  const CircuitCosts& costs = device.costs;
  const double copies = static_cast<double>(n);
  made.logic.logic_luts =
      stage_luts(stage,
                 costs.rectification_base * copies +
                     costs.rectification_offset_bit * copies * static_cast<double>(4 * o) +
                     costs.rectification_fraction_bit * copies * static_cast<double>(kImages * f),
                 device);
  for (const char* name : {"rectification_left_rows", "rectification_right_rows"}) {
    made.memories.push_back(
        {name,
         n * kBanks *
             map_memory({words, kGreyPixelBits, MemoryShape::Read::kRegistered, true}, device).resources});
  }
  return made;
}

CircuitEstimate mean_circuit(const NoiseReductionCircuit& circuit, const DeviceFile& device) {
  const StageCircuit& stage = circuit.stage;
  const std::int64_t w = circuit.window;
  const std::int64_t n = stage.at_once;
  const std::int64_t d = kDisparityWireBits;
  const std::int64_t places = w * w;
  const std::int64_t count = bits_of(places + 1);
  const std::int64_t sum = d + count;
  constexpr std::int64_t kLargest = 8189;  // that is divided, for each place
  const std::int64_t point = bits_of(2 * kLargest * places * places + 1);

  CircuitEstimate made;
  made.logic.registers = w * (w - 1) * d + bits_of(stage.width) +
                         control_registers(stage, w / 2 * stage.width + w / 2) +
                         n * (places * d + 2 * w + places + places * d + 5 * d + w * (sum + count) + sum +
                              2 * count + sum + 1 + d + pass_registers(stage, 7, d));
  made.logic.dsps = n * multipliers(sum + 1, point, device);
  made.logic.logic_luts = stage_luts(
      stage, device.costs.mean_base + device.costs.mean_place_bit * static_cast<double>(n * places * d),
      device);
  made.memories.push_back(line_buffer("noise_reduction_lines", stage, (w - 1) * d, device));
  return made;
}

CircuitEstimate median_circuit(const StageCircuit& stage, const DeviceFile& device) {
  constexpr std::int64_t kWindow = 9 * kDisparityWireBits;
  constexpr std::int64_t kColumns = 6 * kDisparityWireBits;
  const std::int64_t d = kDisparityWireBits;
  const std::int64_t n = stage.at_once;
  CircuitEstimate made;
  made.logic.registers = 2 * kColumns + bits_of(stage.width) + control_registers(stage, stage.width + 1) +
                         n * (kWindow + 2 * d + 2 + 3 * d + d + pass_registers(stage, 3, d));
  made.logic.logic_luts = stage_luts(stage, device.costs.median_base * static_cast<double>(n), device);
  made.memories.push_back(line_buffer("noise_reduction_lines", stage, 2 * d, device));
  return made;
}

}  // namespace parallax
