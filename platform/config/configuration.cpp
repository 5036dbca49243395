// SPDX-License-Identifier: Apache-2.0
#include "platform/config/configuration.hpp"

#include <fmt/format.h>

#include <cctype>
#include <limits>

#include "platform/config/dram_device.hpp"
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
  constexpr std::int64_t kMost = 1'000'000;  // far beyond what any key allows
  if (range > kMost) throw UserError(fmt::format("{}: must be at most {}", origin, kMost));
  if (range <= 0 || range % parallelism != 0) {
    const std::int64_t below = range / parallelism * parallelism;
    throw UserError(
        fmt::format("{}: must be a positive multiple of matching.parallelism = {}; the nearest {}{}", origin,
                    parallelism, below > 0 ? fmt::format("are {} and ", below) : "is ",
                    std::max<std::int64_t>(0, below) + parallelism));
  }
  RawValue iterations;
  iterations.value = ConfigValue(range / parallelism);
  iterations.source = "command line";
  iterations.origin = origin;
  return iterations;
}

/// The devices that memory.device names; what is given for their keys otherwise wins.
void add_dram_device(RawConfig& raw, const std::vector<std::filesystem::path>& preset_folders) {
  const auto device = raw.find("memory.device");
  if (device == raw.end()) return;
  const auto* value = std::get_if<ConfigValue>(&device->second.value);
  const auto* name = value == nullptr ? nullptr : std::get_if<std::string>(value);
  if (name == nullptr || name->empty()) return;  // the schema says what is wrong
  try {
    RawConfig keys = read_dram_device(*name, preset_folders);
    raw.merge(keys);
  } catch (const UserError& error) {
    throw UserError(fmt::format("{}: memory.device: {}", device->second.origin, error.what()));
  }
}

/// A bus's speed means nothing to a DRAM, nor devices to a bus: who sets one of these together with the
/// model, or on top of it, is told. Beneath it they may stand, in a preset of another model that is inherited
/// from.
void refuse_keys_without_effect(const RawConfig& raw, const MachineConfig& machine, const Schema& effective) {
  const auto model = raw.find("memory.model");
  const int layer = model == raw.end() ? -1 : model->second.layer;
  const auto refuse = [&](const std::string& key, const std::string& instead) {
    const auto found = raw.find(key);
    if (found == raw.end() || found->second.layer < layer) return;
    throw UserError(fmt::format("{}: {} has no effect with memory.model = \"{}\"; set {}",
                                found->second.origin, key,
                                machine.memory.model == MemoryModel::kDram ? "dram" : "bus", instead));
  };
  const MachineConfig defaults;  // which a preset that lists all keys has, too
  if (machine.memory.model == MemoryModel::kBus) {
    if (machine.memory.device != defaults.memory.device) refuse("memory.device", "memory.model = \"dram\"");
    MachineConfig usual = defaults;
    Schema schema;
    describe(schema, usual);
    for (const auto& [key, value] : raw) {
      const Key* const known = key.rfind("dram.", 0) == 0 ? schema.find(key) : nullptr;
      if (known != nullptr && effective.find(key)->get() != known->get())
        refuse(key, "memory.model = \"dram\"");
    }
    return;
  }
  if (machine.memory.bytes_per_cycle != defaults.memory.bytes_per_cycle) {
    refuse("memory.bytes_per_cycle", "memory.device or dram.bus_bytes, or memory.model = \"bus\"");
  }
  if (machine.clocks.memory_hz != defaults.clocks.memory_hz) {
    refuse("clocks.memory_hz", "memory.device or dram.clock_period_ps, or memory.model = \"bus\"");
  }
}

}  // namespace

Configuration load_configuration(const ConfigurationRequest& request,
                                 const std::vector<std::filesystem::path>& preset_folders) {
  Configuration result;
  result.preset = request.preset;
  Schema schema;
  describe(schema, result.machine);

  RawConfig raw = load_preset(request.preset, preset_folders);
  constexpr int kTop = std::numeric_limits<int>::max();
  const auto assign = [&raw](const std::vector<std::string>& assignments, int layer) {
    for (const std::string& assignment : assignments) {
      auto [key, value] = read_assignment(assignment);
      value.layer = layer;
      raw[key] = std::move(value);
    }
  };
  assign(request.assignments, kTop - 1);
  assign(request.changes, kTop);
  const RawConfig given = raw;
  add_dram_device(raw, preset_folders);
  schema.apply(raw);
  refuse_keys_without_effect(given, result.machine, schema);
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
