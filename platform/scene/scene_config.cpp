// SPDX-License-Identifier: Apache-2.0
#include "platform/scene/scene_config.hpp"

#include <fmt/format.h>

#include "tlm/error.hpp"

namespace parallax {
namespace {

template <class T>
void require_range(const char* key, T value, T low, T high) {
  // Written so that a NaN fails too.
  if (!(value >= low && value <= high)) {
    throw UserError(fmt::format("scene.{} is {}, allowed is {} to {}", key, value, low, high));
  }
}

}  // namespace

void SceneConfig::validate() const {
  require_range("width", width, 1, 65536);
  require_range("height", height, 1, 65536);
  require_range("disparities", disparities, 1, 256);
  require_range("disparity_offset", disparity_offset, 0, 255);
  if (disparity_offset + disparities > 256) {
    throw UserError(
        fmt::format("scene.disparity_offset + scene.disparities is {} + {} = {}, allowed is at most 256",
                    disparity_offset, disparities, disparity_offset + disparities));
  }
  require_range("read_noise", read_noise, 0.0, 50.0);
  require_range("shot_noise", shot_noise, 0.0, 1.0);
  require_range("vignetting", vignetting, 0.0, 0.9);
  require_range("motion", motion, 0.0, 2.0);
}

}  // namespace parallax
