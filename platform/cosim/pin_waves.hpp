// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tlm/units.hpp"

namespace parallax {

/// The waves of a circuit's pins over some cycles of one clock.
struct PinWaves {
  struct Signal {
    std::string scope;
    std::string name;
    std::size_t width = 1;  ///< bits
  };
  struct Cycle {
    Picoseconds begin, end;
    bool edge_before = false;             ///< the clock rises at its begin,
    bool edge_after = false;              ///< and at its end
    std::vector<std::string> values = {}; /**< of each signal, as they are before the edge at its end: binary
                                             digits, highest first; "x": unknown */
  };

  std::string title;  ///< what happened,
  Picoseconds at;     ///< in the cycle that begins then
  Signal clock;       ///< without a name: there is none
  std::vector<Signal> signals;
  std::vector<Cycle> cycles;  ///< in order; of a time between two nothing is known
};

/// As a value change dump (IEEE 1800, clause 21.7), in ps: what a cycle's edge sees is there from its begin.
std::string to_vcd(const PinWaves& waves);

/// For Perfetto: a counter for each signal of one bit, slices of the value, hexadecimal, for wider ones, and
/// one of what happened.
std::string to_perfetto(const PinWaves& waves);

}  // namespace parallax
