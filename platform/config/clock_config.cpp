// SPDX-License-Identifier: Apache-2.0
#include "platform/config/clock_config.hpp"

#include "platform/config/schema.hpp"

namespace parallax {

void describe(Schema& schema, ClockConfig& config) {
  constexpr IntegerRange kHertz{1, 10'000'000'000};
  schema.integer(
      "clocks.core_hz", config.core_hz, kHertz, "Hz",
      "Clock of the pipeline from the map decoder to the output; the matcher starts one iteration a cycle.",
      fitted("paper, table 1: 1280x960 with 256 disparities at 15 fps needs at least 184.3 MHz with tiles"));
  schema.integer("clocks.memory_hz", config.memory_hz, kHertz, "Hz",
                 "Clock of the memory bus. Bandwidth is this times memory.bytes_per_cycle.",
                 inferred("DDR3-1066 of a Zynq-7000-class platform: 533 MHz, two transfers a cycle"));
  schema.integer("clocks.camera_hz", config.camera_hz, kHertz, "Hz",
                 "Pixel clock of a sensor: one pixel a cycle between the blanking intervals.",
                 chosen("not published; fast enough not to limit the rates of the paper's table 1"));
  schema.integer("clocks.link_hz", config.link_hz, kHertz, "Hz",
                 "Clock in which the link's time is counted; its rate is link.line_rate.",
                 stated("IEEE 802.3: gigabit media-independent interface, 125 MHz"));
}

}  // namespace parallax
