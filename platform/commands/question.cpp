// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/question.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "platform/commands/exploration_metrics.hpp"
#include "platform/explore/judgement.hpp"
#include "tlm/error.hpp"
#include "traces/metric_text.hpp"
#include "traces/number_text.hpp"

namespace parallax {
namespace {

std::string trimmed(std::string word) {
  word.erase(0, word.find_first_not_of(' '));
  return word.substr(0, word.find_last_not_of(' ') + 1);
}

// "performance/frame_rate>=60".
Constraint read_hold(const std::string& text, const std::string& device) {
  const std::string where = fmt::format("--hold {}", excerpt(text));
  const std::size_t sign = text.find_first_of("<>");
  if (sign == std::string::npos || text.compare(sign + 1, 1, "=") != 0)
    throw UserError(where +
                    ": must have the form NUMBER>=VALUE or NUMBER<=VALUE, as performance/frame_rate>=60");
  Constraint constraint{trimmed(text.substr(0, sign)), {}, {}, where};
  const std::string number = trimmed(text.substr(sign + 2));
  double bound = 0;
  const auto [last, error] = std::from_chars(number.data(), number.data() + number.size(), bound);
  if (error != std::errc() || last != number.data() + number.size() || !std::isfinite(bound))
    throw UserError(fmt::format("{}: '{}' is no number", where, excerpt(number)));
  require_number(constraint.metric, device, where);
  (text[sign] == '>' ? constraint.at_least : constraint.at_most) = bound;
  return constraint;
}

}  // namespace

std::vector<Constraint> read_holds(const AskOptions& options) {
  std::vector<Constraint> all;
  for (const std::string& text : options.holds) all.push_back(read_hold(text, options.device));
  return all;
}

std::vector<std::string> names_of(const std::vector<Constraint>& holds) {
  std::vector<std::string> names;
  for (const Constraint& hold : holds) {
    if (std::find(names.begin(), names.end(), hold.metric) == names.end()) names.push_back(hold.metric);
  }
  return names;
}

bool holds(const std::vector<Constraint>& bounds, const EvaluationResult& result) {
  return std::all_of(bounds.begin(), bounds.end(), [&](const Constraint& bound) {
    return miss(bound, number_of(result, bound.metric)) == 0;
  });
}

std::optional<double> number_of(const EvaluationResult& result, const std::string& name) {
  const Metric* const metric = result.done() ? result.metrics.find(name) : nullptr;
  if (metric == nullptr) return std::nullopt;
  if (const bool* const truth = std::get_if<bool>(&metric->value)) return *truth ? 1 : 0;
  return metric->is_number() ? std::optional(metric->number()) : std::nullopt;
}

std::string said_of(const EvaluationResult& result, const std::vector<std::string>& names) {
  if (!result.done()) return fmt::format("{}: {}", name(result.status), result.advice());
  std::string text;
  for (const std::string& each : names) {
    const Metric* const metric = result.metrics.find(each);
    text += (text.empty() ? "" : ", ") + (names.size() > 1 ? each + " " : "") +
            (metric != nullptr ? metric_text(*metric) : "has no such number");
  }
  return text;
}

std::string bounds_text(const std::vector<Constraint>& bounds) {
  std::string text;
  for (const Constraint& bound : bounds) {
    const std::string unit = require_metric(bound.metric, bound.origin).unit;
    text += fmt::format(
        "{}{} {} {}", text.empty() ? "" : " and ", bound.metric, bound.at_least ? "at least" : "at most",
        with_unit(stated_text(bound.at_least ? *bound.at_least : *bound.at_most, unit), unit));
  }
  return text;
}

std::vector<std::string> cells_of(const EvaluationResult& result, const std::vector<std::string>& names) {
  std::vector<std::string> cells;
  for (const std::string& each : names) {
    const Metric* const metric = result.done() ? result.metrics.find(each) : nullptr;
    cells.push_back(metric != nullptr ? metric_text(*metric) : "-");
  }
  cells.push_back(result.done() ? result.limit.part
                                : fmt::format("{}: {}", name(result.status), result.advice()));
  return cells;
}

std::string table_text(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const std::vector<std::string>& row : rows) {
    // The last column ends where it does.
    for (std::size_t i = 0; i + 1 < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string lines;
  for (const std::vector<std::string>& row : rows) {
    for (std::size_t i = 0; i + 1 < row.size(); ++i) lines += fmt::format("{:>{}}  ", row[i], widths[i]);
    lines += row.back();
    lines.erase(lines.find_last_not_of(' ') + 1);
    lines += '\n';
  }
  return lines;
}

void add_numbers(nlohmann::ordered_json& tree, const EvaluationResult& result,
                 const std::vector<std::string>& names) {
  for (const std::string& each : names) {
    if (const std::optional<double> number = number_of(result, each)) tree[each] = *number;
  }
}

nlohmann::ordered_json units_of(const std::vector<std::string>& names) {
  nlohmann::ordered_json units = nlohmann::ordered_json::object();
  for (const std::string& each : names) units[each] = require_metric(each, each).unit;
  return units;
}

std::string run_command(const CommandLine& line, const AskOptions& options,
                        const std::vector<std::string>& words) {
  // What this command has beside the options of a run goes.
  std::vector<std::string> dropped{"ask", options.which, "--json"};
  dropped.insert(dropped.end(), options.subjects.begin(), options.subjects.end());
  return line.beginning({"run", "--timing-only", "--no-verdict"}, dropped)
      .with({"--hold", "--from", "--to", "--vary", "--device"}, words)
      .text();
}

}  // namespace parallax
