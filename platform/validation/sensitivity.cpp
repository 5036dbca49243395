// SPDX-License-Identifier: Apache-2.0
#include "platform/validation/sensitivity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "platform/config/configuration.hpp"
#include "platform/config/preset.hpp"
#include "platform/results/percent_change.hpp"
#include "traces/number_text.hpp"

namespace parallax {
namespace {

constexpr double kStep = 0.1;

// Of the row's preset, unless the row or the user sets them.
std::vector<EffectiveKey> fitted_keys(const PublishedRow& row) {
  ConfigurationRequest request;
  request.preset = row.preset;
  request.assignments = row.assignments;
  std::vector<EffectiveKey> fitted;
  for (const EffectiveKey& key : load_configuration(request, preset_folders()).keys) {
    if (key.provenance.tag == Tag::kFitted) fitted.push_back(key);
  }
  return fitted;
}

std::string path_of(const EffectiveKey& key) { return key.section + "." + key.name; }

// The assignment that scales a number; nothing for what is none.
std::optional<std::string> scaled(const EffectiveKey& key, double factor) {
  const std::string path = path_of(key);
  if (const auto* integer = std::get_if<std::int64_t>(&key.value)) {
    return fmt::format("{}={}", path, std::llround(static_cast<double>(*integer) * factor));
  }
  if (const auto* real = std::get_if<double>(&key.value)) return fmt::format("{}={}", path, *real * factor);
  return std::nullopt;
}

// A row with its preset's own value of a fitted parameter scaled.
struct ScaledRow {
  std::size_t row;
  std::size_t key;
  double factor;
};

}  // namespace

std::vector<ValidatedRow> rows_with_fitted_parameters(const std::vector<ValidatedRow>& rows) {
  std::vector<ValidatedRow> moved;
  for (const ValidatedRow& row : rows) {
    if (row.predicted != 0 && !fitted_keys(row.row).empty()) moved.push_back(row);
  }
  return moved;
}

std::vector<Sensitivity> sensitivities(const std::vector<ValidatedRow>& rows,
                                       const std::function<bool()>& interrupted) {
  std::vector<Sensitivity> result;  // of each key that any row's preset has fitted
  std::vector<PublishedRow> scaled_rows;
  std::vector<ScaledRow> scalings;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    for (const EffectiveKey& key : fitted_keys(rows[row].row)) {
      if (!scaled(key, 1)) continue;
      auto known = std::find_if(result.begin(), result.end(),
                                [&](const Sensitivity& other) { return other.key == path_of(key); });
      if (known == result.end()) {
        const std::vector<double> unmoved(rows.size());
        known = result.insert(known, {path_of(key), to_toml(key.value), unmoved, unmoved});
      }
      for (const double factor : {1 - kStep, 1 + kStep}) {
        scalings.push_back({row, static_cast<std::size_t>(known - result.begin()), factor});
        scaled_rows.push_back(rows[row].row);
        scaled_rows.back().assignments.push_back(*scaled(key, factor));
      }
    }
  }
  const std::vector<ValidatedRow> moved = validate_rows(
      scaled_rows, [] {}, interrupted);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const ScaledRow& scaling = scalings[i];
    Sensitivity& sensitivity = result[scaling.key];
    (scaling.factor < 1 ? sensitivity.lower : sensitivity.higher)[scaling.row] =
        percent_change(rows[scaling.row].predicted, moved[i].predicted);
  }
  return result;
}

std::string table(const std::vector<ValidatedRow>& rows, const std::vector<Sensitivity>& sensitivities) {
  std::size_t width = 3;
  for (const ValidatedRow& row : rows) width = std::max(width, row.row.name.size());
  std::string lines = fmt::format("{:<{}}", "prediction, when fitted", width);
  for (const Sensitivity& s : sensitivities) lines += fmt::format("  {:>21}", s.key);
  lines += fmt::format("\n{:<{}}", "parameters change by", width);
  for (std::size_t i = 0; i < sensitivities.size(); ++i)
    lines += fmt::format("  {:>10} {:>10}", "-10 %", "+10 %");
  lines += '\n';
  for (std::size_t i = 0; i < rows.size(); ++i) {
    lines += fmt::format("{:<{}}", rows[i].row.name, width);
    for (const Sensitivity& s : sensitivities) {
      lines += fmt::format("  {:>8} % {:>8} %", change_text(s.lower[i], "%"), change_text(s.higher[i], "%"));
    }
    lines += '\n';
  }
  return lines;
}

nlohmann::ordered_json to_json(const std::vector<ValidatedRow>& rows,
                               const std::vector<Sensitivity>& sensitivities) {
  nlohmann::ordered_json tree = nlohmann::ordered_json::array();
  for (const Sensitivity& s : sensitivities) {
    nlohmann::ordered_json moved = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      moved.push_back(
          {{"row", rows[i].row.name}, {"lower_percent", s.lower[i]}, {"higher_percent", s.higher[i]}});
    }
    tree.push_back({{"key", s.key}, {"value", s.value}, {"step_percent", 100 * kStep}, {"rows", moved}});
  }
  return tree;
}

}  // namespace parallax
