// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "platform/config/machine_config.hpp"
#include "platform/input/frame_source.hpp"
#include "platform/input/run_options.hpp"

namespace parallax {

/// The largest images that the machine takes: as image.max_width and image.max_height say, or as wide as its
/// tiles hold.
ImageLimits largest_images(const MachineConfig& config);

/// Throws UserError when options contradict each other, lack what they need, or are out of range.
void check_options(const RunOptions& options);

/// The images that the user asked for, or the built-in scene; after check_options(). Throws UserError when
/// they cannot be read, or do not fit the configuration: larger than largest_images(), of another size than
/// image.width, ...
std::unique_ptr<FrameSource> open_source(const RunOptions& options, const MachineConfig& config,
                                         const NoticeSink& notice);

}  // namespace parallax
