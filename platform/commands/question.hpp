// SPDX-License-Identifier: Apache-2.0
// What the questions of `parallax ask` have in common: bounds, numbers of results, and how they are said.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "platform/commands/ask.hpp"
#include "platform/commands/command_line.hpp"
#include "platform/evaluation/evaluation_result.hpp"
#include "platform/explore/exploration_spec.hpp"

namespace parallax {

/// --hold. Throws UserError: malformed, or of a number that there is not.
std::vector<Constraint> read_holds(const AskOptions& options);

/// Names of the numbers that these bounds are about.
std::vector<std::string> names_of(const std::vector<Constraint>& holds);

/// Whether all of them hold.
bool holds(const std::vector<Constraint>& bounds, const EvaluationResult& result);

/// Nothing where the result has no such number.
std::optional<double> number_of(const EvaluationResult& result, const std::string& name);

/// "90.48 fps"; of several numbers with their names; why there is none.
std::string said_of(const EvaluationResult& result, const std::vector<std::string>& names);

/// "performance/frame_rate at least 60 fps and memory/share at most 50 %".
std::string bounds_text(const std::vector<Constraint>& bounds);

/// Of these numbers one cell each, "-" where there is none; then what limits, or why there are none.
std::vector<std::string> cells_of(const EvaluationResult& result, const std::vector<std::string>& names);

/// Rows of cells, the first of them titles, as lines of text.
std::string table_text(const std::vector<std::vector<std::string>>& rows);

/// What there is of these in JSON: {"performance/frame_rate": 90.48}.
void add_numbers(nlohmann::ordered_json& tree, const EvaluationResult& result,
                 const std::vector<std::string>& names);
/// {"performance/frame_rate": "1/s"}.
nlohmann::ordered_json units_of(const std::vector<std::string>& names);

/// The line that runs one of the machines, which these words make of the one asked about.
std::string run_command(const CommandLine& line, const AskOptions& options,
                        const std::vector<std::string>& words);

}  // namespace parallax
