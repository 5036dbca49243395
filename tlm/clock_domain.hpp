// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <systemc>

#include "tlm/ratio.hpp"
#include "tlm/units.hpp"

namespace parallax {

/// A clock of exact integer frequency. Edge n happens at n / frequency; all domains have an edge 0 at time 0.
///
/// Dates are counted in integer cycles. Crossing to another domain is rational arithmetic, so nothing drifts;
/// a date becomes an `sc_time` (rounded down to the picosecond, from the absolute count) only to wait in the
/// kernel.
class ClockDomain {
 public:
  /// Throws UserError unless 1 Hz <= frequency <= 1 THz.
  ClockDomain(std::string name, Hertz frequency);

  const std::string& name() const { return name_; }
  Hertz frequency() const { return frequency_; }

  /// Kernel time of edge `cycle` (>= 0).
  Picoseconds date_of(Cycles cycle) const { return Picoseconds(period_.floor(cycle.size())); }
  sc_core::sc_time time_of(Cycles cycle) const { return sc_core::sc_time::from_value(date_of(cycle).size()); }
  /// First edge not before kernel time `time`. `cycle_at_or_after(time_of(n)) == n`.
  Cycles cycle_at_or_after(const sc_core::sc_time& time) const {
    // The picosecond that edge n is rounded down to is not before `time`, a whole number of picoseconds,
    // exactly when the edge itself is not.
    return Cycles(rate_.ceil(time.value()));
  }
  Cycles cycle_at_or_after(Picoseconds date) const { return Cycles(rate_.ceil(date.size())); }
  /// First edge not before the kernel's present time.
  Cycles now() const { return cycle_at_or_after(sc_core::sc_time_stamp()); }
  /// First edge of this clock strictly after edge `cycle` of `other`.
  Cycles first_edge_after(const ClockDomain& other, Cycles cycle) const;
  /// Seconds that `cycles` take.
  double seconds(Cycles cycles) const;

  /// For kernel threads: wait until edge `cycle`; returns at once when it is not in the future.
  void wait_until(Cycles cycle) const;

 private:
  std::string name_;
  Hertz frequency_;
  Ratio period_;  // picoseconds a cycle
  Ratio rate_;    // cycles a picosecond
};

}  // namespace parallax
