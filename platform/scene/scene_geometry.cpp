// SPDX-License-Identifier: Apache-2.0
#include "platform/scene/scene_geometry.hpp"

#include <algorithm>
#include <cmath>

#include "platform/scene/scene_hash.hpp"

namespace parallax {
namespace {

using Kind = SceneTexture::Kind;
using Outline = SceneSurface::Outline;

constexpr double kBaseline = 0.12;  // m, in the middle of the commercial stereo cameras' range
constexpr int kPeriod = 128;        // frames until the motion repeats

/// One surface as a table row. Places and extents are shares of width and height, disparities shares of the
/// range; a slope is the change of disparity, in ranges, over the full image width or height.
struct Placement {
  Outline outline;
  double x, y, half_x, half_y;
  double disparity, slope_x, slope_y;
  double roll;  // tangent of half the roll angle
  Kind texture;
  int brightness, contrast;  // grey levels
  double sway_x, sway_depth, phase;
};

// clang-format off
constexpr Placement kPlacements[] = {
    // outline             x     y     half x half y disp  slope x slope y roll   texture         bright contr sway x depth phase
    {Outline::kUnbounded,  0.50, 0.40, 0,     0,     0.11,  0.05,  0,      0.21,  Kind::kFractal, 118, 150,    0,     0,    0},     // back wall
    {Outline::kUnbounded,  0.50, 0.85, 0,     0,     0.42,  0,     1.39,  -0.30,  Kind::kFractal,  96, 165,    0,     0,    0},     // floor
    {Outline::kUnbounded,  0.02, 0.40, 0,     0,     0.30, -1.00,  0,      0.12,  Kind::kPatches, 140, 110,    0,     0,    0},     // side wall
    {Outline::kRectangle,  0.37, 0.29, 0.09,  0.13,  0.22,  0,     0.20,  -0.03,  Kind::kFractal, 172,   9,    0.020, 0.01, 0.30},  // weakly textured panel
    {Outline::kRectangle,  0.70, 0.34, 0.16,  0.17,  0.36,  0.90,  0.10,   0.07,  Kind::kStripes, 130, 150,    0.030, 0.02, 0.00},  // slanted board
    {Outline::kEllipse,    0.46, 0.60, 0.09,  0.11,  0.52,  0,    -0.30,   0.15,  Kind::kPatches, 150, 130,    0.050, 0.04, 0.55},  // disc
    {Outline::kRectangle,  0.60, 0.56, 0.012, 0.37,  0.66,  0,     0,     -0.04,  Kind::kFractal,  70, 140,    0.040, 0.02, 0.80},  // pole
    {Outline::kRectangle,  0.83, 0.75, 0.10,  0.15,  0.80, -0.15,  0.05,   0.03,  Kind::kFractal, 150, 160,    0.030, 0.04, 0.15},  // nearest box
};
// clang-format on

/// A smooth oscillation between -1 and 1 of parabolas: no library sine, which differs in its last bit by
/// machine.
double sway(int frame, double phase) {
  const double turns = (frame % kPeriod) / double{kPeriod} + phase;
  const double p = turns - std::floor(turns);
  return p < 0.5 ? 16 * p * (0.5 - p) : -16 * (p - 0.5) * (1 - p);
}

}  // namespace

SceneFrame scene_frame(const SceneConfig& config) {
  // 0.9 image sides of focal length: a field of view of 58 degrees along the longer side.
  return {0.9 * std::max(config.width, config.height), (config.width - 1) / 2.0, (config.height - 1) / 2.0,
          kBaseline};
}

std::vector<SceneSurface> place_surfaces(const SceneConfig& config, int frame) {
  const SceneFrame view = scene_frame(config);
  const double width = config.width;
  const double height = config.height;
  // A range wider than a third of the image would put most of the scene outside the right image.
  // The floor of half a pixel keeps every depth finite where there is only one disparity.
  const double range = std::max(0.5, std::min(config.disparities - 1.0, width / 3));
  // The camera moves along its baseline and a little upward; everything else shifts against it. With an
  // offset the same motion in metres would be more pixels.
  const double stride = kBaseline * config.motion * range / (config.disparity_offset + range);
  const cv::Vec3d camera(0.4 * stride * sway(frame, 0), 0.1 * stride * sway(frame, 0.25), 0);

  std::vector<SceneSurface> surfaces;
  std::uint64_t counter = 0;
  for (const Placement& row : kPlacements) {
    const auto jitter = [&](double amount) { return amount * scene_uniform(config.seed, counter++); };
    const bool room = row.outline == Outline::kUnbounded;
    const double x = (row.x + jitter(room ? 0 : 0.02)) * width;
    const double y = (row.y + jitter(room ? 0 : 0.02)) * height;
    const double disparity = config.disparity_offset + (row.disparity + jitter(0.01)) * range;
    const double slope_x = row.slope_x * range / width;
    // In an image of few rows the floor would be seen edge on.
    const double slope_y = std::clamp(row.slope_y * range / height, -1.0, 1.0);
    const double px = (x - view.cx) / view.focal;
    const double py = (y - view.cy) / view.focal;
    const double depth = view.focal * view.baseline / disparity;

    SceneSurface s;
    // Inverse depth is linear in the image: 1/z = disparity / (f B), and disparity is linear over a plane.
    s.inverse_plane = cv::Vec3d(slope_x * view.focal, slope_y * view.focal,
                                disparity + slope_x * (view.cx - x) + slope_y * (view.cy - y)) *
                      (1 / (view.focal * view.baseline));
    s.anchor = cv::Vec3d(px, py, 1) * depth;
    const cv::Vec3d across = cv::Vec3d(1, 0, -px) * (view.focal / depth);
    const cv::Vec3d down = cv::Vec3d(0, 1, -py) * (view.focal / depth);
    const double t = row.roll;
    const double cosine = (1 - t * t) / (1 + t * t);
    const double sine = 2 * t / (1 + t * t);
    s.axis_u = across * cosine + down * sine;
    s.axis_v = down * cosine - across * sine;
    s.outline = row.outline;
    s.half_u = row.half_x * width;
    s.half_v = row.half_y * height;
    s.texture = row.texture;
    s.texture_u = scene_hash(config.seed, 1000 + counter) & 4095;
    s.texture_v = scene_hash(config.seed, 2000 + counter) & 4095;
    s.brightness = static_cast<int>((row.brightness + jitter(12)) * 256);
    s.contrast = row.contrast;

    // Object motion as a shift of its points, in px and in disparity at the anchor; then the camera's.
    const double moved_disparity =
        disparity + row.sway_depth * range * config.motion * sway(frame, row.phase);
    const double moved_x =
        px + row.sway_x * width * config.motion * sway(frame, row.phase + 0.2) / view.focal;
    const double moved_depth = view.focal * view.baseline / moved_disparity;
    const cv::Vec3d shift = cv::Vec3d(moved_x, py, 1) * moved_depth - s.anchor - camera;
    s.anchor += shift;
    // plane . (P - shift) = 1
    s.inverse_plane *= 1 / (1 + s.inverse_plane.dot(shift));
    surfaces.push_back(s);
  }
  return surfaces;
}

}  // namespace parallax
