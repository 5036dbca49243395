// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "platform/cosim/circuit_pins.hpp"
#include "platform/cosim/vector_manifest.hpp"
#include "tlm/units.hpp"

namespace parallax {

/// Whether the start of frame and the end of line that a circuit puts beside an output's tokens (AXI4-Stream
/// video: tuser[0], tlast) are where they belong, as on the inputs: `first` with the first token of a frame,
/// or of a tile; `last` with the last one of each row, or of each frame or tile alone, as the end of the very
/// first row shows. A stream that knows no rows has no `last`.
class CircuitFraming {
 public:
  /// All must outlive it.
  CircuitFraming(const VectorManifest& stage, const VectorStream& stream, const PortPins& pins)
      : stage_(stage), stream_(stream), pins_(pins) {}

  /// Where token number `token` of the stream passes, by what is on the pins.
  void look(std::uint64_t token, Cycles cycle);
  /// The first that was not; empty: none.
  const std::string& breach() const { return breach_; }

 private:
  void tell(const PinBits& pin, const std::string& where, std::uint64_t token, Cycles cycle);

  const VectorManifest& stage_;
  const VectorStream& stream_;
  const PortPins& pins_;
  bool row_has_ended_ = false;  // one that a frame goes on behind
  bool each_row_ = false;       // `last` is 1 with the last token of each row
  std::string breach_;
};

}  // namespace parallax
