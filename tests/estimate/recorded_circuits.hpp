// SPDX-License-Identifier: Apache-2.0
// What a synthesiser made of the reference circuits, and what the estimate says of them.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "platform/estimate/fifo_circuit.hpp"
#include "platform/estimate/reference_circuits.hpp"
#include "tests/cli/markdown.hpp"
#include "tests/paths.hpp"

namespace parallax::test {

struct RecordedCircuit {
  std::string family;
  std::string circuit;
  std::map<std::string, int> parameters;
  std::string use;  ///< "calibrate" or "held_out"
  Resources cells;

  int operator()(const char* name, int otherwise) const {
    const auto found = parameters.find(name);
    return found == parameters.end() ? otherwise : found->second;
  }
  std::string text() const {
    std::string all;
    for (const auto& [name, value] : parameters) {
      if (name != "HEIGHT") all += (all.empty() ? "" : ", ") + name + " " + std::to_string(value);
    }
    return all;
  }
};

inline std::vector<RecordedCircuit> recorded_circuits() {
  std::vector<RecordedCircuit> all;
  const auto record = nlohmann::json::parse(read_text(source_path("tests/estimate/synthesised_cells.json")));
  for (const auto& row : record) {
    all.push_back({row.at("family"),
                   row.at("circuit"),
                   row.at("parameters").get<std::map<std::string, int>>(),
                   row.at("use"),
                   {row.at("luts"), row.at("ram_luts"), row.at("shift_luts"), row.at("registers"),
                    row.at("block_rams"), row.at("dsps")}});
  }
  return all;
}

/// Parameters that are not recorded are the circuits' defaults.
inline Resources estimated(const RecordedCircuit& c, const DeviceFile& device) {
  const auto stage = [&](int latency) {
    return StageCircuit{c("WIDTH", 640), c("HEIGHT", 480), c("LATENCY", latency)};
  };
  const auto costs = [&](int latency) {
    return CostCircuit{stage(latency), c("P", 32), c("ITERATIONS", 4), c("COST_BITS", 11)};
  };
  if (c.circuit == "census")
    return census_circuit({stage(4), c("WINDOW_WIDTH", 5), c("WINDOW_HEIGHT", 5)}, device).all();
  if (c.circuit == "rectification") {
    return rectification_circuit({stage(10), c("WINDOW", 79), c("FRACTION_BITS", 5), c("OFFSET_BITS", 12)},
                                 device)
        .all();
  }
  if (c.circuit == "subpixel") return subpixel_circuit(costs(16), device).all();
  if (c.circuit == "uniqueness") return uniqueness_circuit(costs(4), device).all();
  if (c.circuit == "noise_reduction") return mean_circuit({stage(8), c("WINDOW", 3)}, device).all();
  if (c.circuit == "median_3x3") return median_circuit(stage(8), device).all();
  if (c.circuit == "matching") {
    MatchingCircuit m;
    m.stage = stage(24);
    m.parallelism = c("P", 32);
    m.iterations = c("ITERATIONS", 4);
    m.code_bits = c("CODE_BITS", 24);
    const int cost = 2 * m.code_bits;  // COST_WEIGHT 2
    constexpr int kLargestPenalty = 255;
    m.cost_bits = bits_of(cost + 1);
    m.path_bits = bits_of(cost + kLargestPenalty + 1);
    m.sum_bits = bits_of(4 * (cost + kLargestPenalty) + 1);
    return matching_circuit(m, device).all();
  }
  const std::map<std::string, FifoKind> kinds{
      {"fifo_registered", FifoKind::kRegistered},
      {"fifo_first_word_fall_through", FifoKind::kFirstWordFallThrough},
      {"fifo_block_ram", FifoKind::kBlockRam}};
  return fifo_circuit({kinds.at(c.circuit), c("DEPTH", 2), c("WIDTH", 8)}, device).all();
}

}  // namespace parallax::test
