// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/camera_trigger.hpp"

#include <cmath>

#include "platform/scene/scene_hash.hpp"

namespace parallax {
namespace {

constexpr std::uint64_t kNano = 1'000'000'000;
constexpr std::uint64_t kMicro = 1'000'000;

Ratio cycles_a_frame(double rate, Hertz clock) {
  const std::uint64_t microframes = std::llround(rate * static_cast<double>(kMicro));
  return {static_cast<std::uint64_t>(clock.count()) * kMicro, microframes};
}

}  // namespace

CameraTrigger::CameraTrigger(const CameraConfig& config, Hertz clock)
    : period_(cycles_a_frame(config.frame_rate, clock)),
      jitter_(Ratio(clock.count(), kNano).floor(config.jitter_ns)),
      seed_(config.jitter_seed) {}

Cycles CameraTrigger::late(std::int64_t k) const {
  return Cycles(jitter_ == 0 ? 0 : scene_hash(seed_, k) % (jitter_ + 1));
}

}  // namespace parallax
