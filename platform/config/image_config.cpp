// SPDX-License-Identifier: Apache-2.0
#include "platform/config/image_config.hpp"

#include <fmt/format.h>

#include "platform/config/schema.hpp"
#include "tlm/error.hpp"

namespace parallax {

void ImageConfig::validate() const {
  if (max_width != 0 && width > max_width) {
    throw UserError(fmt::format("image.width = {}: must be at most image.max_width = {}", width, max_width));
  }
  if (height > max_height) {
    throw UserError(
        fmt::format("image.height = {}: must be at most image.max_height = {}", height, max_height));
  }
}

void describe(Schema& schema, ImageConfig& config) {
  schema.integer("image.width", config.width, {0, 65536}, "px",
                 "Width of the images; 0 takes it from the input.", chosen("taken from the input"));
  schema.integer("image.height", config.height, {0, 65536}, "px",
                 "Height of the images; 0 takes it from the input.", chosen("taken from the input"));
  schema.integer("image.width_granularity", config.width_granularity, {1, 1024}, "px",
                 "The machine processes widths that are multiples of this.",
                 derived("all published sizes have a width that is a multiple of 32"));
  schema.integer("image.height_granularity", config.height_granularity, {1, 1024}, "px",
                 "The machine processes heights that are multiples of this.",
                 derived("all published sizes have a height that is a multiple of 16"));
  schema.integer(
      "image.max_width", config.max_width, {0, 65536}, "px", "Largest width; 0 is as wide as the tiles hold.",
      derived("paper, section Results: 1856 x 1856; two tiles of 1024 columns hold as many with 128 "
              "disparities"));
  schema.integer("image.max_height", config.max_height, {1, 65536}, "px", "Largest height.",
                 stated("paper, section Results: 1856 x 1856"));
}

}  // namespace parallax
