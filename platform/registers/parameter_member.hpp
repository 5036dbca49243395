// SPDX-License-Identifier: Apache-2.0
// What a run-time parameter is bound to: a field of the machine's configuration.
#pragma once

#include <type_traits>

#include "platform/config/filter_of.hpp"
#include "platform/config/machine_config.hpp"

namespace parallax {

/// A field of the configuration that software can change; a boolean is 0 or 1.
struct ParameterMember {
  int (*get)(const MachineConfig& config);
  void (*set)(MachineConfig& config, int value);
};

/// A field of a member of MachineConfig: member<&MachineConfig::matching, &MatchingConfig::p1>().
template <auto kPart, auto kField>
constexpr ParameterMember member() {
  return {[](const MachineConfig& config) { return int{(config.*kPart).*kField}; },
          [](MachineConfig& config, int value) {
            auto& field = (config.*kPart).*kField;
            field = static_cast<std::remove_reference_t<decltype(field)>>(value);
          }};
}

/// A field of the configuration that a filter keeps itself:
/// filter_member<OwnFilterConfig, &OwnFilterConfig::reach>(). Its two functions throw std::logic_error for a
/// machine without that filter.
template <class Config, auto kField>
constexpr ParameterMember filter_member() {
  return {
      [](const MachineConfig& config) { return int{kept_part<KeptConfig<Config>>(config).function.*kField}; },
      [](MachineConfig& config, int value) {
        auto& field = kept_part<KeptConfig<Config>>(config).function.*kField;
        field = static_cast<std::remove_reference_t<decltype(field)>>(value);
      }};
}

}  // namespace parallax
