// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "modules/map_codec.hpp"
#include "platform/config/machine_config.hpp"

namespace parallax {

/// Where the buffers lie in memory, each on a 4 KiB boundary, one after the other.
struct MemoryMap {
  struct FrameBuffer {
    std::uint64_t left;
    std::uint64_t right;
  };
  std::vector<FrameBuffer> frames;     ///< width * height bytes per image
  std::uint64_t map = 0;               ///< the compressed rectification map
  std::vector<std::uint64_t> outputs;  ///< packed results (modules/output_packing.hpp)
  std::uint64_t end = 0;               ///< first byte after all buffers
};

/// Throws UserError when the memory is too small, with the arithmetic.
MemoryMap lay_out_memory(const MachineConfig& config, int width, int height, const EncodedMap& map);

}  // namespace parallax
