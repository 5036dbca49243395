// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "tlm/clock_domain.hpp"
#include "tlm/stream_base.hpp"

namespace parallax {

/// How tokens go in or out of a circuit at its pins, beside what follows from the pins that are bound
/// (PinSource, PinSink). Cycles are those of the circuit's clock.
struct PinConfig {
  static constexpr std::uint64_t kAll = ~std::uint64_t{0};

  /// PinSource: cycles from one token to the next, at least; as with a pixel strobe, one clock in so many. At
  /// least 1.
  std::uint64_t interval = 1;
  /// Tokens of a burst: it begins when all of them are there (PinSource), or all have room (PinSink), and
  /// then goes a token a cycle. At least 1.
  std::uint64_t burst = 1;
  std::uint64_t stall = 0;             ///< of 1000 cycles, those stalled at random, 0 to Stalls::kMost
  std::uint64_t seed = 1;              ///< of the stalls
  std::uint64_t not_ready_cycles = 0;  ///< from 0 on, those after reset in which no token passes
  std::uint64_t row_tokens = 0;        ///< of a row, for the pins `last`, `row` and `column`; 0: no rows
  std::uint64_t frame_tokens = 0;      ///< of a frame; 0: frames do not matter
  /// Tokens, from the first one on, that have values. The others, as of frames without images, are zeros at
  /// the pins, and nothing but their dates in a stream.
  std::uint64_t with_values = kAll;
  /// Tokens of zeros behind each frame, for a window that gives its last results only if more pixels come.
  std::uint64_t flush = 0;
  /// PinSink: results before the first one of each frame, which count for nothing.
  std::uint64_t skip = 0;
  /// PinSink without `valid`: edges from a token at the inputs to its result.
  std::uint64_t latency = 0;

  /// Throws UserError, naming the end (`where`), when a number is out of its range, or when what needs frames
  /// has none.
  void validate(const std::string& where) const;
};

/// Throws UserError, naming the end, when bursts of so many tokens do not fit into the stream.
void require_burst_fits(const std::string& where, std::uint64_t burst, const StreamBase& stream);
/// Likewise when the pins are clocked at another frequency than the stream's side.
void require_clock(const std::string& where, const ClockDomain& of_stream, const ClockDomain& of_pins);

}  // namespace parallax
