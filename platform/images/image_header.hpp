// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/types.hpp>
#include <optional>
#include <string>

namespace parallax {

/// Width and height, px, as the header of an image file says them; nothing of the image is unpacked. Nothing
/// when the file is no PNG, JPEG, TIFF, BigTIFF, BMP, PNM, PAM or WebP file, or its header is damaged.
std::optional<cv::Size> image_size_of_header(const std::string& path);

}  // namespace parallax
