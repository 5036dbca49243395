// SPDX-License-Identifier: Apache-2.0
#include "platform/input/raw_maps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <stdexcept>

namespace parallax {

namespace {

constexpr int kBandRows = 64;

void undistort_maps(LensModel model, const Lens& lens, const cv::Matx33d& rotation, const cv::Matx33d& camera,
                    const cv::Size& size, cv::Mat& x, cv::Mat& y) {
  if (model == LensModel::kFisheye) {
    cv::fisheye::initUndistortRectifyMap(lens.camera, lens.distortion, rotation, camera, size, CV_32FC1, x,
                                         y);
  } else {
    cv::initUndistortRectifyMap(lens.camera, lens.distortion, rotation, camera, size, CV_32FC1, x, y);
  }
}

// Maps of `size` samples; sample (i, j) is the image's pixel (i * step_x, (first_row + j) * step_y).
RawMaps maps_at(const Calibration& c, const cv::Size& size, double step_x, double step_y, int first_row = 0) {
  RawMaps maps;
  maps.first_row = first_row;
  if (c.model == LensModel::kRectified) {
    maps.left_x.create(size, CV_32FC1);
    maps.left_y.create(size, CV_32FC1);
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        maps.left_x.at<float>(y, x) = static_cast<float>(x * step_x);
        maps.left_y.at<float>(y, x) = static_cast<float>((first_row + y) * step_y);
      }
    }
    maps.right_x = maps.left_x.clone();
    maps.right_y = maps.left_y.clone();
    return maps;
  }
  const auto camera = [&](const cv::Matx34d& p) {
    return cv::Matx33d(p(0, 0) / step_x, p(0, 1) / step_x, p(0, 2) / step_x, p(1, 0) / step_y,
                       p(1, 1) / step_y, p(1, 2) / step_y - first_row, p(2, 0), p(2, 1), p(2, 2));
  };
  undistort_maps(c.model, c.left, c.R1, camera(c.P1), size, maps.left_x, maps.left_y);
  undistort_maps(c.model, c.right, c.R2, camera(c.P2), size, maps.right_x, maps.right_y);
  return maps;
}

// Rounds half to even, in a few instructions where the library's nearbyint() is a call: beyond 2^52 a double
// has no fraction. Exact up to 2^51, which no offset in a window comes near; infinity and NaN stay.
double rounded(double value) {
  constexpr double kNoFraction = 1.5 * 4503599627370496.0;  // 1.5 * 2^52
  return (value + kNoFraction) - kNoFraction;
}

// The offset of a coordinate in 1/scale px, before it is known to fit into an integer.
double offset(float source, int target, int scale) {
  return rounded(double{source} * scale) - 1.0 * target * scale;
}

void survey_image(const cv::Mat& map_x, const cv::Mat& map_y, int first_row, const OffsetRange& range,
                  WindowSurvey::Image& image, double& largest) {
  const int scale = 1 << range.fraction_bits;
  const double limit = range.limit();
  for (int i = 0; i < map_x.rows; ++i) {
    const auto* row_x = map_x.ptr<float>(i);
    const auto* row_y = map_y.ptr<float>(i);
    const int y = first_row + i;
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

void for_each_band(const Calibration& calibration, const std::function<void(const RawMaps& band)>& take) {
  for (int y = 0; y < calibration.size.height; y += kBandRows) {
    const int rows = std::min(kBandRows, calibration.size.height - y);
    take(maps_at(calibration, {calibration.size.width, rows}, 1, 1, y));
  }
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

void WindowSurvey::add(const RawMaps& band, const OffsetRange& range) {
  survey_image(band.left_x, band.left_y, band.first_row, range, left, largest);
  survey_image(band.right_x, band.right_y, band.first_row, range, right, largest);
  width = band.left_x.cols;
  pixels += band.left_x.total();
  const double reach = std::ceil(largest / (1 << range.fraction_bits));
  window_needed = reach < 1e6 ? 2 * static_cast<int>(reach) + 1 : 0;
}

WindowSurvey survey(const RawMaps& maps, const OffsetRange& range) {
  WindowSurvey result;
  result.add(maps, range);
  return result;
}

std::string describe(const WindowSurvey& survey, const OffsetRange& range, const std::string& remedy) {
  const bool left = survey.left.beyond > 0;
  const WindowSurvey::Image& first = left ? survey.left : survey.right;
  const std::string larger =
      survey.window_needed == 0
          ? std::string("no window would do")
          : fmt::format("a window of {} would do (line storage of both images {:.0f} instead of {:.0f} kbit)",
                        survey.window_needed, kbit(survey.window_needed, survey.width),
                        kbit(range.window, survey.width));
  return fmt::format(
      "{} image: pixel ({}, {}) needs the offset ({:+.2f}, {:+.2f}) px, beyond the window of {} (-{}..+{} "
      "px); {} of {} "
      "pixels are affected in the left image, {} in the right; {}{}",
      left ? "left" : "right", first.x, first.y, first.dx, first.dy, range.window, range.reach(),
      range.reach(), survey.left.beyond, survey.pixels, survey.right.beyond, larger, remedy);
}

RectificationMap quantise(const RawMaps& maps, const OffsetRange& range) {
  if (!survey(maps, range).fits()) {
    throw std::invalid_argument(
        "a rectification map whose offsets are beyond the window cannot be quantised");
  }
  RectificationMap map = identity_map(maps.left_x.cols, maps.left_x.rows, range);
  OffsetPair* next = map.offsets.data();
  quantise_rows(maps, range, [&](const OffsetPair* row) { next = std::copy_n(row, map.width, next); });
  return map;
}

void quantise_rows(const RawMaps& band, const OffsetRange& range, const RowSink<OffsetPair>& emit) {
  const int scale = 1 << range.fraction_bits;
  std::vector<OffsetPair> row(band.left_x.cols);
  const auto quantised = [scale](const float* source, int x, int target) {
    return static_cast<std::int16_t>(offset(source[x], target, scale));
  };
  for (int i = 0; i < band.left_x.rows; ++i) {
    const float* const left_x = band.left_x.ptr<float>(i);
    const float* const left_y = band.left_y.ptr<float>(i);
    const float* const right_x = band.right_x.ptr<float>(i);
    const float* const right_y = band.right_y.ptr<float>(i);
    const int y = band.first_row + i;
    for (int x = 0; x < band.left_x.cols; ++x) {
      OffsetPair& pair = row[x];
      pair.left = {quantised(left_x, x, x), quantised(left_y, x, y)};
      pair.right = {quantised(right_x, x, x), quantised(right_y, x, y)};
    }
    emit(row.data());
  }
}

}  // namespace parallax
