// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <systemc>
#include <vector>

#include "platform/config/link_config.hpp"
#include "tlm/cycle_accumulator.hpp"
#include "tlm/stream.hpp"

namespace parallax {

/// A frame's results on their way to the host.
struct LinkJob {
  std::uint64_t bytes = 0;
  bool values = true;
  /// Called when the last bit is on the wire, with the bytes (none without values).
  std::function<void(const std::vector<std::uint8_t>& bytes)> sent;
};

/// Ethernet link: cuts the results into packets and sends them at the line rate. A packet leaves when its
/// payload is there, the wire is free, and the host has taken the pixels before: the host's own rate is a
/// limit beside the line's, carried over from frame to frame. Dates of packets follow from those of the
/// bursts, so they are known ahead of time.
class EthernetLink final : public sc_core::sc_module, public Actor {
 public:
  StreamIn<std::uint8_t> in_bursts{"in_bursts"};

  EthernetLink(const sc_core::sc_module_name& name, const LinkConfig& config, Bytes burst,
               const ClockDomain& clock);

  void start(LinkJob job);

  std::uint64_t packets() const;  ///< that were begun until now
  Cycles wire_busy() const;       ///< cycles that packets were on the wire, until now
  Cycles host_busy() const;       ///< cycles that the host was taking pixels, until now

 private:
  struct Packet {
    Cycles begin;
    Cycles wire;  // how long it is on the wire
    Cycles host;  // how long the host takes its pixels
  };

  void advance() override;
  bool gather(std::uint64_t bytes);
  void send_packet(std::uint64_t payload);
  void finish_frame();
  Cycles passed(Cycles Packet::*time) const;

  const LinkConfig config_;
  const Bytes burst_;
  const ClockDomain& clock_;
  CycleAccumulator wire_;  // cycles a wire byte
  CycleAccumulator host_;  // cycles a payload byte
  std::deque<LinkJob> jobs_;
  sc_core::sc_event go_on_;
  std::deque<std::uint8_t> bytes_;
  bool sending_ = false;        // whether job_ is under way
  LinkJob job_;                 // the frame that is sent
  std::uint64_t received_ = 0;  // bytes of job_ that have been read
  std::uint64_t sent_ = 0;      // bytes of job_ that are in packets
  Cycles ready_{0};             // cycle of the last read or packet
  Cycles last_read_{-1};
  Cycles wire_free_{0};
  Cycles host_free_{0};
  std::deque<Packet> packets_;      // that were not over when the last one was sent
  std::uint64_t past_packets_ = 0;  // before packets_
  Cycles past_wire_;                // cycles on the wire of the packets before packets_
  Cycles past_host_;                // cycles in which the host took the pixels of these
};

}  // namespace parallax
