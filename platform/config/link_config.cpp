// SPDX-License-Identifier: Apache-2.0
#include "platform/config/link_config.hpp"

#include <fmt/format.h>

#include "platform/config/schema.hpp"
#include "tlm/error.hpp"

namespace parallax {

void LinkConfig::validate() const {
  if (packet_payload_bytes > packet_wire_bytes) {
    throw UserError(fmt::format("link.packet_payload_bytes = {}: must be at most link.packet_wire_bytes = {}",
                                packet_payload_bytes, packet_wire_bytes));
  }
}

void describe(Schema& schema, LinkConfig& config) {
  schema.boolean(
      "link.enabled", config.enabled,
      "Whether results are sent to a host. Off: they stay in the memory and the link limits nothing.",
      stated("paper, section Architecture: output through gigabit Ethernet"));
  schema.boolean("link.color_output", config.color_output,
                 "Whether results carry the left image in colour: 4.5 bytes a pixel instead of 2.5.",
                 chosen("a monochrome camera"));
  schema.integer("link.output_buffers", config.output_buffers, {1, 64}, "frames",
                 "Frames of results that the memory holds on their way to the host.",
                 chosen("not published"));
  schema.integer(
      "link.early_start_rows", config.early_start_rows, {0, 65536}, "rows",
      "Rows of results in memory (of an image of several tiles: of the last one) with which sending "
      "begins; it goes on behind the core, row by row. 0: the whole frame.",
      chosen("not published; the device's registers count bytes available"));
  schema.integer("link.line_rate", config.line_rate, {1, 1'000'000'000'000}, "bit/s", "Bit rate of the wire.",
                 stated("paper, section Architecture: gigabit Ethernet"));
  schema.integer("link.packet_payload_bytes", config.packet_payload_bytes, {1, 65536}, "B",
                 "Bytes of results in a packet.",
                 stated("published network protocol: UDP packets of 1472 B with a segment offset of 4 B"));
  schema.integer("link.packet_wire_bytes", config.packet_wire_bytes, {1, 65536}, "B",
                 "Bytes that a packet occupies on the wire, with all headers, preamble and gap.",
                 stated("IEEE 802.3: 1500 B and 38 B of header, check sum, preamble and gap"));
  schema.integer(
      "link.host_pixel_rate", config.host_pixel_rate, {0, 1'000'000'000'000}, "px/s",
      "Limit of the pixels per second that a connected computer receives, independent of the disparity "
      "range; what causes it is not known. 0 lifts it.",
      fitted("paper, table 1: all four rows with 128 disparities lie at 28.8 to 30.8 Mpx/s"));
}

}  // namespace parallax
