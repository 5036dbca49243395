// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <systemc>
#include <vector>

#include "platform/config/machine_config.hpp"
#include "platform/machine/ethernet_link.hpp"
#include "platform/machine/memory_port.hpp"
#include "platform/machine/part.hpp"
#include "tlm/dma.hpp"

namespace parallax {

/// The host's side of the machine: the DMA engine that reads results, and the link that sends them. Without a
/// link the results stay in memory and count as sent when they are there.
class Transmission final : public sc_core::sc_module {
 public:
  /// Of images of `width` * `height` px.
  Transmission(const sc_core::sc_module_name& name, const MachineConfig& config, int width, int height,
               const ClockDomain& clock, Dataflow& dataflow);

  /// Sends results that are complete in memory. `sent` is called with their bytes (none without values) when
  /// the last one is on the wire.
  void start(DmaJob job, std::function<void(const std::vector<std::uint8_t>& bytes)> sent);

  const EthernetLink& link() const { return link_; }
  MemoryPort& port() { return port_; }
  /// The link and the host, unless the link is off.
  std::vector<Part> parts() const;

 private:
  const bool enabled_;
  DmaReader dma_;
  EthernetLink link_;
  Stream<std::uint8_t> bursts_;
  MemoryPort port_;
};

}  // namespace parallax
