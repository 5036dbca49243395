// SPDX-License-Identifier: Apache-2.0
#include "platform/estimate/circuit_costs.hpp"

namespace parallax {

const std::vector<CircuitCost>& circuit_costs() {
  using C = CircuitCosts;
  constexpr bool kFitted = true;
  constexpr bool kRule = false;
  static const std::vector<CircuitCost> all{
      {"stage.latency_register", &C::latency_register, "The handshake of a pipeline register, in any stage.",
       kFitted},
      {"memory.bank_multiplexer", &C::bank_multiplexer,
       "A bit of what is read from a memory that is deeper than its primitives, times its banks, rounded up "
       "to a power of two.",
       kFitted},
      {"census.base", &C::census_base, "The census stage, whatever its window.", kFitted},
      {"census.compared_bit", &C::census_compared_bit, "A bit of a neighbour that is compared.", kFitted},
      {"census.border_bit", &C::census_border_bit,
       "A bit of a multiplexer that gives a pixel outside the image a value.", kFitted},
      {"rectification.base", &C::rectification_base, "The rectification stage, whatever its window.",
       kFitted},
      {"rectification.offset_bit", &C::rectification_offset_bit, "A bit of the map's token.", kFitted},
      {"rectification.fraction_bit", &C::rectification_fraction_bit,
       "A bit of the fractions of both images' offsets.", kFitted},
      {"matching.base", &C::matching_base, "The matching stage, whatever its parallelism.", kFitted},
      {"matching.code_bit", &C::matching_code_bit,
       "A bit in which the codes of a comparison may differ: their distance.", kFitted},
      {"matching.path_bit", &C::matching_path_bit,
       "A bit of a path's cost of one disparity: additions, comparisons, its part of the tree of minima and "
       "of the sum.",
       kFitted},
      {"matching.window_bit", &C::matching_window_bit,
       "A bit of the window of right codes: the row's begin, and the choice of a group.", kFitted},
      {"subpixel.base", &C::subpixel_base, "The subpixel stage, whatever its parallelism.", kFitted},
      {"subpixel.cost_bit", &C::subpixel_cost_bit, "A bit of a group of costs.", kFitted},
      {"uniqueness.base", &C::uniqueness_base, "The uniqueness stage, whatever its parallelism.", kFitted},
      {"uniqueness.cost_bit", &C::uniqueness_cost_bit, "A bit of a group of costs.", kFitted},
      {"mean.base", &C::mean_base, "The noise reduction of kind mean, whatever its window.", kFitted},
      {"mean.place_bit", &C::mean_place_bit, "A bit of the window of disparities.", kFitted},
      {"median.base", &C::median_base, "The noise reduction of kind median_3x3.", kFitted},
      {"fifo.base", &C::fifo_base, "A FIFO, whatever its depth and width.", kFitted},
      {"fifo.pointer_bit", &C::fifo_pointer_bit, "A bit of a FIFO's pointers and counts.", kFitted},
      {"fifo.through_bit", &C::fifo_through_bit,
       "A bit of a token that can pass an empty FIFO in the same cycle.", kFitted},
      {"rule.adder_bit", &C::adder_bit,
       "A bit of an addition, in stages that there is no reference circuit of.", kRule},
      {"rule.comparison_bit", &C::comparison_bit, "A bit of a comparison, there.", kRule},
      {"rule.multiplexer_bit", &C::multiplexer_bit, "A bit of a choice of two, there.", kRule},
  };
  return all;
}

}  // namespace parallax
