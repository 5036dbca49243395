// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "tlm/units.hpp"

namespace parallax {

/// An end of a stream at the pins of a circuit: PinSource, PinSink. In each cycle its PinClock calls drive(),
/// lets the circuit settle, and calls look() of all, can_step() of all and pass() of all.
class PinEnd {
 public:
  virtual ~PinEnd() = default;
  /// Puts on the pins that no token is there, and no room.
  virtual void idle() = 0;
  /// Puts on the pins what the stream allows in this cycle.
  virtual void drive(Cycles cycle) = 0;
  /// Looks at what the circuit answers. `steps`: edges at which it has gone on before.
  virtual void look(std::uint64_t steps) = 0;
  /// Whether the circuit may go on; where it may not, its clock stands. `with_all`: only with a token at each
  /// input.
  virtual bool can_step(bool with_all) const = 0;
  /// Passes the token, if there is one, with `cycle` as its date, unless the circuit stands. Whether it did.
  virtual bool pass(Cycles cycle, bool stands) = 0;
  /// Whether it knows a result by its place in time alone, as no pin says so: tokens must then go in
  /// together.
  virtual bool counts_steps() const = 0;
  /// Whether there will be nothing new for the circuit but by a date of the stream. If that is not known, the
  /// end calls PinClock::wake() when it is.
  virtual bool rests() = 0;
  /// That date, as a cycle of the circuit's clock, if it is known.
  virtual std::optional<Cycles> next() const = 0;
};

}  // namespace parallax
