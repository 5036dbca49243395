// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/transmission.hpp"

#include <cstddef>
#include <memory>
#include <utility>

#include "modules/output_packing.hpp"
#include "platform/machine/engine_config.hpp"

namespace parallax {

Transmission::Transmission(const sc_core::sc_module_name& name, const MachineConfig& config,
                           const TransmissionInput& input, const ClockDomain& clock, Dataflow& dataflow,
                           Sent sent)
    : sc_module(name),
      enabled_(config.link.enabled),
      input_(input),
      row_bytes_(
          static_cast<std::uint32_t>(OutputPacking::row_bytes(input.width, config.link.output_left()))),
      sent_(std::move(sent)),
      dma_("dma", engine_config(config.dma.link), clock),
      link_("link", config.link, Bytes(config.dma.link.burst_bytes), clock),
      bursts_("link_bursts", dataflow, clock, clock, engine_config(config.dma.link).fifo()),
      port_("link", "link", dma_, config.dma.link) {
  if (enabled_) port_.buffer = BufferKind::kOutput;
  port_.rows = std::make_shared<const RowEnds>(equal_rows(row_bytes_, input.height, 1));
  dma_.out_bursts(bursts_);
  link_.in_bursts(bursts_);
}

std::vector<Part> Transmission::parts() const {
  if (!enabled_) return {};
  return {{PartKind::kLink, "link", "link.line_rate", {Relief::kLink, Relief::kLinkClock}},
          {PartKind::kHost, "host", "link.host_pixel_rate", {Relief::kHost}}};
}

void Transmission::send(std::int64_t frame, std::uint64_t address, bool values) {
  DmaJob job;
  job.address = address;
  job.row_bytes.assign(input_.height, row_bytes_);
  job.values = values;
  if (enabled_) {
    input_.writer.lead(job, frame);
    link_.start({job.bytes(), values,
                 [this, frame](const std::vector<std::uint8_t>& bytes) { sent_(frame, bytes); }});
    dma_.start(std::move(job));
    return;
  }
  std::vector<std::uint8_t> bytes;
  if (values) {
    bytes.resize(job.bytes());
    dma_.master.read_now(job.address, bytes.data(), bytes.size());
  }
  sent_(frame, bytes);
}

}  // namespace parallax
