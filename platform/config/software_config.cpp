// SPDX-License-Identifier: Apache-2.0
#include "platform/config/software_config.hpp"

#include "platform/config/schema.hpp"

namespace parallax {

void describe(Schema& schema, SoftwareConfig& config) {
  schema.integer(
      "software.response_ns", config.response_ns, {0, 1'000'000'000}, "ns",
      "Time in which the device's software starts the core, once a frame is in memory, an output buffer is "
      "free, and "
      "the core is done with the frame before (unless software.queue_frames).",
      fitted("paper, table 1: with margins that contain the disparity range, wide images leave no room for "
             "more, and 800x592 with 256 disparities needs this much"));
  schema.integer("software.register_ns", config.register_ns, {0, 1'000'000}, "ns",
                 "Time of one access to a register of the core. Those that start a frame are part of "
                 "software.response_ns.",
                 chosen("not published; usual for a register behind a processor's peripheral bus"));
  schema.boolean("software.queue_frames", config.queue_frames,
                 "Whether the core is given the next frame while it works on one. Off: when it is done.",
                 chosen("not published; a control block with one set of registers and a start bit"));
}

}  // namespace parallax
