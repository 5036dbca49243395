// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

namespace parallax {

/// How the pixels of an image hold true disparities.
enum class TruthEncoding {
  kValues,  ///< a value, scaled
  kSintel,  ///< 8-bit colour: disparity = 4 R + G / 64 + B / 16384 px (MPI Sintel's stereo data)
};

/// "values" or "sintel", of --ground-truth-encoding; empty is the first. Throws UserError.
TruthEncoding truth_encoding(const std::string& text);

/// px, CV_64FC1, of an image as OpenCV reads it: B, G, R, with transparency or without. Throws UserError,
/// whose line begins with `path`, when it is no colour image of 8 bits.
cv::Mat decode_sintel(const cv::Mat& image, const std::string& path);

}  // namespace parallax
