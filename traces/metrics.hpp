// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace parallax {

/// A metric that is asked for is missing or of another kind. In what this program has measured that is a bug,
/// in what was read from a file the file is damaged: who knows the file's name catches it.
class MetricError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

using MetricValue = std::variant<std::int64_t, double, std::string, bool, std::vector<std::int64_t>>;

/// One number (or word, or row of numbers) of a result, with all that a reader needs to understand it.
struct Metric {
  std::string name;
  MetricValue value;
  std::string unit;         ///< empty for a word
  std::string description;  ///< whole sentences
  std::string window;       ///< over what it was measured, for example "frames 2 to 4"

  bool is_number() const;
  /// The value, whole or not. Throws MetricError when it is no number, as the next two do.
  double number() const;
  std::int64_t count() const;       ///< of a whole number
  const std::string& word() const;  ///< of a text
};

/// Results of one thing (MetricWriter writes them), which may consist of further things. Text and JSON are
/// made from this one tree, and JSON is read back into it. A path such as "memory/map/bytes_per_frame" leads
/// to a metric.
struct MetricGroup {
  std::string name;
  std::vector<Metric> metrics;
  std::vector<MetricGroup> groups;

  MetricGroup& group(const std::string& group_name);

  /// The metric at a path, or null.
  const Metric* find(std::string_view path) const;
  /// The group at a path such as "memory/map", or null.
  const MetricGroup* find_group(std::string_view path) const;

  /// What is at a path; each throws MetricError, which names the path.
  const Metric& at(std::string_view path) const;
  const MetricGroup& group_at(std::string_view path) const;
  double number(std::string_view path) const;
  std::int64_t count(std::string_view path) const;
  const std::string& word(std::string_view path) const;

  /// The same, and `otherwise` where no metric is.
  double number_or(std::string_view path, double otherwise) const;
  std::string word_or(std::string_view path, const std::string& otherwise) const;
};

/// A group is an object of its metrics and groups; a metric is an object of value, unit, description and
/// window.
nlohmann::ordered_json to_json(const MetricGroup& group);
nlohmann::ordered_json to_json(const Metric& metric);

/// The tree that to_json() has written; a number that JSON cannot hold, and is null there, becomes NaN. What
/// is neither metric nor object is left out. Throws MetricError where a metric has no value, no unit, or one
/// of another kind.
MetricGroup metrics_of(const nlohmann::ordered_json& tree);

}  // namespace parallax
