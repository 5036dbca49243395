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
      bursts(&writer.in_bursts),
      direction(Direction::kWrites),
      slots(config.outstanding) {}

MemoryPort::MemoryPort(std::string name_, const char* engine, DmaReader& reader, const DmaPortConfig& config)
    : name(std::move(name_)),
      key(std::string("dma.") + engine),
      master(&reader.master),
      bursts(&reader.out_bursts),
      direction(Direction::kReads),
      slots(std::min(config.outstanding, engine_config(config).fifo_bursts)) {}

void MemoryPort::find_stage(const std::vector<StageInfo>& stages) {
  const StreamBase* const stream = bursts->streams().front();
  for (const StageInfo& info : stages) {
    for (unsigned of_stage = 0; of_stage < Stage::kMaxPorts; ++of_stage) {
      const std::vector<const StreamBase*> bound = direction == Direction::kReads
                                                       ? info.stage->input_streams(of_stage)
                                                       : info.stage->output_streams(of_stage);
      if (std::find(bound.begin(), bound.end(), stream) != bound.end()) stage = info;
    }
  }
}

Part MemoryPort::part() const {
  Part part{PartKind::kDmaEngine, "dma_" + name, key + ".outstanding", relieved_by};
  part.port = this;
  return part;
}

}  // namespace parallax
