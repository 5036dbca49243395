// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace parallax {

/// Whether `a` comes before `b` when runs of digits count as numbers.
bool natural_less(const std::string& a, const std::string& b);

/// The names of the images in a folder, by their extension, in natural order. Names that say that they are
/// something else (disp2.png, mask_nocc.png) only when there are no others. Throws UserError when the folder
/// cannot be read.
std::vector<std::string> image_names(const std::filesystem::path& folder);

/// The folders in a folder, in natural order, without hidden ones and those of other things.
std::vector<std::string> folder_names(const std::filesystem::path& folder);

/// image_names(), or where there are none the images of the folders below, as "scene/name".
std::vector<std::string> image_names_below(const std::filesystem::path& folder);

}  // namespace parallax
