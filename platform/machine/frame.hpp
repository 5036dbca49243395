// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <systemc>
#include <vector>

#include "modules/pixel.hpp"
#include "platform/machine/sensor.hpp"

namespace parallax {

/// What goes into the machine: one exposure of both sensors. Without images the frame is timing only.
struct StereoFrame {
  SensorImage left;
  SensorImage right;
};

/// When a frame reached the parts of the machine, in kernel time.
struct FrameTimes {
  sc_core::sc_time exposed;          ///< end of exposure, read-out begins
  sc_core::sc_time due;              ///< the same without what jitter added to it
  std::int64_t lost = 0;             ///< triggers before it that came to no frame, as no buffer was free or a
                                     ///< sensor reading out
  sc_core::sc_time first_byte;       ///< the first burst of either image in memory
  sc_core::sc_time startable;        ///< as much of both images in memory as the core waits for: all, or
                                     ///< camera.early_start_rows of them
  sc_core::sc_time in_memory;        ///< both images whole
  sc_core::sc_time core_started;     ///< by software
  sc_core::sc_time read;             ///< both images, by the core: their frame buffer is free
  sc_core::sc_time first_disparity;  ///< first disparity out of the last filter
  sc_core::sc_time last_disparity;   ///< last disparity out of the last filter
  sc_core::sc_time results_in_memory;
  sc_core::sc_time at_host;  ///< last bit on the wire; results_in_memory when the link is off
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
