// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace parallax {

/// Opens an OpenCV FileStorage (YAML, XML, JSON) whose top level has named entries; throws UserError naming
/// the file.
cv::FileStorage open_file_storage(const std::string& path);

}  // namespace parallax
