// SPDX-License-Identifier: Apache-2.0
#include "platform/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "platform/scene/scene_geometry.hpp"
#include "platform/scene/scene_hash.hpp"

namespace parallax {
namespace {

SceneConfig checked(const SceneConfig& config) {
  config.validate();
  return config;
}

SceneTextures make_textures(const SceneConfig& config) {
  // About one texel a pixel: a tile as large as the image. At 1024 the repetition is far beyond any
  // disparity.
  int period_log2 = 6;
  while (period_log2 < 10 && (1 << period_log2) < std::max(config.width, config.height)) {
    ++period_log2;
  }
  const auto make = [&](SceneTexture::Kind kind) {
    return SceneTexture(kind, scene_hash(config.seed, static_cast<std::uint64_t>(kind)), period_log2);
  };
  return {make(SceneTexture::Kind::kFractal), make(SceneTexture::Kind::kPatches),
          make(SceneTexture::Kind::kStripes)};
}

bool shows(const SceneCalibration& c, const SceneLens& lens, double x, double y) {
  const cv::Vec2d raw = lens.project({x, y});
  return raw[0] >= -0.5 && raw[1] >= -0.5 && raw[0] <= c.width - 0.5 && raw[1] <= c.height - 0.5;
}

}  // namespace

Scene::Scene(const SceneConfig& config)
    : config_(checked(config)),
      calibration_(scene_calibration(config_)),
      textures_(make_textures(config_)),
      left_(calibration_.left, {0, 0, 0}, config_),
      right_(calibration_.right, {scene_frame(config_).baseline, 0, 0}, config_) {}

StereoImages Scene::render(int frame) const {
  const std::vector<SceneSurface> surfaces = place_surfaces(config_, frame);
  const auto noise = [&](std::uint64_t camera) {
    return SensorNoise{scene_hash(scene_hash(config_.seed, camera), frame), config_.read_noise,
                       config_.shot_noise};
  };
  return {left_.render(surfaces, textures_, noise(101)), right_.render(surfaces, textures_, noise(102))};
}

SceneTruth Scene::truth(int frame) const {
  const SceneFrame view = scene_frame(config_);
  const std::vector<SceneSurface> surfaces = place_surfaces(config_, frame);
  const std::vector<SurfaceForms> from_left = surface_forms(surfaces, {0, 0, 0});
  const std::vector<SurfaceForms> from_right = surface_forms(surfaces, {view.baseline, 0, 0});
  SceneTruth truth{cv::Mat(config_.height, config_.width, CV_16UC1, cv::Scalar(0)),
                   cv::Mat(config_.height, config_.width, CV_8UC1, cv::Scalar(0))};
  for (int row = 0; row < config_.height; ++row) {
    const double y = (row - view.cy) / view.focal;
    auto* disparity = truth.disparity.ptr<std::uint16_t>(row);
    auto* mask = truth.mask.ptr<std::uint8_t>(row);
    for (int column = 0; column < config_.width; ++column) {
      const double x = (column - view.cx) / view.focal;
      if (!shows(calibration_, calibration_.left, x, y)) {
        continue;
      }
      const RayHit hit = cast_ray(surfaces, from_left, x, y);
      const double d = view.focal * view.baseline * hit.inverse_depth;
      disparity[column] = static_cast<std::uint16_t>(std::clamp(std::lround(d * 256), 1L, 65535L));
      const double right_x = x - view.baseline * hit.inverse_depth;
      const bool matched = column - d >= 0 && shows(calibration_, calibration_.right, right_x, y) &&
                           cast_ray(surfaces, from_right, right_x, y).surface == hit.surface;
      mask[column] = matched ? 255 : 128;
    }
  }
  return truth;
}

}  // namespace parallax
