// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <systemc>
#include <vector>

#include "platform/config/machine_config.hpp"
#include "platform/machine/ethernet_link.hpp"
#include "platform/machine/frame_writer.hpp"
#include "platform/machine/memory_port.hpp"
#include "platform/machine/part.hpp"
#include "tlm/dma.hpp"

namespace parallax {

/// The results that are sent.
struct TransmissionInput {
  int width = 0;       ///< px, of an image
  int height = 0;      ///< px
  FrameWriter writer;  ///< which brings them into memory
};

/// The way to the host: the DMA engine that reads results, and the link that sends them. Without a link the
/// results stay in memory and count as sent when they are there.
class Transmission final : public sc_core::sc_module {
 public:
  /// Called when the last bit of a frame is on the wire, with its bytes (none without values).
  using Sent = std::function<void(std::int64_t frame, const std::vector<std::uint8_t>& bytes)>;

  Transmission(const sc_core::sc_module_name& name, const MachineConfig& config,
               const TransmissionInput& input, const ClockDomain& clock, Dataflow& dataflow, Sent sent);

  /// Sends the results of a frame, which lie at `address`: all of them, or while they come as far as
  /// link.early_start_rows says. Without `values` the time alone passes.
  void send(std::int64_t frame, std::uint64_t address, bool values);

  const EthernetLink& link() const { return link_; }
  MemoryPort& port() { return port_; }
  /// The link and the host, unless the link is off.
  std::vector<Part> parts() const;

 private:
  const bool enabled_;
  const TransmissionInput input_;
  const std::uint32_t row_bytes_;
  const Sent sent_;
  DmaReader dma_;
  EthernetLink link_;
  Stream<std::uint8_t> bursts_;
  MemoryPort port_;
};

}  // namespace parallax
