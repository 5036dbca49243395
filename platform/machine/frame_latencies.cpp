// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/frame_latencies.hpp"

namespace parallax {

const std::vector<FrameSpan>& frame_spans() {
  static const std::vector<FrameSpan> spans{
      {"first_pixel",
       "from when the core can start with the frame, as much of it as it waits for being in memory, to its "
       "first disparity out of the last "
       "filter",
       &FrameTimes::startable, &FrameTimes::first_disparity},
      {"last_pixel",
       "from when the core can start with the frame, as much of it as it waits for being in memory, to its "
       "last disparity out of the last "
       "filter",
       &FrameTimes::startable, &FrameTimes::last_disparity},
      {"first_byte_to_first_pixel",
       "from the frame's first byte in memory to its first disparity out of the last filter",
       &FrameTimes::first_byte, &FrameTimes::first_disparity},
      {"first_byte_to_last_pixel",
       "from the frame's first byte in memory to its last disparity out of the last filter",
       &FrameTimes::first_byte, &FrameTimes::last_disparity},
      {"first_byte_to_host",
       "from the frame's first byte in memory to its last bit at the host, or, where the link is off, to its "
       "results in memory",
       &FrameTimes::first_byte, &FrameTimes::at_host},
      {"exposure_to_first_pixel",
       "from the end of exposure to the frame's first disparity out of the last filter", &FrameTimes::exposed,
       &FrameTimes::first_disparity},
      {"exposure_to_last_pixel",
       "from the end of exposure to the frame's last disparity out of the last filter", &FrameTimes::exposed,
       &FrameTimes::last_disparity},
      {"exposure_to_host",
       "from the end of exposure to the frame's last bit at the host, or, where the link is off, to its "
       "results in memory",
       &FrameTimes::exposed, &FrameTimes::at_host}};
  return spans;
}

}  // namespace parallax
