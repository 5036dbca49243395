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

std::vector<EffectiveKey> fitted_keys(const std::string& preset) {
  ConfigurationRequest request;
  request.preset = preset;
  std::vector<EffectiveKey> fitted;
  for (const EffectiveKey& key : load_configuration(request, preset_folders()).keys) {
    if (key.provenance.tag == Tag::kFitted) fitted.push_back(key);
  }
  return fitted;
}

// The assignment that scales a number; nothing for what is none.
std::optional<std::string> scaled(const EffectiveKey& key, double factor) {
  const std::string path = key.section + "." + key.name;
  if (const auto* integer = std::get_if<std::int64_t>(&key.value)) {
    return fmt::format("{}={}", path, std::llround(static_cast<double>(*integer) * factor));
  }
  if (const auto* real = std::get_if<double>(&key.value)) return fmt::format("{}={}", path, *real * factor);
  return std::nullopt;
}

std::vector<double> changes(const std::vector<ValidatedRow>& rows, const std::string& assignment,
                            const std::function<void()>& done, const std::function<bool()>& interrupted) {
  std::vector<PublishedRow> changed;
  for (const ValidatedRow& row : rows) {
    changed.push_back(row.row);
    changed.back().assignments.push_back(assignment);
  }
  const std::vector<ValidatedRow> results = validate_rows(changed, done, interrupted);
  std::vector<double> percent;
  for (std::size_t i = 0; i < results.size(); ++i) {
    percent.push_back(100 * (results[i].predicted / rows[i].predicted - 1));
  }
  return percent;
}

}  // namespace

std::vector<ValidatedRow> rows_with_fitted_parameters(const std::vector<ValidatedRow>& rows) {
  std::vector<ValidatedRow> moved;
  for (const ValidatedRow& row : rows) {
    if (row.predicted != 0 && !fitted_keys(row.row.preset).empty()) moved.push_back(row);
  }
  return moved;
}

std::vector<Sensitivity> sensitivities(const std::vector<ValidatedRow>& rows,
                                       const std::function<void()>& done,
                                       const std::function<bool()>& interrupted) {
  std::vector<Sensitivity> result;
  if (rows.empty()) return result;
  for (const EffectiveKey& key : fitted_keys(rows.front().row.preset)) {
    const std::optional<std::string> lower = scaled(key, 1 - kStep);
    const std::optional<std::string> higher = scaled(key, 1 + kStep);
    if (!lower || !higher) continue;
    Sensitivity sensitivity{
        key.section + "." + key.name, to_toml(key.value), changes(rows, *lower, done, interrupted), {}};
    sensitivity.higher = changes(rows, *higher, done, interrupted);
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
