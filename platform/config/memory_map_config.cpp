// SPDX-License-Identifier: Apache-2.0
#include "platform/config/memory_map_config.hpp"

#include <string>

#include "platform/config/schema.hpp"

namespace parallax {

void describe(Schema& schema, MemoryMapConfig& config) {
  constexpr std::int64_t kTebibyte = 1ll << 40;
  const Provenance origin = chosen("not published");
  schema.integer("memory_map.alignment", config.alignment, {1, 1ll << 30}, "B",
                 "Buffers without an address of their own begin at multiples of this.", origin);
  const auto place = [&](const std::string& name, MemoryMapConfig::Place& field, const std::string& what,
                         bool several) {
    schema.integer("memory_map." + name + ".address", field.address, {MemoryMapConfig::kAutomatic, kTebibyte},
                   "B", "Address of " + what + "; -1: after the buffer before.", origin);
    if (!several) return;
    schema.integer("memory_map." + name + ".pitch", field.pitch, {0, kTebibyte}, "B",
                   "From one of these buffers to the next; 0: as close as memory_map.alignment allows.",
                   origin);
  };
  place("left", config.left, "the first left image", true);
  place("right", config.right, "the first right image", true);
  place("map", config.map, "the rectification map", false);
  place("output", config.output, "the first buffer of results", true);
  place("buffer", config.buffer, "what the matcher keeps in memory, if it does", false);
}

}  // namespace parallax
