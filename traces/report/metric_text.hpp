// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "traces/metrics.hpp"

namespace parallax {

/// A number for a reader, thousands apart: "1,228,800", "4.26".
std::string number_text(double value, int digits);

/// A metric's value for a reader, with its unit: "1,228,800 cycles", "65.5 %", "4.906 ms", "[3, 1]".
std::string metric_text(const Metric& metric);

/// "a_name" as words.
std::string words(std::string_view name);

/// What a metric means, and over what it was measured; empty for null.
std::string metric_meaning(const Metric* metric);

/// A word of the page with the meaning, on hover, of the metric at a path.
std::string metric_term(const MetricGroup& tree, std::string_view path, std::string_view word);

}  // namespace parallax
