// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/transmission.hpp"

#include <memory>
#include <utility>

#include "modules/output_packing.hpp"
#include "platform/machine/engine_config.hpp"

namespace parallax {

Transmission::Transmission(const sc_core::sc_module_name& name, const MachineConfig& config, int width,
                           int height, const ClockDomain& clock, Dataflow& dataflow)
    : sc_module(name),
      enabled_(config.link.enabled),
      dma_("dma", engine_config(config.dma.link), clock),
      link_("link", config.link, Bytes(config.dma.link.burst_bytes), clock),
      bursts_("link_bursts", dataflow, clock, clock, engine_config(config.dma.link).fifo()),
      port_("link", "link", dma_, config.dma.link) {
  if (enabled_) port_.buffer = BufferKind::kOutput;
  port_.rows = std::make_shared<const RowEnds>(
      equal_rows(OutputPacking::row_bytes(width, config.link.output_left()), height, 1));
  dma_.out_bursts(bursts_);
  link_.in_bursts(bursts_);
}

std::vector<Part> Transmission::parts() const {
  if (!enabled_) return {};
  return {{PartKind::kLink, "link", "link.line_rate", {Relief::kLink, Relief::kLinkClock}},
          {PartKind::kHost, "host", "link.host_pixel_rate", {Relief::kHost}}};
}

void Transmission::start(DmaJob job, std::function<void(const std::vector<std::uint8_t>& bytes)> sent) {
  if (enabled_) {
    link_.start({job.bytes(), job.values, std::move(sent)});
    dma_.start(std::move(job));
    return;
  }
  std::vector<std::uint8_t> bytes;
  if (job.values) {
    bytes.resize(job.bytes());
    dma_.master.read_now(job.address, bytes.data(), bytes.size());
  }
  sent(bytes);
}

}  // namespace parallax
