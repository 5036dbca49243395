// SPDX-License-Identifier: Apache-2.0
// Images whose size the machine cannot process as it is: made larger before, cut back after.
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "modules/pixel.hpp"
#include "platform/config/image_config.hpp"
#include "platform/scene/stereo_images.hpp"

namespace parallax {

/// The next size that is a multiple of the granularity.
cv::Size padded_size(const cv::Size& size, const Granularity& granularity);

/// Repeats the last column to the right and the last row below. An image that fits is returned as it is.
StereoImages pad_images(const StereoImages& images, const Granularity& granularity);

/// The upper left `size` of a padded image.
cv::Mat crop_image(const cv::Mat& padded, const cv::Size& size);

/// The same of a padded disparity map of `padded_width` columns.
std::vector<Disparity> crop_disparities(const std::vector<Disparity>& padded, int padded_width,
                                        const cv::Size& size);

/// One line that says what is done, empty when nothing is.
std::string padding_notice(const cv::Size& size, const Granularity& granularity);

}  // namespace parallax
