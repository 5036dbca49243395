// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "platform/explore/exploration_spec.hpp"
#include "platform/explore/result_store.hpp"

namespace parallax {

/// The point that misses its constraints by least.
struct NearestMiss {
  std::size_t number = 0;
  const Constraint* constraint = nullptr;  ///< that it misses by most
  double value = 0;
};

/// A point that could not be measured.
struct PointFault {
  std::size_t number = 0;
  std::string line;  ///< of its message the last, which says what to do
};

/// What the points of an exploration come to.
struct ExplorationOutcome {
  std::map<std::string, std::size_t> by_status;  ///< "done", "stuck", ...: how many
  std::set<std::size_t> satisfied;               ///< those done that fulfil all constraints, by number
  std::set<std::size_t> front;         ///< of these the Pareto front; all where there is no objective
  std::optional<PointFault> fault;     ///< the first, by number
  std::optional<NearestMiss> nearest;  ///< where none is satisfied, and one was done

  std::size_t done() const;
};

/// Of what the store has. `spec` must outlive the result.
ExplorationOutcome judge(const ExplorationSpec& spec, ResultStore& store);

}  // namespace parallax
