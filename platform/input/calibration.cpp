// SPDX-License-Identifier: Apache-2.0
#include "platform/input/calibration.hpp"

#include <fmt/format.h>

#include "tlm/error.hpp"

namespace parallax {

void check_size(const Calibration& calibration, const ImageSize& images) {
  const ImageSize& size = calibration.size;
  if (size.width != images.width || size.height != images.height) {
    throw UserError(fmt::format("{}: the calibration is for images of {}x{}, these have {}x{}{}",
                                calibration.source, size.width, size.height, images.width, images.height,
                                calibration.choice.empty() ? "" : "; " + calibration.choice));
  }
}

}  // namespace parallax
