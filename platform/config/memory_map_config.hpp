// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace parallax {

class Schema;

/// Where the buffers lie in memory. An address of kAutomatic is the first multiple of `alignment` after the
/// buffer before, in the order of the members.
struct MemoryMapConfig {
  static constexpr std::int64_t kAutomatic = -1;
  struct Place {
    std::int64_t address = kAutomatic;  ///< B, of the first of several buffers; own choice
    std::int64_t pitch =
        0;  ///< B from one buffer to the next; 0 = as close as the alignment allows; own choice
  };

  std::int64_t alignment = 4096;  ///< B, 1 to 1 GiB; own choice
  Place left;                     ///< left images as the camera writes them
  Place right;                    ///< right images
  Place map;                      ///< the rectification map, one buffer
  Place output;                   ///< results
  Place buffer;                   ///< what the matcher keeps in memory, one buffer
};

void describe(Schema& schema, MemoryMapConfig& config);

}  // namespace parallax
