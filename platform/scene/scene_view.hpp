// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "platform/scene/scene_calibration.hpp"
#include "platform/scene/scene_geometry.hpp"
#include "platform/scene/scene_texture.hpp"

namespace parallax {

/// One texture of each kind, shared by all surfaces.
using SceneTextures = std::array<SceneTexture, 3>;

/// A surface as seen from one camera, in rays (x, y, 1) from its centre: all three are linear in the ray,
/// which makes the cast of a ray two additions and one division.
struct SurfaceForms {
  cv::Vec3d inverse_depth;  ///< 1/z, 1/m
  cv::Vec3d u;              ///< surface coordinate u, times 1/z
  cv::Vec3d v;

  SurfaceForms(const SceneSurface& surface, const cv::Vec3d& camera_centre);
};

/// Index of the foremost surface on the ray, and its inverse depth; exact, for ground truth.
struct RayHit {
  int surface = -1;
  double inverse_depth = 0;
};
RayHit cast_ray(const std::vector<SceneSurface>& surfaces, const std::vector<SurfaceForms>& forms, double x,
                double y);

std::vector<SurfaceForms> surface_forms(const std::vector<SceneSurface>& surfaces,
                                        const cv::Vec3d& camera_centre);

/// What changes from picture to picture beside the surfaces.
struct SensorNoise {
  std::uint64_t key = 0;  ///< one per seed, frame and camera
  double read_sigma = 0;  ///< grey levels
  double shot_variance = 0;
};

/// One camera of the scene. Rays are computed once, at the corners of cells of 8x8 pixels, and interpolated
/// in between: the lens's curvature makes that wrong by at most a few 1/1000 px. Surfaces that cannot be seen
/// in a cell are dropped before its rays are cast.
class SceneView {
 public:
  SceneView(const SceneLens& lens, const cv::Vec3d& centre, const SceneConfig& config);

  /// The raw 8-bit image: 2x2 samples a pixel.
  cv::Mat render(const std::vector<SceneSurface>& surfaces, const SceneTextures& textures,
                 const SensorNoise& noise) const;

 private:
  int width_;
  int height_;
  int cells_x_;
  int cells_y_;
  double vignetting_;
  double corner_r2_;
  cv::Vec3d centre_;
  std::vector<cv::Vec2d> rays_;  // (cells_x_ + 1) * (cells_y_ + 1), in the rectified frame
};

}  // namespace parallax
