// SPDX-License-Identifier: Apache-2.0
#include "platform/input/lens.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr double kLargestSkew = 1e-4;  // of the focal length

bool one_of(const std::string& name, std::initializer_list<const char*> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::optional<LensModel> distortion_model(const std::string& name) {
  if (one_of(name,
             {"plumb_bob", "radtan", "radial_tangential", "radial-tangential", "rational_polynomial"})) {
    return LensModel::kPinhole;
  }
  if (one_of(name, {"equidistant", "equi", "fisheye", "kannala_brandt", "kannala_brandt4"})) {
    return LensModel::kFisheye;
  }
  return std::nullopt;
}

void check_camera(const cv::Matx33d& k, const std::string& where) {
  const bool finite = std::all_of(k.val, k.val + 9, [](double value) { return std::isfinite(value); });
  if (!finite || !plausible_focal(k(0, 0)) || !plausible_focal(k(1, 1)) ||
      std::abs(k(2, 2) - 1) > kRotationTolerance) {
    throw UserError(fmt::format("{}: not a camera matrix: focal lengths {} and {} px, last element {}", where,
                                k(0, 0), k(1, 1), k(2, 2)));
  }
  const double limit = kLargestSkew * k(0, 0);
  if (std::abs(k(0, 1)) > limit || std::abs(k(1, 0)) > limit || std::abs(k(2, 0)) > kLargestSkew ||
      std::abs(k(2, 1)) > kLargestSkew) {
    throw UserError(
        fmt::format("{}: not a camera matrix without skew: f 0 cx; 0 f cy; 0 0 1 expected, elements "
                    "(0,1), (1,0), (2,0) and (2,1) are {}, {}, {} and {}",
                    where, k(0, 1), k(1, 0), k(2, 0), k(2, 1)));
  }
}

void check_distortion(const std::vector<double>& coefficients, LensModel model, const std::string& where) {
  const std::vector<std::size_t> counts =
      model == LensModel::kFisheye ? std::vector<std::size_t>{4} : std::vector<std::size_t>{4, 5, 8, 12, 14};
  if (std::find(counts.begin(), counts.end(), coefficients.size()) == counts.end()) {
    throw UserError(fmt::format("{}: {} coefficients, {} expected for this camera model", where,
                                coefficients.size(), fmt::join(counts, ", ")));
  }
}

void check_rotation(const cv::Matx33d& r, const std::string& where) {
  if (!(cv::norm(r * r.t() - cv::Matx33d::eye(), cv::NORM_INF) <= kRotationTolerance) ||
      cv::determinant(r) < 0) {
    throw UserError(where + ": not a rotation matrix");
  }
}

}  // namespace parallax
