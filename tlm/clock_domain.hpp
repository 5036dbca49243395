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
  sc_core::sc_time time_of(Cycles cycle) const;
  /// First edge not before kernel time `time`. `cycle_at_or_after(time_of(n)) == n`.
  Cycles cycle_at_or_after(const sc_core::sc_time& time) const;
  /// First edge not before the kernel's present time.
  Cycles now() const;
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
