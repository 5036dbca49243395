// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "platform/validation/validation.hpp"

namespace parallax {

/// How the predictions move with one fitted parameter: in percent of each, in the order of the rows.
struct Sensitivity {
  std::string key;
  std::string value;           ///< in the preset
  std::vector<double> lower;   ///< with 10 % less
  std::vector<double> higher;  ///< with 10 % more
};

/// The rows that a fitted parameter could move: those of a preset that has one, with a prediction.
std::vector<ValidatedRow> rows_with_fitted_parameters(const std::vector<ValidatedRow>& rows);

/// Evaluates those rows with every integer or real key that a row's preset tags as fitted, 10 % lower and 10
/// % higher than each row's own preset has it; rows whose preset has not fitted it do not move. What has not
/// been evaluated when interrupted does not move either.
std::vector<Sensitivity> sensitivities(const std::vector<ValidatedRow>& rows,
                                       const std::function<bool()>& interrupted);

std::string table(const std::vector<ValidatedRow>& rows, const std::vector<Sensitivity>& sensitivities);
nlohmann::ordered_json to_json(const std::vector<ValidatedRow>& rows,
                               const std::vector<Sensitivity>& sensitivities);

}  // namespace parallax
