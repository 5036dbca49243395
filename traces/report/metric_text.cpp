// SPDX-License-Identifier: Apache-2.0
#include "traces/report/metric_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "traces/json_text.hpp"
#include "traces/report/html.hpp"

namespace parallax {

std::string number_text(double value, int digits) {
  std::string text = fmt::format("{:.{}f}", std::abs(value), digits);
  const std::size_t point = std::min(text.find('.'), text.size());
  for (std::size_t at = point; at > 3; at -= 3) text.insert(at - 3, ",");
  return (value < 0 ? "-" : "") + text;
}

std::string metric_text(const Metric& metric) {
  if (std::holds_alternative<std::string>(metric.value)) return metric.word();
  if (!metric.is_number()) return json_text(to_json(metric).at("value"));
  const double x = metric.number();
  const int digits = x == std::floor(x) ? 0 : metric.unit == "%" ? 1 : std::abs(x) < 10 ? 3 : 1;
  return number_text(x, digits) + (metric.unit.empty() ? "" : " " + metric.unit);
}

std::string words(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string metric_meaning(const Metric* metric) {
  if (metric == nullptr) return "";
  return metric->description + (metric->window.empty() ? "" : " Over " + metric->window + ".");
}

std::string metric_term(const MetricGroup& tree, std::string_view path, std::string_view word) {
  return term(word, metric_meaning(tree.find(path)));
}

}  // namespace parallax
