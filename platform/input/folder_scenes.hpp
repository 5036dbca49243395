// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace parallax {

/// The folders below `folder` that are a scene, as paths in it and in natural order; what is below a scene is
/// its own. No more than three folders deep and among the first two thousand: a data set may be large, and
/// its links a circle. What may not be looked into counts as none.
std::vector<std::string> folder_scenes(const std::filesystem::path& folder,
                                       const std::function<bool(const std::filesystem::path&)>& is_scene);

}  // namespace parallax
