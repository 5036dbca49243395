// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "platform/input/image_pairs.hpp"

namespace parallax {

/// The pairs of a folder by the layout (folder_layouts.hpp) that fits it best, in natural order. Throws
/// UserError when none fits, or when a frame lacks one side.
///
/// Every layout is tried. The best is one that leaves no image without its partner; of these an exact one
/// before a word before a letter, then the one with the most pairs, then the one that leaves the fewest
/// images over, then the first of the table. But when a layout of the same strength or a stronger one finds
/// more pairs and misses a partner, then a frame is missing, and the error names it.
///
/// The two images may be of different formats: where no name with the same extension is a partner's, the only
/// one with another extension is.
///
/// A folder that holds no pair, but folders that do, is refused with their names.
///
/// What belongs to no pair by its name does not count: true disparities, masks and the like, unless the
/// folder holds nothing else.
std::vector<ImagePair> pairs_of_folder(const std::filesystem::path& folder);

}  // namespace parallax
