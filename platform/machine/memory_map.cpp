// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/memory_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "modules/output_packing.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

struct Region {
  std::string name;
  std::uint64_t begin;
  std::uint64_t bytes;
  std::uint64_t end() const { return begin + bytes; }
};

class Layout {
 public:
  explicit Layout(const MemoryMapConfig& config) : alignment_(config.alignment) {}

  /// Addresses of `number` buffers of `bytes` each.
  std::vector<std::uint64_t> place(const std::string& name, const MemoryMapConfig::Place& config,
                                   std::uint32_t number, std::uint64_t bytes) {
    const std::uint64_t begin = config.address == MemoryMapConfig::kAutomatic
                                    ? aligned(end_)
                                    : static_cast<std::uint64_t>(config.address);
    const std::uint64_t pitch = config.pitch == 0 ? aligned(bytes) : config.pitch;
    std::vector<std::uint64_t> addresses;
    for (std::uint32_t i = 0; i < number; ++i) {
      addresses.push_back(begin + i * pitch);
      regions_.push_back({number > 1 ? fmt::format("{} {}", name, i) : name, addresses.back(), bytes});
    }
    end_ = regions_.back().end();
    return addresses;
  }

  void check(std::uint64_t memory) {
    std::stable_sort(regions_.begin(), regions_.end(),
                     [](const Region& a, const Region& b) { return a.begin < b.begin; });
    for (std::size_t i = 1; i < regions_.size(); ++i) {
      const Region& first = regions_[i - 1];
      const Region& second = regions_[i];
      if (first.end() <= second.begin) continue;
      throw UserError(
          fmt::format("memory_map: {} at {:#x} with {} B reaches to {:#x}, beyond {} at {:#x}; set "
                      "memory_map.<name>.address "
                      "or .pitch",
                      first.name, first.begin, first.bytes, first.end(), second.name, second.begin));
    }
    for (const Region& region : regions_) {
      if (region.end() <= memory) continue;
      throw UserError(fmt::format("memory.size_bytes = {} is too small: {} at {:#x} with {} B ends at {}",
                                  memory, region.name, region.begin, region.bytes, region.end()));
    }
  }

 private:
  std::uint64_t aligned(std::uint64_t address) const {
    return (address + alignment_ - 1) / alignment_ * alignment_;
  }

  const std::uint64_t alignment_;
  std::uint64_t end_ = 0;  // of the last buffer placed
  std::vector<Region> regions_;
};

}  // namespace

const char* name_of(BufferKind kind) {
  switch (kind) {
    case BufferKind::kLeft:
      return "left";
    case BufferKind::kRight:
      return "right";
    case BufferKind::kOutput:
      return "output";
  }
  return "";
}

MemoryMap lay_out_memory(const MachineConfig& config, int width, int height, const EncodedMap& map,
                         const MatcherStore& store) {
  const std::uint64_t image = bytes_of(config.camera.format, width) * height;
  const std::uint64_t result = OutputPacking::row_bytes(width, config.link.output_left()) * height;
  const MemoryMapConfig& places = config.memory_map;
  Layout layout(places);
  const auto left = layout.place("left", places.left, config.camera.frame_buffers, image);
  const auto right = layout.place("right", places.right, config.camera.frame_buffers, image);
  MemoryMap result_map;
  for (std::size_t i = 0; i < left.size(); ++i) result_map.frames.push_back({left[i], right[i]});
  result_map.map = layout.place("map", places.map, 1, map.bytes.size()).front();
  result_map.outputs = layout.place("output", places.output, config.link.output_buffers, result);
  if (store.bytes() > 0) {
    result_map.buffer = layout.place("buffer", places.buffer, 1, store.bytes()).front();
  }
  layout.check(config.memory.size_bytes);
  return result_map;
}

}  // namespace parallax
