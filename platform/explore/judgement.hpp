// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "platform/explore/exploration_spec.hpp"

namespace parallax {

/// By how much a value misses a constraint, relative to the bound (of a bound of 0: as it is); 0 where it is
/// satisfied, infinite where there is no value.
double miss(const Constraint& constraint, std::optional<double> value);

/// Which of these rows are on the Pareto front, ascending: no other is at least as good in all objectives and
/// better in one. Rows that are equal are all on it; a row that lacks a value is not. `rows[i][j]`: of row i
/// the value of objective j.
std::vector<std::size_t> pareto_front(const std::vector<std::vector<std::optional<double>>>& rows,
                                      const std::vector<Objective>& objectives);

}  // namespace parallax
