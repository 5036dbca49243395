// SPDX-License-Identifier: Apache-2.0
#include "traces/report/metric_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "traces/report/html.hpp"

namespace parallax {

std::string number_text(double value, int digits) {
  std::string text = fmt::format("{:.{}f}", std::abs(value), digits);
  const std::size_t point = std::min(text.find('.'), text.size());
  for (std::size_t at = point; at > 3; at -= 3) text.insert(at - 3, ",");
  return (value < 0 ? "-" : "") + text;
}

std::string metric_text(const nlohmann::ordered_json& metric) {
  if (!is_metric(metric)) return "";
  const auto& value = metric.at("value");
  const std::string unit = metric.value("unit", "");
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_number()) return value.dump();
  const double x = value;
  const int digits = x == std::floor(x) ? 0 : unit == "%" ? 1 : std::abs(x) < 10 ? 3 : 1;
  return number_text(x, digits) + (unit.empty() ? "" : " " + unit);
}

std::string words(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

const nlohmann::ordered_json* find_metric(const nlohmann::ordered_json& tree, std::string_view path) {
  const nlohmann::ordered_json::json_pointer pointer("/" + std::string(path));
  if (!tree.is_object() || !tree.contains(pointer) || !is_metric(tree.at(pointer))) return nullptr;
  return &tree.at(pointer);
}

double metric_number(const nlohmann::ordered_json& tree, std::string_view path, double otherwise) {
  const auto* const metric = find_metric(tree, path);
  return metric != nullptr && (*metric).at("value").is_number() ? (*metric).at("value").get<double>()
                                                                : otherwise;
}

std::string metric_word(const nlohmann::ordered_json& tree, std::string_view path) {
  const auto* const metric = find_metric(tree, path);
  return metric != nullptr && (*metric).at("value").is_string() ? (*metric).at("value").get<std::string>()
                                                                : "";
}

std::string metric_meaning(const nlohmann::ordered_json& tree, std::string_view path) {
  const auto* const metric = find_metric(tree, path);
  if (metric == nullptr) return "";
  const std::string window = metric->value("window", "");
  return metric->value("description", "") + (window.empty() ? "" : " Over " + window + ".");
}

bool is_metric(const nlohmann::ordered_json& entry) {
  const auto is_word = [&](const char* key) { return !entry.contains(key) || entry.at(key).is_string(); };
  return entry.is_object() && entry.contains("value") && entry.contains("unit") && is_word("unit") &&
         is_word("description") && is_word("window");
}

std::string metric_term(const nlohmann::ordered_json& tree, std::string_view path, std::string_view word) {
  return term(word, metric_meaning(tree, path));
}

}  // namespace parallax
