// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "modules/output_packing.hpp"

namespace parallax {

class Schema;

/// The Ethernet link to the connected computer.
struct LinkConfig {
  bool enabled = true;                     ///< off: results stay in the memory
  bool color_output = false;               ///< whether the left image goes out in colour; own choice
  std::uint32_t output_buffers = 3;        ///< frames of results that the memory holds, 1 to 64; own choice
  std::uint32_t early_start_rows = 0;      ///< rows of results with which sending starts; 0 = all; own choice
  std::int64_t line_rate = 1'000'000'000;  ///< bit/s, 1 to 10^12; S
  std::uint32_t packet_payload_bytes = 1468;  ///< result bytes per packet, 1 to 65536; S
  std::uint32_t packet_wire_bytes = 1538;     ///< bytes per packet on the wire, 1 to 65536; S
  std::int64_t host_pixel_rate = 30'800'000;  ///< pixels/s that reach the host, 0 = no limit, up to 10^12; F

  OutputLeft output_left() const { return color_output ? OutputLeft::kColour : OutputLeft::kGrey; }
  /// Throws UserError when a packet's payload is longer than the packet.
  void validate() const;
};

void describe(Schema& schema, LinkConfig& config);

}  // namespace parallax
