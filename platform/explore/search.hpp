// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "platform/explore/merit.hpp"
#include "platform/explore/search_space.hpp"

namespace parallax {

/// What a search was asked for.
struct SearchPlan {
  std::vector<std::size_t> sizes;  ///< of the axes (SearchSpace::sizes())
  std::size_t budget = 0;          ///< machines that may be evaluated; excluded ones cost nothing
  std::uint64_t seed = 1;
};

enum class SearchEnd {
  kBudget,       ///< as many were evaluated as may be
  kExhausted,    ///< nothing was found that was not seen before
  kInterrupted,  ///< there were fewer answers than asked for
};

/// Merits of these places, in their order; fewer when it is interrupted. No place is asked for twice.
using Evaluate = std::function<std::vector<Merit>(const std::vector<Place>&)>;

/// Looks for the Pareto front of a space of discrete axes. In turns: the genetic algorithm NSGA-II (Deb et
/// al., IEEE Trans. Evol. Comp. 6 (2002); pagmo's), which finds where good machines are without any
/// assumption about them, and Pareto local search (Paquete, Chiarandini, Stützle, 2004) over the neighbours
/// of what is not beaten, which finds the last step that mutation would miss. Constraints by Deb's rules
/// (beats()). A space no larger than the budget is enumerated. The same plan and merits give the same places.
SearchEnd search(const SearchPlan& plan, const Evaluate& evaluate);

}  // namespace parallax
