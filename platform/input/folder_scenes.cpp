// SPDX-License-Identifier: Apache-2.0
#include "platform/input/folder_scenes.hpp"

#include "platform/input/image_names.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

namespace fs = std::filesystem;

constexpr int kDeepestScene = 3;
constexpr int kMostFolders = 2000;

struct SceneSearch {
  fs::path folder;
  std::function<bool(const fs::path&)> is_scene;
  std::vector<std::string> scenes;
  int looked_at = 0;

  void look_below(const fs::path& below, int depth) {
    for (const std::string& name : folder_names(folder / below)) {
      if (++looked_at > kMostFolders) return;
      try {
        if (is_scene(folder / below / name)) {
          scenes.push_back((below / name).string());
        } else if (depth < kDeepestScene) {
          look_below(below / name, depth + 1);
        }
      } catch (const UserError&) {  // it cannot be read
      }
    }
  }
};

}  // namespace

std::vector<std::string> folder_scenes(const fs::path& folder,
                                       const std::function<bool(const fs::path&)>& is_scene) {
  SceneSearch search{folder, is_scene, {}, 0};
  search.look_below("", 1);
  return search.scenes;
}

}  // namespace parallax
