// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "traces/metrics.hpp"

namespace parallax {

/// A metric's value for a reader, without its unit: as number_text() says, but a count, a word or a row of
/// numbers as it is.
std::string value_text(const Metric& metric);

/// The same with its unit: "65.5 %", "4.906 ms", "1228800 cycles", "100.26 fps".
std::string metric_text(const Metric& metric);

/// `text` with what metric_text() says of the metric at each path that stands in braces: "at
/// {limit/utilisation} of the time". Throws MetricError when there is none.
std::string filled_in(const MetricGroup& tree, std::string_view text);

/// Where a frame's way ends: "the host", but "results in memory" in a machine whose link is off.
std::string end_of_way(const MetricGroup& tree);

/// "a_name" as words.
std::string words(std::string_view name);

/// What a metric means, and over what it was measured; empty for null.
std::string metric_meaning(const Metric* metric);

}  // namespace parallax
