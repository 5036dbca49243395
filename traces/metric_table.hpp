// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "traces/metrics.hpp"

namespace parallax {

/// What a metric is: an entry of the glossary, and what is written beside each value of it.
struct MetricInfo {
  /// "memory/<port>/bandwidth": the groups that lead to it, and its name. What stands in angle brackets, once
  /// at most, is a name that the machine gives.
  std::string path;
  std::string unit;  ///< empty for a word
  /// Whole sentences. The path's angle brackets stand for the meaning of the name here.
  std::string description;
  std::string window;  ///< over what it is measured: "the steady state"; empty: it is no measurement
};

/// The window of most metrics, in the glossary; a run says which frames these are.
inline constexpr const char* kSteadyState = "the steady state";
inline constexpr const char* kWholeRun = "the whole run";

/// The metrics of one area.
class MetricTable {
 public:
  MetricTable(std::initializer_list<MetricInfo> rows) : rows_(rows) {}
  const std::vector<MetricInfo>& rows() const { return rows_; }
  /// Puts rows behind the others.
  void append(const std::vector<MetricInfo>& rows) { rows_.insert(rows_.end(), rows.begin(), rows.end()); }
  /// The row of a path. Throws std::logic_error: what is written has to be in the glossary.
  const MetricInfo& at(std::string_view path) const;

 private:
  std::vector<MetricInfo> rows_;
};

/// Writes the metrics of one area into a tree, each to where its row says and with the row's words.
class MetricWriter {
 public:
  MetricWriter(MetricGroup& root, const MetricTable& table) : root_(root), table_(table) {}

  /// The same for one of the things that a path's angle brackets stand for; `meaning` is what the name means.
  MetricWriter of(std::string name, std::string meaning = "") const;
  /// The same for values that were measured over this: "frames 8 to 9".
  MetricWriter over(std::string window) const;

  void add(std::string_view path, MetricValue value) const;
  /// A count, below 2^63; of this type and no other, so that nothing is rounded to it.
  template <class Count, class = std::enable_if_t<std::is_same_v<Count, std::uint64_t>>>
  void add(std::string_view path, Count count) const {
    add(path, MetricValue(static_cast<std::int64_t>(count)));
  }

 private:
  MetricGroup& root_;
  const MetricTable& table_;
  std::string name_;
  std::string meaning_;
  std::string window_;  // empty: as the table says
};

}  // namespace parallax
