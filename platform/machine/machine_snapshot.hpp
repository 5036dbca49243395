// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <systemc>
#include <vector>

#include "tlm/dram_controller.hpp"
#include "tlm/units.hpp"

namespace parallax {

/// What became of the cameras' triggers.
struct CameraCounts {
  std::int64_t triggers = 0;
  std::int64_t taken = 0;    ///< frames that found a buffer
  std::int64_t dropped = 0;  ///< frames that found none
  std::int64_t missed = 0;   ///< triggers that found a sensor reading out
  std::int64_t faulty = 0;   ///< frames that a camera fault spoilt

  /// Triggers that came to no frame.
  std::int64_t lost() const { return dropped + missed; }
};

/// What has passed a memory port until a date.
struct PortSnapshot {
  std::uint64_t bytes = 0;
  Cycles bus;                 ///< memory cycles in which the bus was taken
  sc_core::sc_time occupied;  ///< summed over the DMA engine's requests under way
};

/// How far each part's work had come at one date, from the beginning of the run.
struct MachineSnapshot {
  sc_core::sc_time time;
  std::vector<PortSnapshot> ports;  ///< in the order of the memory's ports
  Cycles memory;                    ///< memory cycles in which it was at work
  DramStatistics dram;              ///< when the memory is a DRAM
  Cycles camera;                    ///< camera cycles in which a sensor read a frame out
  CameraCounts cameras;
  sc_core::sc_time output_full;  ///< in which only a buffer for its results kept the core from a frame
  sc_core::sc_time software;     ///< in which software was about to start the core
  sc_core::sc_time core;         ///< in which the core worked on a frame or was about to be started
  Cycles wire;                   ///< link cycles with a packet on the wire
  Cycles host;                   ///< link cycles in which the host was taking pixels
};

}  // namespace parallax
