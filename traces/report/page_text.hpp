// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "traces/metrics.hpp"

namespace parallax {

/// number_text() with thousands apart, as it stands in a cell below a heading that has the unit.
std::string page_number(double value, std::string_view unit);

/// The same of a metric. Throws MetricError when it is no number.
std::string page_number(const Metric& metric);

/// metric_text() with thousands apart, "1,228,800 cycles", for what is escaped later.
std::string plain_text(const Metric& metric);

/// The same as HTML.
std::string page_text(const Metric& metric);

/// What they say of the metric at a path; empty where there is none.
std::string page_number(const MetricGroup& tree, std::string_view path);
std::string page_text(const MetricGroup& tree, std::string_view path);

/// A word of the page with the meaning, on hover, of the metric at a path.
std::string metric_term(const MetricGroup& tree, std::string_view path, std::string_view word);

}  // namespace parallax
