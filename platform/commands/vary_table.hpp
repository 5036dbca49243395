// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "platform/commands/vary_axes.hpp"
#include "platform/evaluation/relaxed_limits.hpp"

namespace parallax {

/// The table that `parallax run --vary` prints: a line for each point.
class VaryTable {
 public:
  /// `grid` must outlive this object.
  VaryTable(const VaryGrid& grid, const RunOptions& options);

  std::string header() const;
  /// `limits`: what taking each away gains; none if that was not asked for.
  std::string row(std::size_t point, const EvaluationResult& result, const RelaxedLimits* limits) const;

 private:
  const VaryGrid& grid_;
  std::vector<std::size_t> widths_;  // of the axes' columns
  bool range_varies_;
  bool relaxed_;
};

}  // namespace parallax
