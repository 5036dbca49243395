// SPDX-License-Identifier: Apache-2.0
#include "traces/report/page_text.hpp"

#include "traces/metric_text.hpp"
#include "traces/number_text.hpp"
#include "traces/report/html.hpp"

namespace parallax {

std::string page_number(double value, std::string_view unit) { return grouped(number_text(value, unit)); }

std::string page_number(const Metric& metric) {
  metric.number();
  return grouped(value_text(metric));
}

std::string plain_text(const Metric& metric) {
  return metric.is_number() ? grouped(metric_text(metric)) : metric_text(metric);
}

std::string page_text(const Metric& metric) { return escaped(plain_text(metric)); }

std::string page_number(const MetricGroup& tree, std::string_view path) {
  const Metric* const metric = tree.find(path);
  return metric == nullptr ? "" : page_number(*metric);
}

std::string page_text(const MetricGroup& tree, std::string_view path) {
  const Metric* const metric = tree.find(path);
  return metric == nullptr ? "" : page_text(*metric);
}

std::string metric_term(const MetricGroup& tree, std::string_view path, std::string_view word) {
  return term(word, metric_meaning(tree.find(path)));
}

}  // namespace parallax
