// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <systemc>
#include <vector>

#include "modules/pixel.hpp"
#include "platform/machine/sensor.hpp"
#include "tlm/dram_controller.hpp"

namespace parallax {

/// What goes into the machine: one exposure of both sensors. Without images the frame is timing only.
struct StereoFrame {
  SensorImage left;
  SensorImage right;
};

/// When a frame reached the parts of the machine, in kernel time.
struct FrameTimes {
  sc_core::sc_time exposed;     ///< end of exposure, read-out begins
  sc_core::sc_time first_byte;  ///< the first burst of either image in memory
  sc_core::sc_time
      in_memory;  ///< both images in memory, or camera.early_start_rows of them: the core can start
  sc_core::sc_time core_started;     ///< by software
  sc_core::sc_time first_disparity;  ///< first disparity out of the last filter
  sc_core::sc_time last_disparity;   ///< last disparity out of the last filter
  sc_core::sc_time results_in_memory;
  sc_core::sc_time at_host;  ///< last bit on the wire; results_in_memory when the link is off
};

/// What became of the cameras' triggers.
struct CameraCounts {
  std::int64_t triggers = 0;
  std::int64_t taken = 0;    ///< frames that found a buffer
  std::int64_t dropped = 0;  ///< frames that found none
  std::int64_t missed = 0;   ///< triggers that found a sensor reading out
  std::int64_t faulty = 0;   ///< frames that a camera fault spoilt
};

/// How far each part's work had come at one date, from the beginning of the run.
struct Activity {
  struct Port {
    std::uint64_t bytes = 0;
    Cycles bus;                 ///< memory cycles in which the bus was taken
    sc_core::sc_time occupied;  ///< summed over the DMA engine's requests under way
  };
  sc_core::sc_time time;
  std::vector<Port> ports;  ///< in the order of the memory's ports
  Cycles memory;            ///< memory cycles in which it was at work
  DramStatistics dram;      ///< when the memory is a DRAM
  Cycles camera;            ///< camera cycles in which a sensor read a frame out
  CameraCounts cameras;
  sc_core::sc_time output_full;  ///< in which only a buffer for its results kept the core from a frame
  sc_core::sc_time software;     ///< in which software was about to start the core
  sc_core::sc_time core;         ///< in which the core worked on a frame or was about to be started
  Cycles wire;                   ///< link cycles with a packet on the wire
  Cycles host;                   ///< link cycles in which the host was taking pixels
};

/// What comes out for one frame. Images are row-major and of the machine's size; empty for a timing-only
/// frame.
struct FrameResult {
  std::int64_t index = 0;
  std::vector<Gray> left;  ///< rectified left image, as the host receives it
  std::vector<Disparity>
      disparities;  ///< values as the host receives them, with the causes known to the model
};

}  // namespace parallax
