// SPDX-License-Identifier: Apache-2.0
#include "platform/estimate/declared_circuits.hpp"

#include <algorithm>
#include <cmath>

#include "platform/estimate/circuit_parts.hpp"
#include "platform/estimate/memory_mapping.hpp"

namespace parallax {
namespace {

// Operations on words, in LUTs.
class Logic {
 public:
  explicit Logic(const CircuitCosts& costs) : costs_(costs) {}

  Logic& adders(std::int64_t number, std::int64_t bits) { return add(costs_.adder_bit, number * bits); }
  Logic& comparisons(std::int64_t number, std::int64_t bits) {
    return add(costs_.comparison_bit, number * bits);
  }
  Logic& choices(std::int64_t number, std::int64_t bits) {
    return add(costs_.multiplexer_bit, number * bits);
  }
  double luts() const { return luts_; }

 private:
  Logic& add(double cost, std::int64_t bits) {
    luts_ += cost * static_cast<double>(bits);
    return *this;
  }

  const CircuitCosts& costs_;
  double luts_ = 0;
};

std::int64_t delays(const StageCircuit& stage, std::int64_t bits) { return stage.latency * bits; }

}  // namespace

CircuitEstimate map_decoder_circuit(const StageCircuit& stage, int offset_bits, int word_bits,
                                    const DeviceFile& device) {
  constexpr int kComponents = 4;
  const std::int64_t token = std::int64_t{stage.at_once} * kComponents * offset_bits;
  CircuitEstimate made;
  // A shifter that finds a token in two words and one; sums with the token before and the one above.
  const std::int64_t window = token + 2 * word_bits;
  Logic logic(device.costs);
  logic.choices(bits_of(window), window).adders(2, token);
  made.logic.logic_luts = stage_luts(stage, logic.luts(), device);
  made.logic.registers = window + delays(stage, token) + control_registers(stage, 0);
  made.memories.push_back(
      line_buffer("map_decoder_line", stage, std::int64_t{kComponents} * offset_bits, device));
  return made;
}

CircuitEstimate consistency_circuit(const CostCircuit& circuit, int look_ahead_pixels,
                                    const DeviceFile& device) {
  const StageCircuit& stage = circuit.stage;
  const std::int64_t n = stage.at_once;
  const std::int64_t p = circuit.parallelism;
  const std::int64_t winner = circuit.cost_bits + kIndexBits;
  CircuitEstimate made;
  // Each cost of a group is held against the best of its right pixel, which moves on by a place a pixel.
  Logic logic(device.costs);
  logic.comparisons(n * p, circuit.cost_bits).choices(n * p, winner).adders(n, kDisparityWireBits);
  logic.comparisons(n, kDisparityWireBits);
  made.logic.logic_luts = stage_luts(stage, logic.luts(), device);
  made.logic.registers = delays(stage, n * kDisparityWireBits) + n * p * winner +
                         control_registers(stage, look_ahead_pixels, circuit.iterations);
  made.memories.push_back(
      {"right_winners",
       map_memory({circuit.iterations, n * p * winner, MemoryShape::Read::kAtOnce}, device).resources});
  made.memories.push_back(
      {"waiting_disparities", map_memory({look_ahead_pixels, n * kDisparityWireBits}, device).resources});
  return made;
}

CircuitEstimate texture_circuit(const StageCircuit& stage, const TextureConfig& config,
                                const DeviceFile& device) {
  constexpr int kSumBits = 12;  // of a column of differences
  const std::int64_t w = config.window;
  const std::int64_t n = stage.at_once;
  const std::int64_t columns = w + n - 1;
  CircuitEstimate made;
  // A difference a row of the column that comes, their sum, and the sum of columns that slides.
  Logic logic(device.costs);
  logic.adders(n * w, kGreyPixelBits).choices(n * w, kGreyPixelBits).adders(n * (w + 2), kSumBits);
  logic.comparisons(n, kSumBits).choices(n, kDisparityWireBits);
  made.logic.logic_luts = stage_luts(stage, logic.luts(), device);
  made.logic.registers = (1 + n) * w * kGreyPixelBits + columns * kSumBits +
                         delays(stage, n * (kSumBits + kDisparityWireBits)) +
                         control_registers(stage, w / 2 * (stage.width + 1));
  made.memories.push_back(line_buffer("texture_lines", stage, (w - 1) * kGreyPixelBits, device));
  return made;
}

CircuitEstimate speckle_circuit(const StageCircuit& stage, const SpeckleConfig& config,
                                const DeviceFile& device) {
  const std::int64_t d = kDisparityWireBits;
  const std::int64_t w = config.window;
  const std::int64_t n = stage.at_once;
  CircuitEstimate made;
  // Each place of the window is like the centre or not; a tree counts them.
  Logic logic(device.costs);
  logic.adders(n * w * w, d).comparisons(n * w * w, d).adders(n * w * w, 2).choices(n, d);
  made.logic.logic_luts = stage_luts(stage, config.iterations * logic.luts(), device);
  const std::int64_t window = w * (w + n - 1) * d;
  made.logic.registers =
      config.iterations * (window + n * w * w + control_registers(stage, w / 2 * stage.width)) +
      delays(stage, n * d);
  for (int i = 0; i < config.iterations; ++i) {
    made.memories.push_back(
        line_buffer("speckle_" + std::to_string(i) + "_lines", stage, (w - 1) * d, device));
  }
  return made;
}

CircuitEstimate gap_interpolation_circuit(const StageCircuit& stage, const GapInterpolationConfig& config,
                                          const DeviceFile& device) {
  const std::int64_t d = kDisparityWireBits;
  const std::int64_t n = stage.at_once;
  const std::int64_t place = bits_of(config.l_max + 2);
  const std::int64_t marked = d + 1;  // with a bit for the masked border
  CircuitEstimate made;
  // Along a row and a column: is there a gap with like edges, and what lies in it, by a product with a
  // reciprocal from a table.
  constexpr int kDirections = 2;
  Logic logic(device.costs);
  logic.adders(n * kDirections * 3, d).comparisons(n * kDirections * 2, d).choices(n * 3, d);
  logic.choices(n * config.l_max, marked);
  made.logic.logic_luts = stage_luts(stage, logic.luts(), device);
  made.logic.dsps = n * kDirections * multipliers(d, d + place, device);
  made.logic.registers = (config.l_max + n) * marked + delays(stage, n * d) +
                         control_registers(stage, config.l_max * stage.width);
  made.memories.push_back(line_buffer("gap_interpolation_lines", stage, config.l_max * marked, device));
  made.memories.push_back(line_buffer("gap_interpolation_columns", stage, d + place, device));
  return made;
}

CircuitEstimate stored_bits_circuit(const std::string& name, const StageCircuit& stage, std::int64_t bits,
                                    const DeviceFile& device) {
  CircuitEstimate made;
  made.logic.registers =
      delays(stage, std::int64_t{stage.at_once} * kDisparityWireBits) + control_registers(stage, 0);
  made.logic.logic_luts = stage_luts(stage, 0, device);
  const std::int64_t column = (bits + stage.width - 1) / stage.width;
  if (bits > 0) made.memories.push_back(line_buffer(name + "_lines", stage, column, device));
  return made;
}

CircuitEstimate burst_circuit(const DmaPortConfig& port, std::int64_t token_bits, const DeviceFile& device) {
  const std::int64_t words = std::int64_t{port.burst_bytes} * 8 / port.data_bits;
  // Of a token longer than a word, words go to their places; what is shifted is a word.
  const std::int64_t shifted = port.data_bits + std::min<std::int64_t>(token_bits, port.data_bits);
  const std::int64_t window = port.data_bits + token_bits;
  CircuitEstimate made;
  Logic logic(device.costs);
  logic.choices(bits_of(shifted), shifted).adders(1, bits_of(window) + bits_of(words));
  made.logic.logic_luts = std::llround(logic.luts());
  made.logic.registers = window + bits_of(window) + bits_of(words + 1);
  made.memories.push_back(
      {"burst", map_memory({words, port.data_bits, MemoryShape::Read::kAtOnce}, device).resources});
  return made;
}

CircuitEstimate engine_circuit(const DmaPortConfig& port, const DeviceFile& device) {
  constexpr int kAddressBits = 32;
  constexpr int kLengthBits = 24;
  const std::int64_t words = std::int64_t{port.fifo_bytes} * 8 / port.data_bits;
  const std::int64_t counts =
      kAddressBits + kLengthBits + bits_of(port.outstanding + 1) + 2 * bits_of(words + 1);
  CircuitEstimate made;
  Logic logic(device.costs);
  logic.adders(1, counts).comparisons(1, kLengthBits);
  made.logic.logic_luts = std::llround(logic.luts());
  made.logic.registers = counts + port.data_bits;
  made.memories.push_back({"buffer", map_memory({words, port.data_bits}, device).resources});
  return made;
}

}  // namespace parallax
