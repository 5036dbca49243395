// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "platform/explore/exploration_outcome.hpp"

namespace parallax {

/// A line of CSV (RFC 4180).
std::string csv_line(const std::vector<std::string>& fields);

/// Rows of cells, the first of them titles, each column as wide as its widest cell.
std::string aligned(const std::vector<std::vector<std::string>>& rows);

/// Points as rows: for spreadsheets, for programs, and for a reader.
class ExplorationTable {
 public:
  /// `names`: of what varies. `metrics`: one column each. All must outlive this object.
  ExplorationTable(const std::vector<std::string>& names, const std::vector<std::string>& metrics,
                   ResultStore& store);

  /// CSV (RFC 4180): a header with units, then a line for each point, handed out one after the other.
  void csv(const ExplorationOutcome& outcome, bool front_only,
           const std::function<void(const std::string&)>& line) const;
  /// Lines of text for these points: at most `most`, then how many more there are.
  std::string text(const std::set<std::size_t>& points, std::size_t most) const;
  nlohmann::ordered_json json(const std::set<std::size_t>& points) const;

 private:
  const std::vector<std::string>& names_;
  const std::vector<std::string>& metrics_;
  ResultStore& store_;
};

}  // namespace parallax
