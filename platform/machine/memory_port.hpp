// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "platform/config/dma_config.hpp"
#include "platform/machine/memory_map.hpp"
#include "platform/machine/part.hpp"
#include "platform/machine/stage_info.hpp"
#include "tlm/dma.hpp"
#include "traces/row_ends.hpp"

namespace parallax {

/// A port of the memory, with the DMA engine that uses it: whose it is, which way its bytes go, and what they
/// are. Made by the module that holds the engine.
struct MemoryPort {
  enum class Direction { kWrites, kReads };

  /// Of an engine that writes, or that reads: `engine` is the one of `dma.<engine>.*` with `config`.
  MemoryPort(std::string name_, const char* engine, DmaWriter& writer, const DmaPortConfig& config);
  MemoryPort(std::string name_, const char* engine, DmaReader& reader, const DmaPortConfig& config);

  std::string name;        ///< in the memory's statistics: "camera_left"
  std::string key;         ///< its engine's keys: "dma.camera"
  BusMaster* master;       ///< the engine's requests
  StreamPort* bursts;      ///< the engine's other side
  Direction direction;     ///< seen from the engine
  std::uint32_t slots;     ///< requests that it can have under way: one that reads, as many as its FIFO holds
  std::size_t number = 0;  ///< among the memory's ports, in the order of binding
  /// Which buffers in memory it fills or empties; none for the map, for what the matcher keeps there, and for
  /// a link that is off.
  std::optional<BufferKind> buffer{};
  /// The limits without which its engine would be faster.
  std::vector<Relief> relieved_by{Relief::kMemory, Relief::kDma};
  /// Where the rows of an image end in its bytes, in the order in which the engine moves them.
  std::shared_ptr<const RowEnds> rows{};
  /// The core's stage at the engine's other end, from the start of the simulation on; none outside the core.
  std::optional<StageInfo> stage{};

  /// Whether it brings images from a camera.
  bool from_camera() const {
    return direction == Direction::kWrites && buffer.has_value() && *buffer != BufferKind::kOutput;
  }
  /// Sets `stage` to the one of `stages` that is bound to the engine's stream; when all is bound.
  void find_stage(const std::vector<StageInfo>& stages);
  /// Its engine, as a part that can limit the machine: "dma_camera_left".
  Part part() const;
};

}  // namespace parallax
