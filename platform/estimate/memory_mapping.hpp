// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/estimate/device_file.hpp"
#include "platform/estimate/resources.hpp"

namespace parallax {

/// A memory of a circuit: simple dual port, one write and one read.
struct MemoryShape {
  std::int64_t words = 0;
  std::int64_t bits = 0;
  enum class Read {
    kRegistered,  ///< the word comes a cycle after its address: block RAM can have it
    kAtOnce,      ///< in the same cycle: LUT RAM or registers
  } read = Read::kRegistered;
  /// Whether a word may be written while it is read: in some families registers keep it then.
  bool may_collide = false;
};

/// What a memory is made of.
struct MemoryMapping {
  enum class Kind { kNone, kRegisters, kLutRam, kBlockRam } kind = Kind::kNone;
  Resources resources;
};

/// Primitives of one kind stand side by side for the width and behind each other for the depth (banks); the
/// shape of a primitive decides, not the number of bits. Among the family's kinds and shapes the one with
/// the least weight is taken: that of its primitives and of the multiplexers behind its banks (as yosys'
/// memory_libmap does, whose weights the 7-series file has). A memory without words or bits is none.
MemoryMapping map_memory(const MemoryShape& memory, const DeviceFile& device);

/// A delay of a whole number of steps without a place to read in between, `bits` wide: shift registers of
/// LUTs where the family has them (from three steps on), else registers.
Resources map_delay(std::int64_t steps, std::int64_t bits, const DeviceFile& device);

/// DSPs of an unsigned product: the longer operand is cut into the DSP's longer ones.
std::int64_t multipliers(std::int64_t bits, std::int64_t other_bits, const DeviceFile& device);

}  // namespace parallax
