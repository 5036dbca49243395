// SPDX-License-Identifier: Apache-2.0
#include "platform/validation/sensitivity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "platform/config/configuration.hpp"
#include "platform/config/preset.hpp"

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

// How each row's prediction changes when its preset's own value of a fitted parameter is scaled; not at all
// where that preset has not fitted it.
std::vector<double> changes(const std::vector<ValidatedRow>& rows, const std::string& path, double factor,
                            const std::function<void()>& done, const std::function<bool()>& interrupted) {
  std::vector<PublishedRow> changed;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (const EffectiveKey& key : fitted_keys(rows[i].row)) {
      const std::optional<std::string> assignment = scaled(key, factor);
      if (path_of(key) != path || !assignment) continue;
      changed.push_back(rows[i].row);
      changed.back().assignments.push_back(*assignment);
      places.push_back(i);
    }
  }
  std::vector<double> percent(rows.size());
  const std::vector<ValidatedRow> results = validate_rows(changed, done, interrupted);
  for (std::size_t i = 0; i < results.size(); ++i) {
    percent[places[i]] = 100 * (results[i].predicted / rows[places[i]].predicted - 1);
  }
  return percent;
}

}  // namespace

std::vector<ValidatedRow> rows_with_fitted_parameters(const std::vector<ValidatedRow>& rows) {
  std::vector<ValidatedRow> moved;
  for (const ValidatedRow& row : rows) {
    if (row.predicted != 0 && !fitted_keys(row.row).empty()) moved.push_back(row);
  }
  return moved;
}

std::vector<Sensitivity> sensitivities(const std::vector<ValidatedRow>& rows,
                                       const std::function<void()>& done,
                                       const std::function<bool()>& interrupted) {
  std::vector<Sensitivity> result;
  std::vector<EffectiveKey> keys;  // of any row
  for (const ValidatedRow& row : rows) {
    for (const EffectiveKey& key : fitted_keys(row.row)) {
      const bool known = std::any_of(keys.begin(), keys.end(), [&](const EffectiveKey& other) {
        return path_of(other) == path_of(key);
      });
      if (!known && scaled(key, 1)) keys.push_back(key);
    }
  }
  for (const EffectiveKey& key : keys) {
    const std::string path = path_of(key);
    Sensitivity sensitivity{path, to_toml(key.value), changes(rows, path, 1 - kStep, done, interrupted), {}};
    sensitivity.higher = changes(rows, path, 1 + kStep, done, interrupted);
    if (interrupted()) return result;
    result.push_back(std::move(sensitivity));
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
      lines += fmt::format("  {:>+8.2f} % {:>+8.2f} %", s.lower[i], s.higher[i]);
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
