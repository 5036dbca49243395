// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace parallax {

/// LUTs of a family's circuits: what does not follow from widths and counts. Those of circuits that there is
/// a reference of are fitted to what a synthesiser makes of it; the others are a designer's rule.
struct CircuitCosts {
  // Fitted.
  double latency_register = 0;  ///< handshake of a pipeline register of any stage
  double bank_multiplexer = 0;  ///< a bit, and a bank, of a memory deeper than its primitives
  double census_base = 0;
  double census_compared_bit = 0;  ///< of the comparisons with the centre
  double census_border_bit = 0;    ///< of the multiplexers that give pixels outside the image a value
  double rectification_base = 0;
  double rectification_offset_bit = 0;    ///< of the map's token
  double rectification_fraction_bit = 0;  ///< of both images
  double matching_base = 0;
  double matching_code_bit = 0;    ///< of a disparity's two codes that are compared
  double matching_path_bit = 0;    ///< of a disparity's cost on one path
  double matching_window_bit = 0;  ///< of the window of right codes
  double subpixel_base = 0;
  double subpixel_cost_bit = 0;  ///< of a group of costs
  double uniqueness_base = 0;
  double uniqueness_cost_bit = 0;  ///< of a group of costs
  double mean_base = 0;
  double mean_place_bit = 0;  ///< of the window
  double median_base = 0;
  double fifo_base = 0;
  double fifo_pointer_bit = 0;
  double fifo_through_bit = 0;  ///< of a token that can pass an empty FIFO in the same cycle

  // Rules for what there is no reference circuit of: LUTs a bit.
  double adder_bit = 1;
  double comparison_bit = 0.5;
  double multiplexer_bit = 0.5;
};

/// A cost with its key, as in "circuit.matching.path_bit", and what it is of.
struct CircuitCost {
  std::string key;
  double CircuitCosts::*member;
  std::string documentation;
  bool fitted;
};

/// All of them.
const std::vector<CircuitCost>& circuit_costs();

}  // namespace parallax
