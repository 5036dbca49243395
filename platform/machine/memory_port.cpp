// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/memory_port.hpp"

#include <algorithm>
#include <utility>

#include "platform/machine/engine_config.hpp"

namespace parallax {

MemoryPort::MemoryPort(std::string name_, const char* engine, DmaWriter& writer, const DmaPortConfig& config)
    : name(std::move(name_)),
      key(std::string("dma.") + engine),
      master(&writer.master),
      direction(Direction::kWrites),
      slots(config.outstanding) {}

MemoryPort::MemoryPort(std::string name_, const char* engine, DmaReader& reader, const DmaPortConfig& config)
    : name(std::move(name_)),
      key(std::string("dma.") + engine),
      master(&reader.master),
      direction(Direction::kReads),
      slots(std::min(config.outstanding, engine_config(config).fifo_bursts)) {}

Part MemoryPort::part() const {
  Part part{PartKind::kDmaEngine, "dma_" + name, key + ".outstanding", relieved_by};
  part.port = this;
  return part;
}

}  // namespace parallax
