// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "platform/validation/published_row.hpp"
#include "traces/metrics.hpp"

namespace parallax {

/// A published figure beside what the model says.
struct ValidatedRow {
  PublishedRow row;
  double predicted = 0;  ///< in the row's unit
  double deviation = 0;  ///< percent of the published figure
  std::string limit;     ///< the limiting part, or why the machine refuses or cannot do it
  bool within = false;   ///< the deviation is in the row's interval, or what had to be refused was
};

/// Evaluates the machine of every row (rows that differ in the metric alone share one) and compares. `done`
/// is called after each row; `interrupted` is asked while machines are evaluated. Throws UserError for a row
/// that is no configuration at all. When interrupted it returns the rows until then.
std::vector<ValidatedRow> validate_rows(const std::vector<PublishedRow>& rows,
                                        const std::function<void()>& done,
                                        const std::function<bool()>& interrupted);

/// What `metrics` (timing.json) say of the row's figure, in its unit. Throws UserError, naming the row, when
/// they do not have it or have it in another unit.
double predicted(const PublishedRow& row, const MetricGroup& metrics);

bool all_within(const std::vector<ValidatedRow>& rows);
std::string table(const std::vector<ValidatedRow>& rows);
nlohmann::ordered_json to_json(const std::vector<ValidatedRow>& rows);

}  // namespace parallax
