// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <systemc>
#include <vector>

#include "platform/config/link_config.hpp"
#include "tlm/pacer.hpp"
#include "tlm/stream.hpp"

namespace parallax {

/// A frame's results on their way to the host.
struct LinkJob {
  std::uint64_t bytes = 0;
  bool values = true;
  /// Called when the last bit is on the wire, with the bytes (none without values) and that time.
  std::function<void(const std::vector<std::uint8_t>& bytes)> sent;
};

/// Ethernet link: cuts the results into packets and sends them at the line rate. A packet leaves when its
/// payload is there, the wire is free, and the host has taken the pixels before: the host's own rate is a
/// limit beside the line's, carried over from frame to frame.
class EthernetLink final : public sc_core::sc_module {
 public:
  StreamIn<std::uint8_t> in_bursts{"in_bursts"};

  EthernetLink(const sc_core::sc_module_name& name, const LinkConfig& config, Bytes burst,
               const ClockDomain& clock);

  void start(LinkJob job);

  std::uint64_t packets() const { return packets_; }
  Cycles wire_busy() const;  ///< cycles that packets were on the wire, until now
  Cycles host_busy() const;  ///< cycles that the host was taking pixels, until now

 private:
  void run();
  void finish_frame();

  const LinkConfig config_;
  const Bytes burst_;
  const ClockDomain& clock_;
  Pacer wire_;  // cycles a wire byte
  Pacer host_;  // cycles a payload byte
  std::deque<LinkJob> jobs_;
  sc_core::sc_event started_;
  std::deque<std::uint8_t> bytes_;
  std::uint64_t packets_ = 0;
  LinkJob job_;  // under way; a member, because a thread that never ends frees nothing
  Cycles wire_free_{0};
  Cycles host_free_{0};
  Cycles wire_busy_;
  Cycles host_busy_;
};

}  // namespace parallax
