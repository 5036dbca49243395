// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/matx.hpp>
#include <vector>

#include "platform/scene/scene_config.hpp"
#include "platform/scene/scene_texture.hpp"

namespace parallax {

/// The ideal rectified left camera: focal length and principal point in px, and the distance to the right one
/// in m.
struct SceneFrame {
  double focal = 0;
  double cx = 0;
  double cy = 0;
  double baseline = 0;
};

SceneFrame scene_frame(const SceneConfig& config);

/// A plane, or the part of it within an outline, in the coordinates of the rectified left camera (m; x right,
/// y down, z forward): the points P with inverse_plane . P = 1. Surface coordinates are axis_u . (P - anchor)
/// and axis_v . (P - anchor), scaled to be pixels of the rectified left image around the anchor at rest.
struct SceneSurface {
  enum class Outline { kUnbounded, kRectangle, kEllipse };

  cv::Vec3d inverse_plane;
  cv::Vec3d anchor;
  cv::Vec3d axis_u;
  cv::Vec3d axis_v;
  Outline outline = Outline::kUnbounded;
  double half_u = 0;  ///< px, half extent of the outline
  double half_v = 0;  ///< px
  SceneTexture::Kind texture = SceneTexture::Kind::kFractal;
  int texture_u = 0;   ///< texels, the texture's place on the surface
  int texture_v = 0;   ///< texels
  int brightness = 0;  ///< 1/256 grey level
  int contrast = 256;  ///< grey levels over the texture's full range
};

/// All surfaces as they stand in frame `frame`. The room (back wall, floor, side wall) encloses every ray, so
/// each ray hits something; the foremost surface is what a camera sees.
std::vector<SceneSurface> place_surfaces(const SceneConfig& config, int frame);

}  // namespace parallax
