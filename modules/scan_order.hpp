// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace parallax {

/// In which order a circuit comes by the pixels of an image.
enum class ScanOrder {
  kRaster,       ///< row by row from the top, each from the left
  kRightToLeft,  ///< row by row from the top, each from the right
  kTurned,       ///< row by row from the bottom, each from the right: the image turned by 180 degrees
};

}  // namespace parallax
