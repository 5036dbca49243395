// SPDX-License-Identifier: Apache-2.0
#include "platform/config/configuration_hash.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <map>

#include "platform/config/schema.hpp"

namespace parallax {

std::string configuration_hash(const MachineConfig& config) {
  MachineConfig copy = config;
  Schema schema;
  describe(schema, copy);
  std::map<std::string, std::string> values;  // sorted by key
  for (const Key& key : schema.keys()) values[key.path] = to_toml(key.get());
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const auto& [path, value] : values) {
    for (const char c : path + " = " + value + "\n") {
      hash ^= static_cast<unsigned char>(c);
      hash *= 0x100000001b3;
    }
  }
  return fmt::format("{:016x}", hash);
}

}  // namespace parallax
