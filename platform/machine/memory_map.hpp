// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "modules/map_codec.hpp"
#include "platform/config/machine_config.hpp"
#include "platform/machine/matcher_store.hpp"

namespace parallax {

/// Buffers in memory that one side fills and another empties, each of one image.
enum class BufferKind { kLeft, kRight, kOutput };

/// "left", "right", "output".
const char* name_of(BufferKind kind);

/// Where the buffers lie in memory, as MachineConfig::memory_map says.
struct MemoryMap {
  struct FrameBuffer {
    std::uint64_t left;
    std::uint64_t right;
  };
  std::vector<FrameBuffer> frames;     ///< rows of pixels in the cameras' format
  std::uint64_t map = 0;               ///< the compressed rectification map
  std::vector<std::uint64_t> outputs;  ///< packed results (modules/output_packing.hpp)
  std::uint64_t buffer = 0;            ///< MatcherStore, if anything is kept

  /// The buffers of a frame: they are used in turn.
  const FrameBuffer& images(std::int64_t frame) const { return frames[frame % frames.size()]; }
  std::uint64_t output(std::int64_t frame) const { return outputs[frame % outputs.size()]; }
  std::size_t number_of(BufferKind kind) const {
    return kind == BufferKind::kOutput ? outputs.size() : frames.size();
  }
};

/// Throws UserError when a buffer does not fit into the memory, or two overlap, with the arithmetic.
MemoryMap lay_out_memory(const MachineConfig& config, int width, int height, const EncodedMap& map,
                         const MatcherStore& store);

}  // namespace parallax
