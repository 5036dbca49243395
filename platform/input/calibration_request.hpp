// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "platform/input/calibration.hpp"

namespace parallax {

/// Which of the cameras of a calibration with several are left and right, by the numbers that the file gives
/// them.
struct CameraPair {
  int left = 0;
  int right = 1;
};

/// What the reader of a format is given.
struct CalibrationRequest {
  struct File {
    std::string path;
    std::string text;
  };
  std::vector<File> files;
  ImageSize images;  ///< of those at hand, 0 if not known: where a file states no size, or several
  CameraPair cameras;

  /// All paths, for messages.
  std::string source() const;
};

}  // namespace parallax
