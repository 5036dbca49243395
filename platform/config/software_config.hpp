// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace parallax {

class Schema;

/// The device's own software, which hands frames to the stereo core.
struct SoftwareConfig {
  /// ns from what makes the next frame possible (frame in memory, core done unless frames queue, output
  /// buffer free) to its start, 0 to 10^9; F
  std::int64_t response_ns = 500'000;
  /// Whether a frame is handed over while the core works on the one before, so that one's end and the next
  /// one's beginning overlap; else when the core is done; own choice
  bool queue_frames = false;
  std::uint32_t register_ns = 100;  ///< one register access, part of response_ns, 0 to 10^6; own choice
};

void describe(Schema& schema, SoftwareConfig& config);

}  // namespace parallax
