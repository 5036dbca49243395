// SPDX-License-Identifier: Apache-2.0
#include "platform/input/ros_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "platform/input/quoted_text.hpp"
#include "platform/input/yaml_entries.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr std::size_t kFisheyeCoefficients = 4;

// The entries of the file, under the names of either form.
struct CameraInfo {
  explicit CameraInfo(const CalibrationRequest::File& file)
      : entries(file),
        camera(entries.present({"camera_matrix", "K", "k"})),
        distortion(entries.present({"distortion_coefficients", "D", "d"})),
        rotation(entries.present({"rectification_matrix", "R", "r"})),
        projection(entries.present({"projection_matrix", "P", "p"})) {
    const std::string width = entries.present({"image_width", "width"});
    const std::string height = entries.present({"image_height", "height"});
    size = image_size(entries.number(width), entries.number(height), entries.where(width) + ", " + height);
  }

  YamlEntries entries;
  std::string camera;
  std::string distortion;
  std::string rotation;
  std::string projection;
  ImageSize size;
};

bool all_zero(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return value == 0; });
}

// Parts of a sensor and joined pixels: K and P are those of all of it, and the images are not.
void check_whole_sensor(const CameraInfo& info) {
  for (const char* binning : {"binning_x", "binning_y"}) {
    if (info.entries.has(binning) && info.entries.number(binning) > 1) {
      throw UserError(fmt::format("{}: {}: only images of all pixels are supported, 0 or 1",
                                  info.entries.where(binning), info.entries.number(binning)));
    }
  }
  if (!info.entries.has("roi")) return;
  const YamlEntries roi = info.entries.map("roi");
  for (const auto& [name, whole] : {std::pair{"x_offset", 0},
                                    {"y_offset", 0},
                                    {"width", info.size.width},
                                    {"height", info.size.height}}) {
    const double value = roi.has(name) ? roi.number(name) : 0;
    if (value != 0 && value != whole) {
      throw UserError(fmt::format("{}: {}: only images of the whole sensor are supported, 0 or {}",
                                  roi.where(name), value, whole));
    }
  }
}

LensModel model_of(const CameraInfo& info, const std::vector<double>& coefficients) {
  const std::string name = info.entries.has("distortion_model") ? info.entries.text("distortion_model") : "";
  if (const std::optional<LensModel> model = distortion_model(name)) return *model;
  if ((name.empty() || name == "none" || name == "None") && all_zero(coefficients))
    return LensModel::kPinhole;
  throw UserError(fmt::format("{}: {} is not plumb_bob, rational_polynomial or equidistant",
                              info.entries.where("distortion_model"), in_quotes(name)));
}

// Some drivers write as many coefficients of a fisheye lens as of another one.
void trim(std::vector<double>& coefficients, LensModel model) {
  if (model == LensModel::kPinhole && coefficients.empty()) coefficients.assign(5, 0);
  if (model != LensModel::kFisheye || coefficients.size() <= kFisheyeCoefficients) return;
  if (all_zero({coefficients.begin() + kFisheyeCoefficients, coefficients.end()})) {
    coefficients.resize(kFisheyeCoefficients);
  }
}

StatedCalibration::StatedLens lens_of(const CameraInfo& info, LensModel& model) {
  const YamlEntries& entries = info.entries;
  StatedCalibration::StatedLens lens;
  lens.camera_name = entries.where(info.camera);
  lens.distortion_name = entries.where(info.distortion);
  const std::vector<double> camera = entries.matrix(info.camera, 3, 3);
  if (all_zero(camera)) {
    throw UserError(lens.camera_name + " is zero: ROS writes that of a camera that is not calibrated");
  }
  lens.lens.camera = cv::Matx33d(camera.data());
  lens.lens.distortion = entries.numbers(info.distortion);
  model = model_of(info, lens.lens.distortion);
  trim(lens.lens.distortion, model);
  return lens;
}

void check_alike(const CameraInfo& left, const CameraInfo& right, const StatedCalibration& stated,
                 LensModel right_model) {
  if (left.size.width != right.size.width || left.size.height != right.size.height) {
    throw UserError(fmt::format("{}: images of {}x{} left and {}x{} right; those of a pair have one size",
                                stated.source, left.size.width, left.size.height, right.size.width,
                                right.size.height));
  }
  if (stated.model != right_model) {
    throw UserError(
        fmt::format("{}: one lens is radial-tangential, the other equidistant; both lenses of a pair are of "
                    "one model",
                    stated.source));
  }
}

// As the calibration of one camera leaves it.
void check_pair_is_stated(const CameraInfo& info) {
  if (info.entries.has(info.rotation) || info.entries.has(info.projection)) return;
  throw UserError(
      fmt::format("{} and {} are missing: they say how the cameras of a pair lie, which the calibration of "
                  "one camera does "
                  "not",
                  info.entries.where(info.rotation), info.projection));
}

}  // namespace

bool is_ros_calibration(const TopLevel& file) {
  const bool calibration = file.has("projection_matrix") || file.has("rectification_matrix") ||
                           (file.has("camera_matrix") && file.has("image_width"));
  const bool message = (file.has("K") && file.has("P")) || (file.has("k") && file.has("p"));
  return calibration || (message && file.has("width"));
}

StatedCalibration read_ros_calibration(const CalibrationRequest& request) {
  if (request.files.size() != 2) {
    throw UserError(fmt::format(
        "{}: ROS camera_info is of one camera each: a pair is two files, left and right", request.source()));
  }
  const CameraInfo left(request.files[0]);
  const CameraInfo right(request.files[1]);
  check_pair_is_stated(left);
  check_pair_is_stated(right);
  StatedCalibration stated;
  stated.source = request.source();
  stated.size = left.size;
  stated.unit = "m";
  LensModel right_model{};
  stated.left = lens_of(left, stated.model);
  stated.right = lens_of(right, right_model);
  check_alike(left, right, stated, right_model);
  check_whole_sensor(left);
  check_whole_sensor(right);
  stated.rotations = {left.entries.where(left.rotation), right.entries.where(right.rotation),
                      cv::Matx33d(left.entries.matrix(left.rotation, 3, 3).data()),
                      cv::Matx33d(right.entries.matrix(right.rotation, 3, 3).data())};
  stated.projections = {fmt::format("{}: {}", stated.source, left.projection),
                        cv::Matx34d(left.entries.matrix(left.projection, 3, 4).data()),
                        cv::Matx34d(right.entries.matrix(right.projection, 3, 4).data())};
  return stated;
}

}  // namespace parallax
