// SPDX-License-Identifier: Apache-2.0
#include "platform/input/calibration.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <optional>

#include "platform/input/calibration_file.hpp"
#include "tlm/error.hpp"

namespace parallax {

namespace {

// How far R may be from a rotation: calibrations written with few digits pass, garbled ones do not.
constexpr double kRotationTolerance = 1e-2;

using Names = std::vector<std::string>;

[[noreturn]] void fail(const std::string& source, const std::string& what) {
  throw UserError(fmt::format("{}: {}", source, what));
}

template <int R, int C>
cv::Matx<double, R, C> matrix(const CalibrationFile& file, const Names& names) {
  const std::vector<double> values = file.numbers(names, {{R, C}});
  return cv::Matx<double, R, C>(values.data());
}

LensModel model_of(const CalibrationFile& file) {
  const std::string name = file.text({"camera_model", "distortion_model"}, "pinhole_radtan");
  for (const char* known : {"pinhole_radtan", "pinhole", "plumb_bob", "radtan", "rational_polynomial"}) {
    if (name == known) {
      return LensModel::kPinhole;
    }
  }
  for (const char* known : {"fisheye_equidistant", "fisheye", "equidistant", "kannala_brandt"}) {
    if (name == known) {
      return LensModel::kFisheye;
    }
  }
  if (name == "rectified") {
    return LensModel::kRectified;
  }
  fail(file.name(),
       fmt::format("camera_model: \"{}\" is not pinhole_radtan, fisheye_equidistant or rectified", name));
}

ImageSize size_of(const CalibrationFile& file, const ImageSize& fallback) {
  ImageSize size = fallback;
  if (file.has({"image_size", "imageSize"})) {
    const std::vector<double> values = file.numbers({"image_size", "imageSize"}, {{2, 1}, {1, 2}});
    size = {static_cast<int>(values[0]), static_cast<int>(values[1])};
  } else if (file.has({"image_width"}) || file.has({"image_height"})) {
    size = {static_cast<int>(file.numbers({"image_width"}, {{1, 1}})[0]),
            static_cast<int>(file.numbers({"image_height"}, {{1, 1}})[0])};
  } else if (size.width == 0) {
    fail(file.name(), "image_width and image_height are missing");
  }
  if (size.width < 1 || size.height < 1 || size.width > 65535 || size.height > 65535) {
    fail(file.name(),
         fmt::format("image_width, image_height: {}x{} is not an image size", size.width, size.height));
  }
  return size;
}

Lens read_lens(const CalibrationFile& file, LensModel model, const std::string& side) {
  Lens lens;
  lens.camera = matrix<3, 3>(file, {"K" + side, "M" + side, "cameraMatrix" + side});
  const cv::Matx33d& k = lens.camera;
  if (!(k(0, 0) > 0) || !(k(1, 1) > 0) || std::abs(k(2, 2) - 1) > kRotationTolerance) {
    fail(file.name(), fmt::format("K{}: not a camera matrix: focal lengths {} and {} px, last element {}",
                                  side, k(0, 0), k(1, 1), k(2, 2)));
  }
  const Names names = {"D" + side, "distCoeffs" + side, "distortion" + side};
  const std::vector<int> counts =
      model == LensModel::kFisheye ? std::vector<int>{4} : std::vector<int>{4, 5, 8, 12, 14};
  lens.distortion = file.numbers(names, {});
  for (const int count : counts) {
    if (lens.distortion.size() == static_cast<std::size_t>(count)) {
      return lens;
    }
  }
  fail(file.name(), fmt::format("D{}: {} coefficients, {} expected for this camera model", side,
                                lens.distortion.size(), fmt::join(counts, ", ")));
}

cv::Matx33d rotation(const CalibrationFile& file, const std::string& name) {
  const std::vector<double> values = file.numbers({name}, {{3, 3}, {3, 1}, {1, 3}});
  cv::Matx33d r;
  if (values.size() == 3) {
    cv::Rodrigues(cv::Vec3d(values.data()), r);
  } else {
    r = cv::Matx33d(values.data());
  }
  if (cv::norm(r * r.t() - cv::Matx33d::eye(), cv::NORM_INF) > kRotationTolerance || cv::determinant(r) < 0) {
    fail(file.name(), name + ": not a rotation matrix");
  }
  return r;
}

// For lenses of about 150 degrees and more, cv::fisheye::stereoRectify derives focal length and principal
// point from rays near or behind the image plane, and the rectified image shows nothing of the scene. The
// lenses' own mean focal length and the image's centre then stand in.
void repair_wide_fisheye(Calibration& c, const cv::Vec3d& translation) {
  const auto plausible = [&c](const cv::Matx34d& p) {
    return p(0, 0) > 0 && p(0, 2) >= 0 && p(0, 2) <= c.size.width && p(1, 2) >= 0 && p(1, 2) <= c.size.height;
  };
  if (plausible(c.P1) && plausible(c.P2)) {
    return;
  }
  const cv::Matx33d& left = c.left.camera;
  const cv::Matx33d& right = c.right.camera;
  const double focal = (left(0, 0) + left(1, 1) + right(0, 0) + right(1, 1)) / 4;
  const cv::Vec3d baseline = c.R2 * translation;
  c.P1 = {focal, 0, (c.size.width - 1) / 2.0, 0, 0, focal, (c.size.height - 1) / 2.0, 0, 0, 0, 1, 0};
  c.P2 = c.P1;
  c.P2(0, 3) = focal * baseline[0];
  c.Q = disparity_to_depth(c.P1, c.P2);
}

// R1, R2, P1, P2, Q from R and T.
void compute_rectification(const CalibrationFile& file, Calibration& c) {
  const cv::Matx33d r = rotation(file, "R");
  const cv::Vec3d t(file.numbers({"T"}, {{3, 1}, {1, 3}}).data());
  if (cv::norm(t) == 0) {
    fail(file.name(), "T: the baseline is zero");
  }
  const cv::Size size(c.size.width, c.size.height);
  cv::Mat r1;
  cv::Mat r2;
  cv::Mat p1;
  cv::Mat p2;
  cv::Mat q;
  try {
    if (c.model == LensModel::kFisheye) {
      cv::fisheye::stereoRectify(c.left.camera, c.left.distortion, c.right.camera, c.right.distortion, size,
                                 r, t, r1, r2, p1, p2, q, cv::fisheye::CALIB_ZERO_DISPARITY, size, 0.0, 1.0);
    } else {
      cv::stereoRectify(c.left.camera, c.left.distortion, c.right.camera, c.right.distortion, size, r, t, r1,
                        r2, p1, p2, q, cv::CALIB_ZERO_DISPARITY, 0.0, size);
    }
  } catch (const cv::Exception& error) {
    fail(file.name(), fmt::format("OpenCV cannot rectify this calibration: {}", error.err));
  }
  c.R1 = cv::Matx33d(r1.ptr<double>());
  c.R2 = cv::Matx33d(r2.ptr<double>());
  c.P1 = cv::Matx34d(p1.ptr<double>());
  c.P2 = cv::Matx34d(p2.ptr<double>());
  c.Q = cv::Matx44d(q.ptr<double>());
  if (c.model == LensModel::kFisheye) {
    repair_wide_fisheye(c, t);
  }
}

void check_projections(const std::string& name, const Calibration& c) {
  for (const cv::Matx34d* p : {&c.P1, &c.P2}) {
    for (const double value : p->val) {
      if (!std::isfinite(value)) {
        fail(name, "the rectification has no finite projection matrix: the calibration is implausible");
      }
    }
    if (!((*p)(0, 0) > 0) || !((*p)(1, 1) > 0)) {
      fail(name, fmt::format("P1, P2: focal lengths {} and {} px of a rectified image must be positive",
                             (*p)(0, 0), (*p)(1, 1)));
    }
  }
  if (c.P2(1, 3) != 0) {
    fail(name, "P2: the cameras are above each other; only side by side cameras are supported");
  }
  if (!(c.P2(0, 3) < 0)) {
    fail(name, "P2: the right camera is not to the right of the left one; are the images exchanged?");
  }
}

// A rectified pair may state its projections, or cameras and T, or nothing.
void read_rectified(const CalibrationFile& file, Calibration& c) {
  if (file.has({"P1"}) && file.has({"P2"})) {
    c.P1 = matrix<3, 4>(file, {"P1"});
    c.P2 = matrix<3, 4>(file, {"P2"});
  } else if (file.has({"K1"}) && file.has({"K2"}) && file.has({"T"})) {
    const cv::Matx33d k1 = matrix<3, 3>(file, {"K1"});
    const cv::Matx33d k2 = matrix<3, 3>(file, {"K2"});
    const std::vector<double> t = file.numbers({"T"}, {{3, 1}, {1, 3}});
    c.P1 = {k1(0, 0), 0, k1(0, 2), 0, 0, k1(1, 1), k1(1, 2), 0, 0, 0, 1, 0};
    c.P2 = {k2(0, 0), 0, k2(0, 2), k2(0, 0) * t[0], 0, k2(1, 1), k2(1, 2), 0, 0, 0, 1, 0};
  } else {
    return;
  }
  check_projections(file.name(), c);
  c.Q = file.has({"Q"}) ? matrix<4, 4>(file, {"Q"}) : disparity_to_depth(c.P1, c.P2);
}

void read_raw(const CalibrationFile& file, Calibration& c) {
  c.left = read_lens(file, c.model, "1");
  c.right = read_lens(file, c.model, "2");
  const Names entries = {"R1", "R2", "P1", "P2"};
  bool any = false;
  for (const std::string& entry : entries) {
    any |= file.has({entry});
  }
  if (any) {
    c.R1 = rotation(file, "R1");
    c.R2 = rotation(file, "R2");
    c.P1 = matrix<3, 4>(file, {"P1"});
    c.P2 = matrix<3, 4>(file, {"P2"});
    check_projections(file.name(), c);
    c.Q = file.has({"Q"}) ? matrix<4, 4>(file, {"Q"}) : disparity_to_depth(c.P1, c.P2);
  } else {
    compute_rectification(file, c);
    check_projections(file.name(), c);
  }
}

}  // namespace

cv::Matx44d disparity_to_depth(const cv::Matx34d& P1, const cv::Matx34d& P2) {
  const double tx = P2(0, 3) / P2(0, 0);
  return {1, 0, 0, -P1(0, 2), 0, 1, 0,       -P1(1, 2),
          0, 0, 0, P1(0, 0),  0, 0, -1 / tx, (P1(0, 2) - P2(0, 2)) / tx};
}

Calibration read_calibration(const std::vector<std::string>& paths, const ImageSize& size) {
  const CalibrationFile file(paths);
  Calibration calibration;
  calibration.source = file.name();
  calibration.model = model_of(file);
  calibration.size = size_of(file, size);
  calibration.unit = file.text({"T_unit"}, "");
  if (calibration.model == LensModel::kRectified) {
    read_rectified(file, calibration);
  } else {
    read_raw(file, calibration);
  }
  return calibration;
}

void check_size(const Calibration& calibration, const ImageSize& images) {
  if (calibration.size.width != images.width || calibration.size.height != images.height) {
    fail(calibration.source,
         fmt::format("the calibration is for images of {}x{}, these have {}x{}", calibration.size.width,
                     calibration.size.height, images.width, images.height));
  }
}

}  // namespace parallax
