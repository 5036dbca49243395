// SPDX-License-Identifier: Apache-2.0
#include "platform/registers/run_time_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "platform/config/schema.hpp"

namespace parallax {
namespace {

using M = MachineConfig;
constexpr auto kIterations = member<&M::matching, &MatchingConfig::iterations>();
constexpr auto kOffset = member<&M::matching, &MatchingConfig::disparity_offset>();
constexpr auto kP1 = member<&M::matching, &MatchingConfig::p1>();
constexpr auto kP2 = member<&M::matching, &MatchingConfig::p2>();
constexpr auto kMaskBorder = member<&M::subpixel, &SubpixelConfig::mask_border>();
constexpr auto kUniqueness = member<&M::uniqueness, &UniquenessConfig::enabled>();
constexpr auto kFactor = member<&M::uniqueness, &UniquenessConfig::factor>();
constexpr auto kConsistency = member<&M::consistency, &ConsistencyConfig::enabled>();
constexpr auto kConsistencyThreshold = member<&M::consistency, &ConsistencyConfig::threshold>();
constexpr auto kTexture = member<&M::texture, &TextureConfig::enabled>();
constexpr auto kTextureThreshold = member<&M::texture, &TextureConfig::threshold>();
constexpr auto kPasses = member<&M::speckle, &SpeckleConfig::iterations>();
constexpr auto kGaps = member<&M::gap_interpolation, &GapInterpolationConfig::enabled>();
constexpr auto kNoise = member<&M::noise_reduction, &NoiseReductionConfig::enabled>();

/// All keys with their ranges and documentation.
const Key& key(const std::string& path) {
  static const Schema schema = [] {
    static MachineConfig config;
    Schema all;
    describe(all, config);
    return all;
  }();
  const Key* found = schema.find(path);
  if (found == nullptr) throw std::logic_error("a run-time parameter names the key " + path);
  return *found;
}

bool as_built(const RunTimeParameter& p, const MachineConfig& asked, const MachineConfig& built) {
  return p.member.get(asked) == p.member.get(built);
}

bool at_most_as_built(const RunTimeParameter& p, const MachineConfig& asked, const MachineConfig& built) {
  return p.member.get(asked) <= p.member.get(built);
}

bool below_p2(const RunTimeParameter& p, const MachineConfig& asked, const MachineConfig&) {
  return p.member.get(asked) < asked.matching.p2;
}

bool in_range(const RunTimeParameter& p, const MachineConfig& asked, const MachineConfig&) {
  const IntegerRange range = key(p.key).integers;
  const std::int64_t value = p.member.get(asked);
  return value >= range.least && value <= range.most;
}

const ParameterRule kPenalties{"penalties", 0, "p1 was not below p2.", "", below_p2};
const ParameterRule kFixed{"range", 1, "Iterations or offset were not those of the machine.",
                           "Fixed when the machine is built.", as_built};
const ParameterRule kFactorRange{"uniqueness", 2, "The factor was above 16.", "At most 16.", in_range};
const ParameterRule kBuiltPasses{"speckle", 3, "More passes than were built.",
                                 "At most those that the machine was built with.", at_most_as_built};
const ParameterRule kBuiltParts{"switches", 4, "A part was switched on that was not built.", "",
                                at_most_as_built};

std::string documentation(const RunTimeParameter& parameter) {
  const Key& described = key(parameter.key);
  std::string text = parameter.key;
  if (parameter.offset != 0) text += fmt::format(" - {}", parameter.offset);
  if (!described.unit.empty()) text += ", unit: " + described.unit;
  text += ". " + described.documentation;
  const std::string rule = parameter.rule == nullptr ? "" : parameter.rule->documentation;
  return rule.empty() ? text : text + " " + rule;
}

}  // namespace

const std::vector<RunTimeParameter>& run_time_parameters() {
  constexpr const char* kOne = "algorithm_parameters_1";
  constexpr const char* kTwo = "algorithm_parameters_2";
  static const std::vector<RunTimeParameter> rows{
      // key, member, register, field, lowest bit, bits, offset, rule
      {"matching.iterations", kIterations, "control", "iterations", 8, 8, 1, &kFixed},
      {"matching.p1", kP1, kOne, "p1", 0, 8, 0, &kPenalties},
      {"matching.p2", kP2, kOne, "p2", 8, 8, 0, nullptr},
      {"uniqueness.factor", kFactor, kOne, "uniqueness", 16, 12, 256, &kFactorRange},
      {"texture.threshold", kTextureThreshold, kTwo, "texture", 0, 6, 0, nullptr},
      {"consistency.threshold", kConsistencyThreshold, kTwo, "consistency", 6, 4, 0, nullptr},
      {"matching.disparity_offset", kOffset, kTwo, "offset", 10, 8, 0, &kFixed},
      {"speckle.iterations", kPasses, kTwo, "speckle_iterations", 18, 3, 0, &kBuiltPasses},
      {"subpixel.mask_border", kMaskBorder, kTwo, "mask_border", 21, 1, 0, nullptr},
      {"uniqueness.enabled", kUniqueness, kTwo, "uniqueness_enable", 22, 1, 0, &kBuiltParts},
      {"consistency.enabled", kConsistency, kTwo, "consistency_enable", 23, 1, 0, &kBuiltParts},
      {"texture.enabled", kTexture, kTwo, "texture_enable", 24, 1, 0, &kBuiltParts},
      {"gap_interpolation.enabled", kGaps, kTwo, "gap_enable", 25, 1, 0, &kBuiltParts},
      {"noise_reduction.enabled", kNoise, kTwo, "noise_enable", 26, 1, 0, &kBuiltParts}};
  return rows;
}

std::vector<RegisterField> parameter_fields(const std::string& reg) {
  std::vector<RegisterField> fields;
  for (const RunTimeParameter& p : run_time_parameters()) {
    if (reg != p.reg) continue;
    fields.push_back({p.field, p.low, p.width, FieldAccess::kReadWrite, 0, documentation(p)});
  }
  return fields;
}

std::vector<RegisterField> parameter_error_fields() {
  std::map<unsigned, const ParameterRule*> rules;  // by bit
  for (const RunTimeParameter& p : run_time_parameters()) {
    if (p.rule == nullptr) continue;
    const ParameterRule* const first = rules.emplace(p.rule->bit, p.rule).first->second;
    if (first != p.rule) throw std::logic_error(fmt::format("two rules have the error bit {}", p.rule->bit));
  }
  std::vector<RegisterField> fields;
  for (const auto& [bit, rule] : rules) {
    fields.push_back({rule->error, bit, 1, FieldAccess::kWriteOneToClear, 0, rule->error_documentation});
  }
  return fields;
}

std::string run_time_remark(const std::string& path) {
  for (const RunTimeParameter& p : run_time_parameters()) {
    if (path != p.key || p.rule == &kFixed) continue;
    return fmt::format("May change from frame to frame: register stereo.{}, field {}.", p.reg, p.field);
  }
  return "";
}

void add_run_time_remarks(std::vector<EffectiveKey>& keys) {
  for (EffectiveKey& key : keys) {
    const std::string remark = run_time_remark(key.section + "." + key.name);
    if (!remark.empty()) key.documentation += " " + remark;
  }
}

}  // namespace parallax
