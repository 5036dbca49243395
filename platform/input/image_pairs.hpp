// SPDX-License-Identifier: Apache-2.0
// Which files, or images in memory, are a stereo pair.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "platform/scene/stereo_images.hpp"

namespace parallax {

struct ImagePair {
  std::filesystem::path left;
  std::filesystem::path right;
  StereoImages pixels{};  ///< of images in memory, which have names in the place of paths

  bool in_memory() const { return !pixels.left.empty(); }
};

/// Images in memory by the names that messages call them: left and right, of several left[0], left[1], ...
std::vector<ImagePair> pairs_in_memory(const std::vector<StereoImages>& images);

/// The pairs of a folder (folder_pairs.hpp), or of a list file, in order. Throws UserError when there are
/// none, or when a file of a pair is missing.
///
/// A list file: two paths a line, relative to the list's folder; a path with spaces in double quotes; #
/// starts a comment.
std::vector<ImagePair> find_image_pairs(const std::filesystem::path& folder_or_list);

}  // namespace parallax
