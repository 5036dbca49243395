// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace parallax {

/// Cells of an FPGA. Block RAMs count in the family's smallest unit: a RAMB36 of the 7 series is two RAMB18.
struct Resources {
  std::int64_t logic_luts = 0;
  std::int64_t ram_luts = 0;    ///< LUTs that are RAM
  std::int64_t shift_luts = 0;  ///< LUTs that are shift registers
  std::int64_t registers = 0;
  std::int64_t block_rams = 0;
  std::int64_t dsps = 0;

  /// LUTs that only some of the device's can be.
  std::int64_t memory_luts() const { return ram_luts + shift_luts; }
  std::int64_t luts() const { return logic_luts + memory_luts(); }

  Resources& operator+=(const Resources& more) {
    logic_luts += more.logic_luts;
    ram_luts += more.ram_luts;
    shift_luts += more.shift_luts;
    registers += more.registers;
    block_rams += more.block_rams;
    dsps += more.dsps;
    return *this;
  }
};

inline Resources operator+(Resources a, const Resources& b) { return a += b; }

/// `copies` of a circuit.
inline Resources operator*(std::int64_t copies, const Resources& one) {
  return {copies * one.logic_luts, copies * one.ram_luts,   copies * one.shift_luts,
          copies * one.registers,  copies * one.block_rams, copies * one.dsps};
}

}  // namespace parallax
