// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/bench/chain_load.hpp"

namespace parallax::bench {

/// The chain as control logic in SystemVerilog (tests/rtl/chain8.sv), run clock edge by clock edge in
/// Verilator, without SystemC around it. For the depths 2, 16 and 64. Throws std::runtime_error for any other
/// depth, and when a token is lost or overtaken.
ChainRun run_verilated(const ChainLoad& load);

}  // namespace parallax::bench
