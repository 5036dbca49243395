// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "platform/cosim/fifo_signals.hpp"

namespace parallax {

/// The module of a FIFO, and how a test bench binds it.
struct FifoModule {
  using Bindings = std::vector<std::pair<std::string, std::string>>;

  std::string name;
  FifoSignals ports{};  ///< those that are not said have AXI-Stream's names, clk and rst
  bool has_reset = true;
  Bindings parameters{};   ///< name and value
  Bindings connections{};  ///< further ports and what they are connected to
};

/// Of what fifo_bench() writes.
constexpr const char* kFifoBench = "fifo_bench";

/// SystemVerilog: a test bench that stalls both sides of a FIFO at random, and writes the waves that
/// read_fifo_capture() reads. It needs no other file, and does the same in Icarus Verilog and Verilator.
std::string fifo_bench(const FifoModule& module);

}  // namespace parallax
