// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace parallax {

/// Opens an OpenCV FileStorage (YAML, XML, JSON, each also gzip) whose top level has named entries, each
/// once; throws UserError naming the file, and for what OpenCV cannot read, the line and the reason.
cv::FileStorage open_file_storage(const std::string& path);

/// The same of a text that has been read from `path`.
cv::FileStorage parse_file_storage(const std::string& text, const std::string& path);

}  // namespace parallax
