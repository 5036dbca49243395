// SPDX-License-Identifier: Apache-2.0
#include "platform/config/configuration.hpp"

#include <fmt/format.h>

#include <cctype>

#include "platform/config/preset.hpp"
#include "platform/config/preset_file.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

bool mentions(const std::string& line, const std::string& key) {
  const auto part_of_key = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  for (auto at = line.find(key); at != std::string::npos; at = line.find(key, at + 1)) {
    const bool starts = at == 0 || (!part_of_key(line[at - 1]) && line[at - 1] != '.');
    const auto end = at + key.size();
    if (starts && (end == line.size() || !part_of_key(line[end]))) return true;
  }
  return false;
}

/// A struct that checks several fields knows their keys, but not who set them: " (matching.p1: my.toml:3)".
std::string origins_of(const std::string& line, const RawConfig& raw) {
  std::string origins;
  for (const auto& [key, value] : raw) {
    if (mentions(line, key))
      origins += fmt::format("{}{}: {}", origins.empty() ? "" : ", ", key, value.origin);
  }
  return origins.empty() ? "" : " (" + origins + ")";
}

RawValue iterations_for(std::int64_t range, const Schema& schema) {
  const std::string origin = fmt::format("--disparities {}", range);
  const auto parallelism = std::get<std::int64_t>(schema.find("matching.parallelism")->get());
  if (range <= 0 || range % parallelism != 0) {
    throw UserError(
        fmt::format("{}: must be a positive multiple of matching.parallelism = {}", origin, parallelism));
  }
  RawValue iterations;
  iterations.value = ConfigValue(range / parallelism);
  iterations.source = "command line";
  iterations.origin = origin;
  return iterations;
}

}  // namespace

Configuration load_configuration(const ConfigurationRequest& request,
                                 const std::vector<std::filesystem::path>& preset_folders) {
  Configuration result;
  result.preset = request.preset;
  Schema schema;
  describe(schema, result.machine);

  RawConfig raw = load_preset(request.preset, preset_folders);
  for (const std::string& assignment : request.assignments) {
    auto [key, value] = read_assignment(assignment);
    raw[key] = std::move(value);
  }
  schema.apply(raw);
  if (request.disparity_range) {
    // The range counts in the parallelism that is in effect by now.
    raw["matching.iterations"] = iterations_for(*request.disparity_range, schema);
    schema.apply(raw);
  }

  try {
    result.machine.validate();
  } catch (const UserError& error) {
    throw UserError(error.what() + origins_of(error.what(), raw));
  }
  result.keys = effective_keys(schema);
  return result;
}

std::vector<EffectiveKey> effective_keys(const Schema& schema) {
  std::vector<EffectiveKey> keys;
  for (const Key& key : schema.keys()) {
    keys.push_back(
        {key.section(), key.name(), key.get(), key.unit, key.expected(), key.documentation, key.provenance});
  }
  return keys;
}

}  // namespace parallax
