// SPDX-License-Identifier: Apache-2.0
#include "platform/memory_map.hpp"

#include <fmt/format.h>

#include "modules/output_packing.hpp"
#include "tlm/error.hpp"

namespace parallax {

MemoryMap lay_out_memory(const MachineConfig& config, int width, int height, const EncodedMap& map) {
  constexpr std::uint64_t kAlignment = 4096;
  MemoryMap layout;
  const auto place = [&layout](std::uint64_t bytes) {
    const std::uint64_t address = layout.end;
    layout.end += (bytes + kAlignment - 1) / kAlignment * kAlignment;
    return address;
  };
  const std::uint64_t image = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  const std::uint64_t result = OutputPacking::row_bytes(width) * static_cast<std::uint64_t>(height);
  for (std::uint32_t i = 0; i < config.camera.frame_buffers; ++i) {
    const std::uint64_t left = place(image);
    layout.frames.push_back({left, place(image)});
  }
  layout.map = place(map.bytes.size());
  for (std::uint32_t i = 0; i < config.link.output_buffers; ++i) layout.outputs.push_back(place(result));
  if (layout.end > static_cast<std::uint64_t>(config.memory.size_bytes)) {
    throw UserError(
        fmt::format("memory.size_bytes = {} is too small: {} frame buffers of 2 x {} B, a rectification map "
                    "of {} B and {} output "
                    "buffers of {} B need {} B",
                    config.memory.size_bytes, config.camera.frame_buffers, image, map.bytes.size(),
                    config.link.output_buffers, result, layout.end));
  }
  return layout;
}

}  // namespace parallax
