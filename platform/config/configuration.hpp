// SPDX-License-Identifier: Apache-2.0
// From what the user wrote to the validated configuration of a machine.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "platform/config/machine_config.hpp"
#include "platform/config/schema.hpp"

namespace parallax {

/// What the user asked for. Later ones win: preset, then assignments in order, then changes in order, then
/// the disparity range.
struct ConfigurationRequest {
  std::string preset = "scenescan-pro";
  std::vector<std::string> assignments;         ///< "key=value"
  std::optional<std::int64_t> disparity_range;  ///< disparities, a multiple of matching.parallelism
  /// Assignments made on top, to another machine, for which what the user asked for need not make sense.
  std::vector<std::string> changes{};
};

/// A key as it is in effect.
struct EffectiveKey {
  std::string section;
  std::string name;
  ConfigValue value;
  std::string unit;
  std::string expected;  ///< what values it takes
  std::string documentation;
  Provenance provenance;
};

/// The validated configuration, and each key as it is in effect.
struct Configuration {
  std::string preset;
  MachineConfig machine;
  std::vector<EffectiveKey> keys;
};

/// Throws UserError, one line, at the first fault.
Configuration load_configuration(const ConfigurationRequest& request,
                                 const std::vector<std::filesystem::path>& preset_folders);

/// The keys of a configuration struct as they are in effect.
std::vector<EffectiveKey> effective_keys(const Schema& schema);

}  // namespace parallax
