// SPDX-License-Identifier: Apache-2.0
#include "platform/input/stereo_geometry.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "platform/input/lens.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr double kLargestCentre = 1e6;    // px
constexpr double kFocalAgreement = 1e-4;  // 0.1 px at 1000 px from the principal point
constexpr double kCentreAgreement = 0.1;  // px
constexpr double kLevel = 0.02;           // of the baseline
constexpr double kNoBaseline = 1e-9;      // px * unit, and of the fourth columns themselves
constexpr double kLargestBaseline = 1e9;  // in any unit
constexpr double kZero = 1e-9;            // for elements that are zero by definition
constexpr double kQAgreement = 1e-3;      // for files with four digits and more

[[noreturn]] void refuse(const std::string& where, const std::string& what) {
  throw UserError(fmt::format("{}: {}", where, what));
}

void check_projection(const cv::Matx34d& p, const std::string& where) {
  for (const double value : p.val) {
    if (!std::isfinite(value)) {
      refuse(where, "a projection matrix with a value that is not finite: the calibration is implausible");
    }
  }
  if (!plausible_focal(p(0, 0)) || !plausible_focal(p(1, 1))) {
    refuse(where, fmt::format("focal lengths {} and {} px; those of a rectified image are from {} to {} px",
                              p(0, 0), p(1, 1), kLeastFocal, kLargestFocal));
  }
  if (std::abs(p(0, 2)) > kLargestCentre || std::abs(p(1, 2)) > kLargestCentre) {
    refuse(where,
           fmt::format("principal point ({}, {}) px: the calibration is implausible", p(0, 2), p(1, 2)));
  }
  if (std::abs(p(0, 1)) > kFocalAgreement * p(0, 0) || std::abs(p(1, 0)) > kFocalAgreement * p(1, 1)) {
    refuse(where, fmt::format("skewed: elements (0,1) and (1,0) are {} and {}; those of a rectified image "
                              "are 0",
                              p(0, 1), p(1, 0)));
  }
  if (std::abs(p(2, 0)) > kZero || std::abs(p(2, 1)) > kZero || std::abs(p(2, 2) - 1) > kZero) {
    refuse(where,
           fmt::format("the third row begins with {}, {}, {}; that of a projection matrix with 0, 0, 1",
                       p(2, 0), p(2, 1), p(2, 2)));
  }
}

void check_agreement(const cv::Matx34d& left, const cv::Matx34d& right, const std::string& where) {
  for (const int axis : {0, 1}) {
    const double focal = left(axis, axis);
    if (std::abs(focal - right(axis, axis)) > kFocalAgreement * focal) {
      refuse(where, fmt::format("{} focal lengths {} px left and {} px right; rectified images have one",
                                axis == 0 ? "horizontal" : "vertical", focal, right(axis, axis)));
    }
  }
  if (std::abs(left(1, 2) - right(1, 2)) > kCentreAgreement) {
    refuse(where, fmt::format("principal points at row {} left and {} right; rectified images have them at "
                              "the same one",
                              left(1, 2), right(1, 2)));
  }
}

// How the right camera lies against the left one: the only place that knows how far off level is level.
void check_baseline(const cv::Matx34d& left, const cv::Matx34d& right, const std::string& where) {
  const double columns = left(0, 3) - right(0, 3);
  const double below = (left(1, 3) - right(1, 3)) / left(1, 1);
  const double before = left(2, 3) - right(2, 3);
  const double baseline = columns / left(0, 0);
  if (std::abs(below) > std::abs(baseline) && std::abs(below * left(1, 1)) > kNoBaseline) {
    refuse(where, fmt::format("the cameras are above each other, {:.4g} against {:.4g} beside; only side by "
                              "side cameras are supported",
                              std::abs(below), std::abs(baseline)));
  }
  if (std::abs(columns) <= kNoBaseline * (1 + std::abs(left(0, 3)) + std::abs(right(0, 3)))) {
    refuse(where,
           fmt::format("no baseline: element (0,3) is {} left and {} right; it is smaller on the right "
                       "by focal length * baseline",
                       left(0, 3), right(0, 3)));
  }
  if (baseline < 0) {
    refuse(where, fmt::format("the right camera lies {:.4g} to the left of the left one; are the images "
                              "exchanged?",
                              -baseline));
  }
  if (baseline > kLargestBaseline) {
    refuse(where, fmt::format("a baseline of {:.4g}: the calibration is implausible", baseline));
  }
  if (std::abs(below) > kLevel * baseline || std::abs(before) > kLevel * baseline) {
    refuse(where, fmt::format("the right camera lies {:.4g} below and {:.4g} before the left one, more than "
                              "{} % of the baseline of {:.4g}: rows do not match",
                              below, before, 100 * kLevel, baseline));
  }
}

}  // namespace

cv::Matx44d disparity_to_depth(const StereoGeometry& g) {
  const double rows = g.focal_x / g.focal_y;
  return {1,
          0,
          0,
          -g.cx_left,  //
          0,
          rows,
          0,
          -g.cy * rows,  //
          0,
          0,
          0,
          g.focal_x,  //
          0,
          0,
          1 / g.baseline,
          g.doffs() / g.baseline};
}

StereoGeometry geometry_of(const cv::Matx34d& P1, const cv::Matx34d& P2) {
  StereoGeometry geometry;
  geometry.focal_x = P1(0, 0);
  geometry.focal_y = P1(1, 1);
  geometry.cx_left = P1(0, 2);
  geometry.cx_right = P2(0, 2);
  geometry.cy = P1(1, 2);
  geometry.baseline = (P1(0, 3) - P2(0, 3)) / P1(0, 0);
  return geometry;
}

void check_projections(const cv::Matx34d& P1, const cv::Matx34d& P2, const std::string& where) {
  check_projection(P1, where);
  check_projection(P2, where);
  check_agreement(P1, P2, where);
  check_baseline(P1, P2, where);
}

StereoGeometry geometry_of(const cv::Matx44d& stated, const std::string& where) {
  const double factor = stated(0, 0);
  const cv::Matx44d q = stated * (factor == 0 ? 1 : 1 / factor);
  double elsewhere = 0;
  for (const auto& [row, column] :
       {std::array{0, 1}, {0, 2}, {1, 0}, {1, 2}, {2, 0}, {2, 1}, {2, 2}, {3, 0}, {3, 1}}) {
    elsewhere += std::abs(q(row, column));
  }
  // A comparison that NaN fails.
  if (factor == 0 || !(elsewhere <= kZero) || !(q(1, 1) > 0) || !std::isfinite(q(3, 3))) {
    refuse(where,
           "not of the form that cv::stereoRectify gives: "
           "1 0 0 -cx; 0 1 0 -cy; 0 0 0 f; 0 0 1/baseline (cx_right - cx)/baseline");
  }
  if (!(q(3, 2) >= 1 / kLargestBaseline)) {
    refuse(where,
           fmt::format(
               "element (3,2), 1/baseline, is {}; with a right camera to the right of the left one it is {} "
               "and more",
               q(3, 2), 1 / kLargestBaseline));
  }
  StereoGeometry geometry;
  geometry.focal_x = q(2, 3);
  geometry.focal_y = q(2, 3) / q(1, 1);
  geometry.baseline = 1 / q(3, 2);
  geometry.cx_left = -q(0, 3);
  geometry.cx_right = geometry.cx_left + q(3, 3) / q(3, 2);
  geometry.cy = -q(1, 3) / q(1, 1);
  if (!plausible_focal(geometry.focal_x) || !plausible_focal(geometry.focal_y)) {
    refuse(where, fmt::format("focal lengths {} and {} px; those of a rectified image are from {} to {} px",
                              geometry.focal_x, geometry.focal_y, kLeastFocal, kLargestFocal));
  }
  for (const double centre : {geometry.cx_left, geometry.cx_right, geometry.cy}) {
    if (!(std::abs(centre) <= kLargestCentre)) {
      refuse(where,
             fmt::format("principal points at columns {} and {}, row {}: the calibration is implausible",
                         geometry.cx_left, geometry.cx_right, geometry.cy));
    }
  }
  return geometry;
}

void check_same(const StereoGeometry& p, const StereoGeometry& q, const std::string& where) {
  const auto compare = [&where](const char* what, double of_p, double of_q, double tolerance) {
    if (std::abs(of_p - of_q) > tolerance) {
      refuse(where,
             fmt::format("Q contradicts the projections: {} {:.6g} in Q, {:.6g} in them", what, of_q, of_p));
    }
  };
  compare("focal length", p.focal_x, q.focal_x, kQAgreement * p.focal_x);
  compare("vertical focal length", p.focal_y, q.focal_y, kQAgreement * p.focal_y);
  compare("baseline", p.baseline, q.baseline, kQAgreement * p.baseline);
  compare("principal point's column", p.cx_left, q.cx_left, kCentreAgreement);
  compare("principal point's row", p.cy, q.cy, kCentreAgreement);
  compare("distance of the principal points", p.doffs(), q.doffs(), kCentreAgreement);
}

}  // namespace parallax
