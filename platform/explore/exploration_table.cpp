// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/exploration_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "traces/number_text.hpp"

namespace parallax {
namespace {

std::string quoted(const std::string& field) {
  if (field.find_first_of(",\"\r\n") == std::string::npos) return field;
  std::string text = "\"";
  for (const char c : field) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + "\"";
}

// All digits; a reader's are number_text().
std::string field_of(const StoredResult& result, const std::string& metric) {
  const auto found = result.metrics.find(metric);
  if (found == result.metrics.end()) return "";
  if (const auto* number = std::get_if<double>(&found->second)) return fmt::format("{}", *number);
  const auto* const word = std::get_if<std::string>(&found->second);
  return word == nullptr ? "" : *word;
}

using Row = std::vector<std::string>;

}  // namespace

std::string csv_line(const std::vector<std::string>& fields) {
  std::string line;
  for (std::size_t i = 0; i < fields.size(); ++i) line += (i == 0 ? "" : ",") + quoted(fields[i]);
  return line + "\r\n";
}

std::string aligned(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i)
      text += fmt::format("{}{:>{}}", i == 0 ? "" : "  ", row[i], widths[i]);
    text += "\n";
  }
  return text;
}

ExplorationTable::ExplorationTable(const std::vector<std::string>& names,
                                   const std::vector<std::string>& metrics, ResultStore& store)
    : names_(names), metrics_(metrics), store_(store) {}

void ExplorationTable::csv(const ExplorationOutcome& outcome, bool front_only,
                           const std::function<void(const std::string&)>& line) const {
  Row head{"point"};
  head.insert(head.end(), names_.begin(), names_.end());
  head.insert(head.end(), {"status", "satisfied", "front", "limit"});
  for (const std::string& metric : metrics_) {
    const std::string unit = store_.unit(metric);
    head.push_back(unit.empty() ? metric : fmt::format("{} ({})", metric, unit));
  }
  head.insert(head.end(), {"configuration", "command", "message"});
  line(csv_line(head));
  store_.each_point(metrics_, [&](const StoredPoint& point) {
    const bool front = outcome.front.count(point.number) != 0;
    if (front_only && !front) return;
    const StoredResult& result = point.result;
    Row row{fmt::format("{}", point.number)};
    row.insert(row.end(), point.values.begin(), point.values.end());
    row.insert(row.end(), {result.status, outcome.satisfied.count(point.number) != 0 ? "yes" : "no",
                           front ? "yes" : "no", result.limit});
    for (const std::string& metric : metrics_) row.push_back(field_of(result, metric));
    row.insert(row.end(), {result.configuration, result.command, result.message});
    line(csv_line(row));
  });
}

std::string ExplorationTable::text(const std::set<std::size_t>& points, std::size_t most) const {
  Row head{"point"};
  head.insert(head.end(), names_.begin(), names_.end());
  head.insert(head.end(), metrics_.begin(), metrics_.end());
  head.emplace_back("limit");
  std::vector<Row> rows{head};
  store_.each_point(metrics_, [&](const StoredPoint& point) {
    if (points.count(point.number) == 0 || rows.size() > most) return;
    Row row{fmt::format("{}", point.number)};
    row.insert(row.end(), point.values.begin(), point.values.end());
    for (const std::string& metric : metrics_) {
      const auto found = point.result.metrics.find(metric);
      const auto* const number =
          found == point.result.metrics.end() ? nullptr : std::get_if<double>(&found->second);
      const std::string unit = store_.unit(metric);
      row.push_back(number == nullptr || unit.empty() ? field_of(point.result, metric)
                                                      : quantity_text(*number, unit));
    }
    row.push_back(point.result.limit);
    rows.push_back(std::move(row));
  });
  std::string text = aligned(rows);
  if (points.size() > most) text += fmt::format("and {} more\n", points.size() - most);
  return text;
}

nlohmann::ordered_json ExplorationTable::json(const std::set<std::size_t>& points) const {
  using Json = nlohmann::ordered_json;
  Json all = Json::array();
  store_.each_point(metrics_, [&](const StoredPoint& point) {
    if (points.count(point.number) == 0) return;
    Json settings = Json::object();
    for (std::size_t i = 0; i < names_.size(); ++i) settings[names_[i]] = point.values[i];
    Json metrics = Json::object();
    for (const std::string& metric : metrics_) {
      const auto found = point.result.metrics.find(metric);
      if (found == point.result.metrics.end()) continue;
      Json value;
      if (const auto* number = std::get_if<double>(&found->second)) value = *number;
      if (const auto* word = std::get_if<std::string>(&found->second)) value = *word;
      metrics[metric] = {{"value", value}, {"unit", store_.unit(metric)}};
    }
    all.push_back({{"point", point.number},
                   {"settings", settings},
                   {"limit", point.result.limit},
                   {"metrics", metrics},
                   {"configuration", point.result.configuration},
                   {"command", point.result.command}});
  });
  return all;
}

}  // namespace parallax
