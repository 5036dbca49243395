// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace parallax {

/// Which circuit a stream's FIFO is, that is by how many edges a token and a slot are delayed. With w the
/// edge that writes token i, and r the edge that reads token i - depth:
enum class FifoKind {
  /// Described by its two offsets, FifoConfig::write_to_read and read_to_write: token i is readable at
  /// w + write_to_read, its slot writable at r + read_to_write. Any FIFO whose delays do not depend on how
  /// full it is can be described so; the default, (1, 1), is a registered one. An offset of 0 is a
  /// combinational path and needs one clock on both sides. Between clocks, the first edge strictly after w
  /// (or r) counts as 1.
  kFree,
  /// Flags and data in registers. Readable at w + 1, writable at r + 1. One clock.
  kRegistered,
  /// An empty one hands on what is written in the same cycle. Readable at w, writable at r + 1. One clock.
  kFirstWordFallThrough,
  /// A RAM whose clocked read port is the output register. Readable at w + 2, writable at r + 1; the token in
  /// the output register counts towards the depth. One clock.
  kBlockRam,
  /// Gray-coded pointers, each synchronised to the other side by registers (SynchroniserStages) that the
  /// flags
  /// are derived from without a further one. The first edge of the other clock strictly after w (or r)
  /// captures the pointer; the token is readable, the slot writable, as many edges later as there are
  /// registers. Also where both clocks have the same frequency, or are one.
  kAsynchronous,
};

/// Registers that the pointers of an asynchronous FIFO pass: each way 1 to 63. What else delays a token, such
/// as registers behind the RAM, counts with those of its way.
struct SynchroniserStages {
  static constexpr std::uint32_t kMost = 63;
  std::uint32_t to_reader = 2;  ///< the write pointer, on its way to the reader
  std::uint32_t to_writer = 2;  ///< the read pointer, on its way to the writer
};

/// Delays of a FIFO, in edges of the clock of the side that waits.
struct FifoOffsets {
  std::uint32_t write_to_read;
  std::uint32_t read_to_write;
};

/// As in the configuration: "registered".
const char* name_of(FifoKind kind);

/// What the rule of a kind other than kFree comes to; `stages` matters to kAsynchronous only.
/// std::logic_error for kFree.
FifoOffsets offsets_of(FifoKind kind, const SynchroniserStages& stages);

}  // namespace parallax
