// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

namespace parallax {

/// One number (or word, or row of numbers) of a result, with all that a reader needs to understand it.
struct Metric {
  std::string name;
  std::variant<std::int64_t, double, std::string, bool, std::vector<std::int64_t>> value;
  std::string unit;         ///< empty for a word
  std::string description;  ///< one sentence
  std::string window;       ///< over what it was measured, for example "frames 2 to 4"
};

/// Results of one thing, which may consist of further things. Text and JSON are made from this one tree.
struct MetricGroup {
  std::string name;
  std::vector<Metric> metrics;
  std::vector<MetricGroup> groups;

  MetricGroup& group(const std::string& group_name);
  void add(Metric metric) { metrics.push_back(std::move(metric)); }
  /// The metric at a path such as "memory/map/bytes_per_frame"; throws std::out_of_range when there is none.
  const Metric& at(const std::string& path) const;
  /// The same, or null.
  const Metric* find(const std::string& path) const;
};

/// A group is an object of its metrics and groups; a metric is an object of value, unit, description and
/// window.
nlohmann::ordered_json to_json(const MetricGroup& group);

}  // namespace parallax
