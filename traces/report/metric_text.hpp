// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace parallax {

/// A number for a reader, thousands apart: "1,228,800", "4.26".
std::string number_text(double value, int digits);

/// A metric's value for a reader, with its unit: "1,228,800 cycles", "65.5 %", "4.906 ms". Empty where
/// `metric` is none.
std::string metric_text(const nlohmann::ordered_json& metric);

/// "a_name" as words.
std::string words(std::string_view name);

/// A metric of a tree by its path, such as "limit/part"; null where there is none.
const nlohmann::ordered_json* find_metric(const nlohmann::ordered_json& tree, std::string_view path);

/// Its value as a number; `otherwise` where there is none.
double metric_number(const nlohmann::ordered_json& tree, std::string_view path, double otherwise = 0);

/// Its value as a word; empty where there is none.
std::string metric_word(const nlohmann::ordered_json& tree, std::string_view path);

/// What it means; empty where there is none.
std::string metric_meaning(const nlohmann::ordered_json& tree, std::string_view path);

/// Whether this is a metric, not a group of them.
bool is_metric(const nlohmann::ordered_json& entry);

/// A name, with its meaning on hover.
std::string metric_term(const nlohmann::ordered_json& tree, std::string_view path, std::string_view word);

}  // namespace parallax
