// SPDX-License-Identifier: Apache-2.0
#include "platform/estimate/fifo_circuit.hpp"

#include <algorithm>
#include <cmath>

#include "platform/estimate/memory_mapping.hpp"

namespace parallax {
namespace {

// Bits of counts and pointers, and those of them that go to the other side.
struct Pointers {
  std::int64_t bits;
  std::int64_t seen;
};

Pointers pointers(const FifoCircuit& fifo) {
  const std::int64_t place = std::max(1, bits_of(fifo.depth));
  const std::int64_t count = bits_of(fifo.depth + 1);
  const std::int64_t wrapping = bits_of(2 * fifo.depth);
  switch (fifo.kind) {
    case FifoKind::kRegistered:
    case FifoKind::kFirstWordFallThrough:
      return {2 * place + count, 0};
    case FifoKind::kBlockRam:
      return {2 * place + 2 * count, 0};
    case FifoKind::kAsynchronous:
      // Places, counts and their Gray codes; the chains of registers.
      return {2 * place + 4 * wrapping, (fifo.write_to_read - 1 + fifo.read_to_write - 1) * wrapping};
    case FifoKind::kFree:
      return {2 * place + 2 * (count + 1), (std::max<std::int64_t>(fifo.write_to_read - 1, 0) +
                                            std::max<std::int64_t>(fifo.read_to_write - 1, 0)) *
                                               (count + 1)};
  }
  return {0, 0};
}

}  // namespace

CircuitEstimate fifo_circuit(const FifoCircuit& fifo, const DeviceFile& device) {
  CircuitEstimate made;
  if (fifo.depth <= 0 || fifo.bits <= 0) return made;
  const bool registered = fifo.kind == FifoKind::kBlockRam;
  const bool through = fifo.kind == FifoKind::kFirstWordFallThrough ||
                       (fifo.kind == FifoKind::kFree && fifo.write_to_read == 0);
  const Pointers all = pointers(fifo);
  made.logic.registers = all.bits + all.seen + (registered ? 1 : 0);
  const CircuitCosts& costs = device.costs;
  double luts = costs.fifo_base + costs.fifo_pointer_bit * static_cast<double>(all.bits);
  if (through) luts += costs.fifo_through_bit * static_cast<double>(fifo.bits);
  if (fifo.kind == FifoKind::kAsynchronous) {  // back from the Gray code, and a difference
    luts += costs.adder_bit * static_cast<double>(3 * bits_of(2 * fifo.depth));
  }
  made.logic.logic_luts = std::llround(luts);
  made.memories.push_back(
      {"memory", map_memory({fifo.depth, fifo.bits,
                             registered ? MemoryShape::Read::kRegistered : MemoryShape::Read::kAtOnce, true},
                            device)
                     .resources});
  return made;
}

}  // namespace parallax
