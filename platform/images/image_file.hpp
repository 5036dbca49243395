// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>
#include <string>

namespace parallax {

/// Throws UserError when there is no file at the path that can be read. `what`: as a message calls it,
/// "image".
void require_image_file(const std::string& path, const std::string& what);

/// Looks at the size of an image, before anything of it is unpacked, and throws UserError when it is none
/// that is wanted.
using SizeCheck = std::function<void(const cv::Size& size)>;

/// For images whose size nothing else says: at most 2^28 px, such as 16384x16384.
SizeCheck at_most_any_image(const std::string& path, const std::string& what);

/// The one reader of image files: PNG, JPEG, TIFF, BMP, PNM and WebP, with the values and the channels of the
/// file (cv::IMREAD_UNCHANGED). Every fault of the file is a UserError of one line, a damaged file too; what
/// OpenCV's libraries say of it does not appear.
cv::Mat read_image_file(const std::string& path, const std::string& what, const SizeCheck& check);

/// "640x480".
std::string size_text(const cv::Size& size);

}  // namespace parallax
