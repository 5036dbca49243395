// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

#include "modules/map_codec.hpp"
#include "platform/frame.hpp"

namespace parallax {

/// What a run of the machine is made of, apart from its configuration.
struct MachineInput {
  int width = 0;   ///< px, of the images as they are processed
  int height = 0;  ///< px
  const EncodedMap* map = nullptr;
  std::int64_t frames = 1;
  bool timing_only = false;  ///< no frame has images, so the memory need not hold any
  /// Called, if there is one, once a frame, in order, when it is exposed. The cameras go on after the last
  /// one, without images, until the host has all frames, so that every frame meets the traffic of its
  /// successors.
  std::function<StereoFrame(std::int64_t frame)> expose;
  /// Called, if there is one, once a frame, in order, when the host has it.
  std::function<void(const FrameResult& result)> deliver;
};

}  // namespace parallax
