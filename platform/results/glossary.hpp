// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "traces/metric_table.hpp"

namespace parallax {

/// Every number that a run or `parallax memory` can write, from the tables that its values are written with:
/// its name, unit, what it means, and over what it is measured. What stands in angle brackets is a name.
std::string glossary_as_text();
std::string glossary_as_markdown();
nlohmann::ordered_json glossary_as_json();

/// The entry of a number that a run can write, "memory/map/bandwidth"; null if there is none of that name.
const MetricInfo* find_run_metric(std::string_view path);
/// The names of these, with angle brackets.
std::vector<std::string> run_metric_names();
/// The entry of a number of an estimate, "resources/lut"; null if there is none of that name.
const MetricInfo* find_estimate_metric(std::string_view path);

}  // namespace parallax
