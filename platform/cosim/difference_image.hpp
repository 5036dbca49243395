// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "platform/cosim/token_words.hpp"
#include "platform/cosim/vector_manifest.hpp"

namespace parallax {

/// Where a stream differs in the first frame in which it does: CV_8UC3 (BGR) of the processed image's size.
/// Black: as the model; red, the brighter the more of a pixel's values differ; blue: there is no token.
/// Empty when nothing differs, and for tokens that know no rows.
cv::Mat difference_image(const VectorManifest& manifest, const VectorStream& stream,
                         const TokenWords& expected, const TokenWords& got);

}  // namespace parallax
