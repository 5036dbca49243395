// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "platform/config/camera_config.hpp"
#include "tlm/ratio.hpp"
#include "tlm/units.hpp"

namespace parallax {

/// The dates at which cameras that keep a rate of their own end their exposures. Trigger k comes at k / rate,
/// rounded down to a cycle from the absolute count, so that nothing drifts; the exposure ends up to
/// `jitter_ns` later, by a random number of cycles, uniform, that depends on the seed and on k only.
class CameraTrigger {
 public:
  /// The rate must be above 0; it is taken as a whole number of microframes a second. `clock`: the cameras'.
  CameraTrigger(const CameraConfig& config, Hertz clock);

  /// End of the exposure of trigger `k` (>= 0).
  Cycles exposed(std::int64_t k) const { return due(k) + late(k); }
  /// The same without jitter, and what jitter adds.
  Cycles due(std::int64_t k) const { return Cycles(period_.floor(k)); }
  Cycles late(std::int64_t k) const;
  /// Shortest time between two triggers.
  Cycles period() const { return Cycles(period_.floor(1)); }

 private:
  const Ratio period_;          // cycles a frame
  const std::uint64_t jitter_;  // cycles at most
  const std::uint64_t seed_;
};

}  // namespace parallax
