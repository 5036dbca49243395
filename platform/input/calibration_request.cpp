// SPDX-License-Identifier: Apache-2.0
#include "platform/input/calibration_request.hpp"

namespace parallax {

std::string CalibrationRequest::source() const {
  std::string all;
  for (const File& file : files) all += (all.empty() ? "" : " + ") + file.path;
  return all;
}

}  // namespace parallax
