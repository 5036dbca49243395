// SPDX-License-Identifier: Apache-2.0
#include "traces/metric_text.hpp"

#include <algorithm>

#include "traces/json_text.hpp"
#include "traces/number_text.hpp"

namespace parallax {

std::string value_text(const Metric& metric) {
  if (std::holds_alternative<std::string>(metric.value)) return metric.word();
  if (std::holds_alternative<double>(metric.value)) return number_text(metric.number(), metric.unit);
  return json_text(to_json(metric).at("value"));
}

std::string metric_text(const Metric& metric) { return with_unit(value_text(metric), metric.unit); }

std::string filled_in(const MetricGroup& tree, std::string_view text) {
  std::string filled;
  for (;;) {
    const std::size_t open = text.find('{');
    filled += text.substr(0, open);
    if (open == std::string_view::npos) return filled;
    const std::size_t close = text.find('}', open);
    filled += metric_text(tree.at(text.substr(open + 1, close - open - 1)));
    text.remove_prefix(close + 1);
  }
}

// Who sends the results empties their buffers.
std::string end_of_way(const MetricGroup& tree) {
  return tree.find_group("buffers/output") == nullptr ? "results in memory" : "the host";
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

}  // namespace parallax
