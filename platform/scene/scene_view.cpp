// SPDX-License-Identifier: Apache-2.0
#include "platform/scene/scene_view.hpp"

#include <algorithm>
#include <cmath>

#include "modules/area.hpp"
#include "platform/scene/scene_hash.hpp"
#include "tlm/units.hpp"

namespace parallax {
namespace {

constexpr int kCell = 8;          // px
constexpr int kSide = 2 * kCell;  // samples along a cell
constexpr int kFullGrey = 255 * 256;

bool inside(const SceneSurface& s, double u, double v) {
  switch (s.outline) {
    case SceneSurface::Outline::kRectangle:
      return std::abs(u) <= s.half_u && std::abs(v) <= s.half_v;
    case SceneSurface::Outline::kEllipse: {
      const double a = u / s.half_u;
      const double b = v / s.half_v;
      return a * a + b * b <= 1;
    }
    case SceneSurface::Outline::kUnbounded:
      break;
  }
  return true;
}

/// Value of the three forms at one ray.
struct Cast {
  double w = 0, u = 0, v = 0;
};

Cast operator+(const Cast& a, const Cast& b) { return {a.w + b.w, a.u + b.u, a.v + b.v}; }
Cast operator-(const Cast& a, const Cast& b) { return {a.w - b.w, a.u - b.u, a.v - b.v}; }
Cast operator*(const Cast& a, double k) { return {a.w * k, a.u * k, a.v * k}; }

/// A surface in a cell: its forms at the cell's four corners (top left, top right, bottom left, bottom
/// right).
struct Candidate {
  const SceneSurface* surface = nullptr;
  const SceneTexture* texture = nullptr;
  std::array<Cast, 4> corner;
  double nearest = 0;
  double farthest = 0;
  bool covers = false;  // the whole cell
};

template <class Predicate>
bool all_corners(const Candidate& c, const Predicate& holds) {
  return std::all_of(c.corner.begin(), c.corner.end(), holds);
}

/// The forms are bilinear over the cell, so a half plane that holds no corner holds nothing of the cell.
bool misses(const Candidate& c) {
  const SceneSurface& s = *c.surface;
  if (all_corners(c, [](const Cast& k) { return k.w <= 0; })) {
    return true;
  }
  if (s.outline == SceneSurface::Outline::kUnbounded ||
      !all_corners(c, [](const Cast& k) { return k.w > 0; })) {
    return false;
  }
  return all_corners(c, [&](const Cast& k) { return k.u > s.half_u * k.w; }) ||
         all_corners(c, [&](const Cast& k) { return k.u < -s.half_u * k.w; }) ||
         all_corners(c, [&](const Cast& k) { return k.v > s.half_v * k.w; }) ||
         all_corners(c, [&](const Cast& k) { return k.v < -s.half_v * k.w; });
}

using Candidates = std::vector<Candidate>;

void find_candidates(Candidates& found, const std::vector<SceneSurface>& surfaces,
                     const std::vector<SurfaceForms>& forms, const SceneTextures& textures,
                     const std::array<cv::Vec2d, 4>& rays) {
  found.clear();
  double covered = 0;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    Candidate c;
    c.surface = &surfaces[i];
    c.texture = &textures[index_of(surfaces[i].texture)];
    for (std::size_t k = 0; k < 4; ++k) {
      const cv::Vec3d ray(rays[k][0], rays[k][1], 1);
      c.corner[k] = {forms[i].inverse_depth.dot(ray), forms[i].u.dot(ray), forms[i].v.dot(ray)};
    }
    if (misses(c)) {
      continue;
    }
    const auto [low, high] = std::minmax_element(c.corner.begin(), c.corner.end(),
                                                 [](const Cast& a, const Cast& b) { return a.w < b.w; });
    c.farthest = low->w;
    c.nearest = high->w;
    c.covers =
        low->w > 0 && all_corners(c, [&](const Cast& k) { return inside(*c.surface, k.u / k.w, k.v / k.w); });
    if (c.covers) {
      covered = std::max(covered, c.farthest);
    }
    found.push_back(c);
  }
  found.erase(
      std::remove_if(found.begin(), found.end(), [&](const Candidate& c) { return c.nearest < covered; }),
      found.end());
}

/// Light from one surface point, in 1/256 grey level.
int shade(const Candidate& c, const Cast& k) {
  // Texture coordinates become integers here, so that the last bit of the geometry has no say in the picture.
  const double scale = 256 / k.w;
  const auto u = static_cast<std::int64_t>(std::floor(k.u * scale)) + c.surface->texture_u * 256;
  const auto v = static_cast<std::int64_t>(std::floor(k.v * scale)) + c.surface->texture_v * 256;
  const int value = c.texture->sample(u, v) - 32768;
  return std::clamp(c.surface->brightness + ((value * c.surface->contrast) >> 8), 0, kFullGrey);
}

/// The sum of the four samples of each pixel of a cell.
using CellLight = std::array<std::array<int, kCell>, kCell>;

void cast_cell(const Candidates& candidates, std::vector<Cast>& row, std::vector<Cast>& step,
               CellLight& light) {
  const std::size_t count = candidates.size();
  row.resize(count);
  step.resize(count);
  const bool alone = count == 1;
  for (int y = 0; y < kSide; ++y) {
    auto& line = light[y / 2];
    if (y % 2 == 0) {
      line.fill(0);
    }
    const double ty = (y + 0.5) / kSide;
    for (std::size_t i = 0; i < count; ++i) {
      const auto& c = candidates[i].corner;
      const Cast left = c[0] + (c[2] - c[0]) * ty;
      const Cast right = c[1] + (c[3] - c[1]) * ty;
      step[i] = (right - left) * (1.0 / kSide);
      row[i] = left + step[i] * 0.5;
    }
    for (int x = 0; x < kSide; ++x) {
      std::size_t best = 0;
      Cast best_cast = row[0] + step[0] * x;
      if (!alone) {
        best_cast.w = 0;
        for (std::size_t i = 0; i < count; ++i) {
          const Cast k = row[i] + step[i] * x;
          if (k.w > best_cast.w &&
              (candidates[i].covers || inside(*candidates[i].surface, k.u / k.w, k.v / k.w))) {
            best = i;
            best_cast = k;
          }
        }
      }
      line[x / 2] += shade(candidates[best], best_cast);
    }
  }
}

/// The sensor: light of one pixel in 1/1024 grey level to its 8-bit value.
class Sensor {
 public:
  explicit Sensor(const SensorNoise& noise) : key_(scene_hash(noise.key)) {
    for (int grey = 0; grey < 256; ++grey) {
      const double variance = noise.read_sigma * noise.read_sigma + noise.shot_variance * grey;
      // 1/65536 grey level per unit of scene_normal().
      gain_[grey] = static_cast<int>(std::lround(std::sqrt(variance / kSceneNormalVariance) * 65536));
    }
  }

  std::uint8_t expose(int light, std::uint64_t pixel) const {
    const std::int64_t noise = std::int64_t{gain_[light >> 10]} * scene_normal(scene_hash(key_ ^ pixel));
    const std::int64_t value = (std::int64_t{light} * 64 + noise + 32768) >> 16;
    return static_cast<std::uint8_t>(std::clamp<std::int64_t>(value, 0, 255));
  }

 private:
  std::uint64_t key_;
  std::array<int, 256> gain_{};
};

}  // namespace

SurfaceForms::SurfaceForms(const SceneSurface& surface, const cv::Vec3d& camera_centre) {
  // Seen from the centre C, the plane m . P = 1 is m / (1 - m . C), and the anchor A is A - C.
  const cv::Vec3d anchor = surface.anchor - camera_centre;
  inverse_depth = surface.inverse_plane * (1 / (1 - surface.inverse_plane.dot(camera_centre)));
  u = surface.axis_u - inverse_depth * surface.axis_u.dot(anchor);
  v = surface.axis_v - inverse_depth * surface.axis_v.dot(anchor);
}

std::vector<SurfaceForms> surface_forms(const std::vector<SceneSurface>& surfaces,
                                        const cv::Vec3d& camera_centre) {
  std::vector<SurfaceForms> forms;
  for (const SceneSurface& s : surfaces) {
    forms.emplace_back(s, camera_centre);
  }
  return forms;
}

RayHit cast_ray(const std::vector<SceneSurface>& surfaces, const std::vector<SurfaceForms>& forms, double x,
                double y) {
  const cv::Vec3d ray(x, y, 1);
  RayHit hit;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const double w = forms[i].inverse_depth.dot(ray);
    if (w > hit.inverse_depth && inside(surfaces[i], forms[i].u.dot(ray) / w, forms[i].v.dot(ray) / w)) {
      hit = {static_cast<int>(i), w};
    }
  }
  return hit;
}

SceneView::SceneView(const SceneLens& lens, const cv::Vec3d& centre, const SceneConfig& config)
    : width_(config.width),
      height_(config.height),
      cells_x_((config.width + kCell - 1) / kCell),
      cells_y_((config.height + kCell - 1) / kCell),
      vignetting_(config.vignetting),
      corner_r2_(
          std::max(1.0, (config.width * double(config.width) + config.height * double(config.height)) / 4)),
      centre_(centre) {
  rays_.reserve(area(cells_x_ + 1, cells_y_ + 1));
  for (int y = 0; y <= cells_y_; ++y) {
    for (int x = 0; x <= cells_x_; ++x) {
      // A cell spans its pixels' areas: its corners lie half a pixel outside the pixel centres.
      rays_.push_back(lens.unproject({x * kCell - 0.5, y * kCell - 0.5}));
    }
  }
}

cv::Mat SceneView::render(const std::vector<SceneSurface>& surfaces, const SceneTextures& textures,
                          const SensorNoise& noise) const {
  const std::vector<SurfaceForms> forms = surface_forms(surfaces, centre_);
  const Sensor sensor(noise);
  cv::Mat image(height_, width_, CV_8UC1);
  Candidates candidates;
  std::vector<Cast> row, step;
  CellLight light;
  for (int cy = 0; cy < cells_y_; ++cy) {
    for (int cx = 0; cx < cells_x_; ++cx) {
      const cv::Vec2d* top = &rays_[cy * (cells_x_ + 1) + cx];
      const cv::Vec2d* bottom = top + cells_x_ + 1;
      find_candidates(candidates, surfaces, forms, textures, {top[0], top[1], bottom[0], bottom[1]});
      cast_cell(candidates, row, step, light);
      for (int y = cy * kCell; y < std::min(height_, (cy + 1) * kCell); ++y) {
        auto* out = image.ptr<std::uint8_t>(y);
        const double dy = y - (height_ - 1) / 2.0;
        for (int x = cx * kCell; x < std::min(width_, (cx + 1) * kCell); ++x) {
          const double dx = x - (width_ - 1) / 2.0;
          const int loss = static_cast<int>(vignetting_ * 65536 * (dx * dx + dy * dy) / corner_r2_);
          const int sum = light[y % kCell][x % kCell];
          const int seen = static_cast<int>((std::int64_t{sum} * (65536 - loss)) >> 16);
          out[x] = sensor.expose(seen, (static_cast<std::uint64_t>(y) << 32) | x);
        }
      }
    }
  }
  return image;
}

}  // namespace parallax
