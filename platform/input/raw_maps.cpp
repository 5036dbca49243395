// SPDX-License-Identifier: Apache-2.0
#include "platform/input/raw_maps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <stdexcept>

namespace parallax {

namespace {

void undistort_maps(LensModel model, const Lens& lens, const cv::Matx33d& rotation, const cv::Matx33d& camera,
                    const cv::Size& size, cv::Mat& x, cv::Mat& y) {
  if (model == LensModel::kFisheye) {
    cv::fisheye::initUndistortRectifyMap(lens.camera, lens.distortion, rotation, camera, size, CV_32FC1, x,
                                         y);
  } else {
    cv::initUndistortRectifyMap(lens.camera, lens.distortion, rotation, camera, size, CV_32FC1, x, y);
  }
}

// Maps of `size` samples; sample (i, j) is the image's pixel (i * step_x, j * step_y).
RawMaps maps_at(const Calibration& c, const cv::Size& size, double step_x, double step_y) {
  RawMaps maps;
  if (c.model == LensModel::kRectified) {
    maps.left_x.create(size, CV_32FC1);
    maps.left_y.create(size, CV_32FC1);
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        maps.left_x.at<float>(y, x) = static_cast<float>(x * step_x);
        maps.left_y.at<float>(y, x) = static_cast<float>(y * step_y);
      }
    }
    maps.right_x = maps.left_x.clone();
    maps.right_y = maps.left_y.clone();
    return maps;
  }
  const auto camera = [&](const cv::Matx34d& p) {
    return cv::Matx33d(p(0, 0) / step_x, p(0, 1) / step_x, p(0, 2) / step_x, p(1, 0) / step_y,
                       p(1, 1) / step_y, p(1, 2) / step_y, p(2, 0), p(2, 1), p(2, 2));
  };
  undistort_maps(c.model, c.left, c.R1, camera(c.P1), size, maps.left_x, maps.left_y);
  undistort_maps(c.model, c.right, c.R2, camera(c.P2), size, maps.right_x, maps.right_y);
  return maps;
}

// The offset of a coordinate in 1/scale px, before it is known to fit into an integer.
double offset(float source, int target, int scale) {
  return std::nearbyint(static_cast<double>(source) * scale) - static_cast<double>(target) * scale;
}

void survey_image(const cv::Mat& map_x, const cv::Mat& map_y, const OffsetRange& range,
                  WindowSurvey::Image& image, double& largest) {
  const int scale = 1 << range.fraction_bits;
  const double limit = range.limit();
  for (int y = 0; y < map_x.rows; ++y) {
    const auto* row_x = map_x.ptr<float>(y);
    const auto* row_y = map_y.ptr<float>(y);
    for (int x = 0; x < map_x.cols; ++x) {
      const double dx = offset(row_x[x], x, scale);
      const double dy = offset(row_y[x], y, scale);
      const double size = std::max(std::abs(dx), std::abs(dy));
      if (size <= limit) {
        largest = std::max(largest, size);
        continue;
      }
      if (image.beyond++ == 0) {
        image.x = x;
        image.y = y;
        image.dx = dx / scale;
        image.dy = dy / scale;
      }
      // A comparison that NaN survives.
      largest = largest >= size ? largest : size;
    }
  }
}

double kbit(int window, int width) { return 2.0 * 8.0 * window * width / 1000.0; }

}  // namespace

RawMaps raw_maps(const Calibration& calibration) {
  return maps_at(calibration, {calibration.size.width, calibration.size.height}, 1, 1);
}

RawMaps sampled_maps(const Calibration& calibration, int columns, int rows) {
  const auto step = [](int pixels, int samples) {
    return samples > 1 ? (pixels - 1.0) / (samples - 1.0) : 1.0;
  };
  return maps_at(calibration, {columns, rows}, step(calibration.size.width, columns),
                 step(calibration.size.height, rows));
}

RawMaps raw_maps(const RectificationMap& map) {
  const cv::Size size(map.width, map.height);
  RawMaps maps{cv::Mat(size, CV_32FC1), cv::Mat(size, CV_32FC1), cv::Mat(size, CV_32FC1),
               cv::Mat(size, CV_32FC1)};
  const float scale = static_cast<float>(1 << map.range.fraction_bits);
  const auto source = [scale](int target, int offset_units) {
    return static_cast<float>(target) + static_cast<float>(offset_units) / scale;
  };
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const OffsetPair& pair = map.row(y)[x];
      maps.left_x.at<float>(y, x) = source(x, pair.left.dx);
      maps.left_y.at<float>(y, x) = source(y, pair.left.dy);
      maps.right_x.at<float>(y, x) = source(x, pair.right.dx);
      maps.right_y.at<float>(y, x) = source(y, pair.right.dy);
    }
  }
  return maps;
}

WindowSurvey survey(const RawMaps& maps, const OffsetRange& range) {
  WindowSurvey result;
  double largest = 0;
  survey_image(maps.left_x, maps.left_y, range, result.left, largest);
  survey_image(maps.right_x, maps.right_y, range, result.right, largest);
  const double reach = std::ceil(largest / (1 << range.fraction_bits));
  result.window_needed = reach < 1e6 ? 2 * static_cast<int>(reach) + 1 : 0;
  return result;
}

std::string describe(const WindowSurvey& survey, const RawMaps& maps, const OffsetRange& range,
                     const std::string& remedy) {
  const bool left = survey.left.beyond > 0;
  const WindowSurvey::Image& first = left ? survey.left : survey.right;
  const int width = maps.left_x.cols;
  const std::string larger =
      survey.window_needed == 0
          ? std::string("no window would do")
          : fmt::format("a window of {} would do (line storage of both images {:.0f} instead of {:.0f} kbit)",
                        survey.window_needed, kbit(survey.window_needed, width), kbit(range.window, width));
  return fmt::format(
      "{} image: pixel ({}, {}) needs the offset ({:+.2f}, {:+.2f}) px, beyond the window of {} (-{}..+{} "
      "px); {} of {} "
      "pixels are affected in the left image, {} in the right; {}{}",
      left ? "left" : "right", first.x, first.y, first.dx, first.dy, range.window, range.reach(),
      range.reach(), survey.left.beyond, maps.left_x.total(), survey.right.beyond, larger, remedy);
}

RectificationMap quantise(const RawMaps& maps, const OffsetRange& range) {
  if (!survey(maps, range).fits()) {
    throw std::invalid_argument(
        "a rectification map whose offsets are beyond the window cannot be quantised");
  }
  const int scale = 1 << range.fraction_bits;
  RectificationMap map = identity_map(maps.left_x.cols, maps.left_x.rows, range);
  const auto quantised = [scale](const cv::Mat& source, int x, int y, int target) {
    return static_cast<std::int16_t>(offset(source.at<float>(y, x), target, scale));
  };
  OffsetPair* out = map.offsets.data();
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x, ++out) {
      out->left = {quantised(maps.left_x, x, y, x), quantised(maps.left_y, x, y, y)};
      out->right = {quantised(maps.right_x, x, y, x), quantised(maps.right_y, x, y, y)};
    }
  }
  return map;
}

}  // namespace parallax
