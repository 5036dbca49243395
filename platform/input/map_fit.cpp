// SPDX-License-Identifier: Apache-2.0
#include "platform/input/map_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "platform/input/raw_maps.hpp"
#include "tlm/units.hpp"

namespace parallax {

namespace {

// The search looks at a grid of samples; the result is verified on every pixel.
constexpr int kColumns = 49;
constexpr int kRows = 37;
constexpr double kZoomStep = 1.01;
constexpr int kZoomSteps = 139;  // 1.01^139 = 3.99
constexpr int kShiftIterations = 25;
// A zoom is given up when, after a few shifts, one more does not take off a tenth of what is left beyond the
// window.
constexpr int kPatience = 3;
constexpr double kProgress = 0.9;
constexpr int kRefinements = 8;
constexpr int kVerifications = 6;
constexpr double kLargestReach = (OffsetRange::kLargestWindow - 1) / 2.0;

struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(const Interval& other) {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
  }
  /// How far it extends beyond +-reach; 0 or less if it does not.
  double beyond(double reach) const { return std::max(high, -low) - reach; }
  /// The least shift that brings the interval within +-reach; the one that centres it when it is too long.
  double shift_into(double reach) const {
    if (high - low > 2 * reach) {
      return -(high + low) / 2;
    }
    return high > reach ? reach - high : low < -reach ? -reach - low : 0;
  }
};

// The range of source - target over the samples; infinite if a sample has no source.
Interval offsets(const cv::Mat& map, double step, bool horizontal) {
  Interval interval;
  for (int y = 0; y < map.rows; ++y) {
    for (int x = 0; x < map.cols; ++x) {
      const double value = map.at<float>(y, x) - (horizontal ? x : y) * step;
      if (!std::isfinite(value)) {
        return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
      }
      interval.add({value, value});
    }
  }
  return interval;
}

Calibration moved(const Calibration& calibration, const Fit& fit) {
  Calibration c = calibration;
  const auto apply = [&fit](cv::Matx34d& p, double shift_x) {
    p(0, 0) *= fit.zoom;
    p(1, 1) *= fit.zoom;
    p(0, 3) *= fit.zoom;
    p(1, 3) *= fit.zoom;
    p(0, 2) += shift_x;
    p(1, 2) += fit.shift_y;
  };
  apply(c.P1, fit.shift_left_x);
  apply(c.P2, fit.shift_right_x);
  c.geometry = geometry_of(c.P1, c.P2);
  return c;
}

// Pixels of the band whose source lies outside the raw image.
std::size_t outside(const cv::Mat& map_x, const cv::Mat& map_y, const ImageSize& size) {
  std::size_t count = 0;
  const auto right = static_cast<float>(size.width - 1);
  const auto bottom = static_cast<float>(size.height - 1);
  for (int y = 0; y < map_x.rows; ++y) {
    for (int x = 0; x < map_x.cols; ++x) {
      const float source_x = map_x.at<float>(y, x);
      const float source_y = map_y.at<float>(y, x);
      count += source_x < 0 || source_x > right || source_y < 0 || source_y > bottom ? 1U : 0U;
    }
  }
  return count;
}

// Whether every pixel of the fit is within the window; then says how many lie outside the raw images.
bool verify(Fit& fit, const OffsetRange& range) {
  WindowSurvey found;
  std::size_t count = 0;
  for_each_band(fit.calibration, [&](const RawMaps& band) {
    found.add(band, range);
    count += outside(band.left_x, band.left_y, fit.calibration.size) +
             outside(band.right_x, band.right_y, fit.calibration.size);
  });
  fit.outside = quotient(count, 2.0 * static_cast<double>(found.pixels));
  return found.fits();
}

class Search {
 public:
  Search(const Calibration& calibration, double reach, bool common)
      : calibration_(calibration), reach_(reach), common_(common) {
    columns_ = std::min(kColumns, calibration.size.width);
    rows_ = std::min(kRows, calibration.size.height);
    step_x_ = columns_ > 1 ? (calibration.size.width - 1.0) / (columns_ - 1.0) : 1;
    step_y_ = rows_ > 1 ? (calibration.size.height - 1.0) / (rows_ - 1.0) : 1;
  }

  /// Zooms away from 1 in both directions until one fits, then back toward 1 as far as it still does.
  std::optional<Fit> run() const {
    for (int step = 0; step <= kZoomSteps; ++step) {
      for (const int direction : {1, -1}) {
        if (std::optional<Fit> found = at_zoom(std::pow(kZoomStep, direction * step))) {
          return step == 0 ? found : refine(*found, direction * (step - 1));
        }
      }
    }
    return std::nullopt;
  }

  /// How far beyond the reach the best zoom and shift are.
  double least_beyond() const {
    double least = std::numeric_limits<double>::infinity();
    for (int step = -kZoomSteps; step <= kZoomSteps; ++step) {
      Fit fit;
      fit.zoom = std::pow(kZoomStep, step);
      least = std::min(least, settle(fit));
    }
    return least;
  }

 private:
  std::optional<Fit> at_zoom(double zoom) const {
    Fit fit;
    fit.zoom = zoom;
    return settle(fit) <= 0 ? std::optional<Fit>(fit) : std::nullopt;
  }

  // Shifts `fit` until its offsets are within reach or get no closer; returns how far beyond they are at
  // best.
  double settle(Fit& fit) const {
    double best = std::numeric_limits<double>::infinity();
    double previous = best;
    for (int i = 0; i < kShiftIterations; ++i) {
      const RawMaps maps = sampled_maps(moved(calibration_, fit), columns_, rows_);
      Interval left = offsets(maps.left_x, step_x_, true);
      Interval right = offsets(maps.right_x, step_x_, true);
      Interval vertical = offsets(maps.left_y, step_y_, false);
      vertical.add(offsets(maps.right_y, step_y_, false));
      if (common_) {
        left.add(right);
        right = left;
      }
      const double beyond = std::max({left.beyond(reach_), right.beyond(reach_), vertical.beyond(reach_)});
      best = std::min(best, beyond);
      if (beyond <= 0 || !std::isfinite(beyond) || (i >= kPatience && beyond > kProgress * previous)) {
        break;
      }
      previous = beyond;
      // Moving the principal point by s moves the offsets by about -s. A little inside, so that it converges.
      const double inside = std::max(reach_ - 0.05, 0.0);
      fit.shift_left_x -= left.shift_into(inside);
      fit.shift_right_x -= right.shift_into(inside);
      fit.shift_y -= vertical.shift_into(inside);
    }
    return best;
  }

  Fit refine(Fit best, int failing_step) const {
    double failing = std::pow(kZoomStep, failing_step);
    for (int i = 0; i < kRefinements; ++i) {
      const double middle = std::sqrt(failing * best.zoom);
      if (const std::optional<Fit> found = at_zoom(middle)) {
        best = *found;
      } else {
        failing = middle;
      }
    }
    return best;
  }

  const Calibration& calibration_;
  double reach_;
  bool common_;
  int columns_;
  int rows_;
  double step_x_;
  double step_y_;
};

}  // namespace

std::string Fit::text() const {
  const std::string shift =
      common_shift()
          ? fmt::format("shift ({:+.2f}, {:+.2f}) px", shift_left_x, shift_y)
          : fmt::format(
                "shift ({:+.2f}, {:+.2f}) px left and ({:+.2f}, {:+.2f}) px right, which adds {:+.2f} "
                "px to every disparity",
                shift_left_x, shift_y, shift_right_x, shift_y, shift_left_x - shift_right_x);
  return fmt::format("zoom {:.4f}, {}; {:.1f} % of the pixels lie outside the raw images", zoom, shift,
                     100 * outside);
}

std::optional<Fit> fit(const Calibration& calibration, const OffsetRange& range) {
  range.validate();
  if (calibration.model == LensModel::kRectified) {
    Fit unchanged;
    unchanged.calibration = calibration;
    return unchanged;
  }
  for (const bool common : {true, false}) {
    double reach = range.reach();
    for (int i = 0; i < kVerifications; ++i) {
      std::optional<Fit> found = Search(calibration, reach, common).run();
      if (!found) {
        break;
      }
      found->calibration = moved(calibration, *found);
      if (verify(*found, range)) return found;
      // Between the samples an offset was larger: search again a little tighter.
      reach -= 0.1;
    }
  }
  return std::nullopt;
}

int smallest_window(const Calibration& calibration, const OffsetRange& range) {
  const double reach = Search(calibration, 0, true).least_beyond();
  OffsetRange wider = range;
  if (!(reach <= kLargestReach)) {
    return 0;
  }
  wider.window = 2 * static_cast<int>(std::ceil(reach)) + 1;
  for (int i = 0; i < kVerifications && wider.limit() <= OffsetRange::kLargestLimit; ++i, wider.window += 2) {
    if (fit(calibration, wider)) {
      return wider.window;
    }
  }
  return 0;
}

}  // namespace parallax
