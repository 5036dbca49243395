// SPDX-License-Identifier: Apache-2.0
// Which files are a stereo pair.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace parallax {

struct ImagePair {
  std::filesystem::path left;
  std::filesystem::path right;
};

/// The pairs of a folder, or of a list file, in order. Throws UserError when there are none, or when a file
/// of a pair is missing.
///
/// A folder: the first of these rules that finds an image decides; other files do not matter.
///  1. two subfolders left/ right/, image_0/ image_1/, image_2/ image_3/ or image_l/ image_r/, with the same
///  file names
///  2. left<rest> right<rest>   left.png, left_000.png, left01.jpg
///  3. <rest>_left <rest>_right
///  4. <rest>_l <rest>_r
///  5. <rest>L <rest>R          aloeL.jpg
///  6. im0 im1                  Middlebury 2014
/// Names compare without regard to case in rules 2 to 4. Order is natural: frame9 comes before frame10.
///
/// A list file: two paths a line, relative to the list's folder; a path with spaces in double quotes; #
/// starts a comment.
std::vector<ImagePair> find_image_pairs(const std::filesystem::path& folder_or_list);

/// Whether `a` comes before `b` when runs of digits count as numbers.
bool natural_less(const std::string& a, const std::string& b);

}  // namespace parallax
