// SPDX-License-Identifier: Apache-2.0
// A FIFO as a circuit with pins, as plain as it can be; of depth 0, wires.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <systemc>

namespace parallax::test {

class PinFifo final : public sc_core::sc_module {
 public:
  sc_core::sc_in<bool> clk{"clk"}, rst{"rst"};
  sc_core::sc_in<bool> in_valid{"in_valid"};
  sc_core::sc_out<bool> in_ready{"in_ready"};
  sc_core::sc_in<std::uint32_t> in_data{"in_data"};
  sc_core::sc_out<bool> out_valid{"out_valid"};
  sc_core::sc_in<bool> out_ready{"out_ready"};
  sc_core::sc_out<std::uint32_t> out_data{"out_data"};

  /// `falls_through`: an empty one hands on what comes in the same cycle. `ready_passes`: a full one takes a
  /// token in the cycle in which it hands one on.
  PinFifo(const sc_core::sc_module_name& name, std::size_t depth, bool falls_through, bool ready_passes)
      : sc_module(name), depth_(depth), falls_through_(falls_through), ready_passes_(ready_passes) {
    SC_HAS_PROCESS(PinFifo);
    SC_METHOD(clocked);
    sensitive << clk.pos();
    dont_initialize();
    SC_METHOD(combinational);
    sensitive << in_valid << in_data << out_ready << changed_;
  }

 private:
  void clocked() {
    if (rst) {
      held_.clear();
    } else {
      const bool writes = in_valid && in_ready;
      if (writes) held_.push_back(in_data);
      if (out_valid && out_ready) held_.pop_front();
    }
    changed_.notify(sc_core::SC_ZERO_TIME);
  }
  void combinational() {
    const bool wires = depth_ == 0;
    const bool through = held_.empty() && (wires || falls_through_);
    out_valid = !held_.empty() || (through && in_valid);
    out_data = through ? in_data.read() : held_.empty() ? 0xDEAD : held_.front();
    in_ready = held_.size() < depth_ || ((wires || ready_passes_) && out_ready);
  }

  const std::size_t depth_;
  const bool falls_through_;
  const bool ready_passes_;
  std::deque<std::uint32_t> held_;
  sc_core::sc_event changed_;
};

}  // namespace parallax::test
