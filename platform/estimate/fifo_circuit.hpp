// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/estimate/reference_circuits.hpp"
#include "tlm/fifo_kind.hpp"

namespace parallax {

struct FifoCircuit {
  FifoKind kind = FifoKind::kRegistered;
  std::int64_t depth = 16;  ///< tokens
  std::int64_t bits = 8;    ///< of a token
  /// Of kinds kAsynchronous and kFree: edges that each side sees the other one's pointer late.
  std::int64_t write_to_read = 1;
  std::int64_t read_to_write = 1;
};

/// A FIFO as the circuits of tests/rtl are: one that hands on a token in the cycle after the write at the
/// latest reads its memory in the same cycle, so that this is LUT RAM however deep it is; one of kind block
/// RAM reads it a cycle earlier. A depth of 0 is a wire.
CircuitEstimate fifo_circuit(const FifoCircuit& fifo, const DeviceFile& device);

}  // namespace parallax
