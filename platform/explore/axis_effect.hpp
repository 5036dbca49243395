// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "platform/explore/exploration_spec.hpp"
#include "platform/explore/result_store.hpp"

namespace parallax {

/// How a number moves with what varies alone, all else at its first value.
struct AxisEffect {
  std::string name;      ///< of what varies
  std::string metric;    ///< path of the number
  double base = 0;       ///< of the point at which all has its first value
  double least = 0;      ///< over the values of `name`, the first among them
  std::string at_least;  ///< with this value; the first of several
  double most = 0;
  std::string at_most;

  double range() const { return most - least; }
};

/// Of an exploration that varies one at a time: for each metric what moves it most first. Points that were
/// not measured are left out; empty where the base is one of these.
std::vector<AxisEffect> axis_effects(const ExplorationSpec& spec, ResultStore& store,
                                     const std::vector<std::string>& metrics);

}  // namespace parallax
