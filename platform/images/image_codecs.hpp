// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

namespace parallax {

/// OpenCV's image codecs, loaded when the first image is read or written. Behind the formats that they know
/// stand 120 more shared libraries; loading those takes four times as long as the rest of the program's
/// start, and most questions (timing, memory, registers, help) need no image. Each throws std::runtime_error
/// if OpenCV's library is not installed, and what OpenCV throws.

/// cv::imread: the image in a file, empty if it cannot be read. FLAGS: cv::ImreadModes.
cv::Mat read_image(const std::string& path, int flags = cv::IMREAD_UNCHANGED);

/// cv::imdecode: the image in a file's BYTES (at least one), empty if they are none.
cv::Mat decode_image(const std::vector<std::uint8_t>& bytes);

/// cv::imencode: the bytes of a file that holds IMAGE, in the format that EXTENSION (".png") names.
std::vector<std::uint8_t> encode_image(const std::string& extension, const cv::Mat& image);

}  // namespace parallax
