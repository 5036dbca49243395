// SPDX-License-Identifier: Apache-2.0
#include "platform/input/folder_layouts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace parallax {

const std::vector<FolderLayout>& folder_layouts() {
  using Kind = FolderLayout::Kind;
  using Strength = FolderLayout::Strength;
  static const std::vector<FolderLayout> layouts{
      {Kind::kFolders, Strength::kExact, "left", "right"},
      {Kind::kFolders, Strength::kExact, "image_left", "image_right"},  // TartanAir
      {Kind::kFolders, Strength::kExact, "image_lcam_front", "image_rcam_front"},
      {Kind::kFolders, Strength::kExact, "frame_left", "frame_right"},  // Spring
      {Kind::kFolders, Strength::kExact, "clean_left", "clean_right"},  // Sintel
      {Kind::kFolders, Strength::kExact, "final_left", "final_right"},
      {Kind::kFolders, Strength::kExact, "left-image", "right-image"},  // DrivingStereo
      {Kind::kFolders, Strength::kExact, "left-image-full-size", "right-image-full-size"},
      {Kind::kFolders, Strength::kExact, "left-image-half-size", "right-image-half-size"},
      {Kind::kFolders, Strength::kExact, "image_0", "image_1"},  // KITTI 2012 and odometry: grey
      {Kind::kFolders, Strength::kExact, "image_2", "image_3"},  // KITTI 2015 and odometry: colour
      {Kind::kFolders, Strength::kExact, "colored_0", "colored_1"},
      {Kind::kFolders, Strength::kExact, "image_00", "image_01"},  // KITTI raw, in data/: grey
      {Kind::kFolders, Strength::kExact, "image_02", "image_03"},  // likewise: colour
      {Kind::kFolders, Strength::kExact, "image_l", "image_r"},
      {Kind::kFolders, Strength::kExact, "cam0", "cam1"},  // EuRoC and TUM VI, in data/
      {Kind::kFolders, Strength::kExact, "mav0/cam0", "mav0/cam1"},
      {Kind::kFolders, Strength::kExact, "infra1", "infra2"},      // RealSense
      {Kind::kFolders, Strength::kExact, "Camera_0", "Camera_1"},  // Virtual KITTI 2
      {Kind::kFolders, Strength::kExact, "rgb/Camera_0", "rgb/Camera_1"},
      {Kind::kFolders, Strength::kExact, "frames/rgb/Camera_0", "frames/rgb/Camera_1"},
      {Kind::kWholeName, Strength::kExact, "im2", "im6"},  // Middlebury 2001 and 2003, among im0 to im8
      {Kind::kWholeName, Strength::kExact, "view1",
       "view5"},                                           // Middlebury 2005 and 2006, among view0 to view6
      {Kind::kWholeName, Strength::kExact, "im0", "im1"},  // Middlebury 2014 and 2021, ETH3D
      {Kind::kWholeName, Strength::kExact, "infra1", "infra2"},
      {Kind::kWholeName, Strength::kExact, "cam0", "cam1"},
      {Kind::kFoldersOf, Strength::kWord, "left", "right"},
      {Kind::kFoldersOf, Strength::kWord, "infra1", "infra2"},
      {Kind::kPrefix, Strength::kWord, "left", "right"},
      {Kind::kSuffix, Strength::kWord, "left", "right"},
      {Kind::kAnywhere, Strength::kWord, "left", "right"},
      {Kind::kAnywhere, Strength::kWord, "infra1", "infra2"},
      {Kind::kAnywhere, Strength::kWord, "cam0", "cam1"},
      {Kind::kSuffix, Strength::kLetter, "_l", "_r"},
      {Kind::kSuffix, Strength::kLetter, "-l", "-r"},
      {Kind::kPrefix, Strength::kLetter, "l_", "r_"},
      {Kind::kPrefix, Strength::kLetter, "l-", "r-"},
      {Kind::kSuffix, Strength::kLetter, "L", "R", false},
  };
  return layouts;
}

std::string folder_layouts_text() {
  std::vector<std::string> folders, names;
  for (const FolderLayout& layout : folder_layouts()) {
    switch (layout.kind) {
      case FolderLayout::Kind::kFolders:
        folders.push_back(layout.left + " " + layout.right);
        break;
      case FolderLayout::Kind::kFoldersOf:
        folders.push_back("*" + layout.left + "* *" + layout.right + "*");
        break;
      case FolderLayout::Kind::kWholeName:
        names.push_back(layout.left + " " + layout.right);
        break;
      case FolderLayout::Kind::kPrefix:
        names.push_back(layout.left + "* " + layout.right + "*");
        break;
      case FolderLayout::Kind::kSuffix:
        names.push_back("*" + layout.left + " *" + layout.right);
        break;
      case FolderLayout::Kind::kAnywhere:
        names.push_back("*" + layout.left + "* *" + layout.right + "*");
        break;
    }
  }
  return fmt::format("folders {}; images {}", fmt::join(folders, ", "), fmt::join(names, ", "));
}

}  // namespace parallax
