// SPDX-License-Identifier: Apache-2.0
#include "platform/input/vins_calibration.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "platform/input/quoted_text.hpp"
#include "platform/input/rigid_transform.hpp"
#include "platform/input/yaml_entries.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr const char* kModel = "model_type";
constexpr const char* kLeftPose = "body_T_cam0";
constexpr const char* kRightPose = "body_T_cam1";
constexpr const char* kDistortion = "distortion_parameters";
constexpr const char* kProjection = "projection_parameters";

struct CameraModel {
  const char* name;
  LensModel model;
  const char* lens;                       // the entry with the coefficients
  std::vector<const char*> coefficients;  // in OpenCV's order
  std::vector<const char*> camera;        // fx, fy, cx, cy
};

const CameraModel& model_of(const YamlEntries& file) {
  static const std::vector<CameraModel> models{
      {"PINHOLE", LensModel::kPinhole, kDistortion, {"k1", "k2", "p1", "p2"}, {"fx", "fy", "cx", "cy"}},
      {"PINHOLE_FULL",
       LensModel::kPinhole,
       kDistortion,
       {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"},
       {"fx", "fy", "cx", "cy"}},
      {"KANNALA_BRANDT",
       LensModel::kFisheye,
       kProjection,
       {"k2", "k3", "k4", "k5"},
       {"mu", "mv", "u0", "v0"}}};
  const std::string name = file.text(kModel);
  for (const CameraModel& model : models) {
    if (name == model.name) return model;
  }
  throw UserError(fmt::format("{}: {} is not supported, only PINHOLE, PINHOLE_FULL and KANNALA_BRANDT",
                              file.where(kModel), in_quotes(name)));
}

ImageSize size_of(const YamlEntries& file) {
  return image_size(file.number("image_width"), file.number("image_height"),
                    file.where("image_width") + ", image_height");
}

StatedCalibration::StatedLens lens_of(const YamlEntries& file, const CameraModel& model) {
  const YamlEntries camera = file.map(kProjection);
  const YamlEntries distortion = file.map(model.lens);
  std::vector<double> f;
  for (const char* name : model.camera) f.push_back(camera.number(name));
  StatedCalibration::StatedLens lens;
  lens.camera_name = file.where(kProjection);
  lens.distortion_name = file.where(model.lens);
  lens.lens.camera = {f[0], 0, f[2], 0, f[1], f[3], 0, 0, 1};
  for (const char* name : model.coefficients) lens.lens.distortion.push_back(distortion.number(name));
  return lens;
}

void check_alike(const YamlEntries& left, const YamlEntries& right) {
  const ImageSize a = size_of(left), b = size_of(right);
  if (a.width != b.width || a.height != b.height) {
    throw UserError(
        fmt::format("{}, image_height: {}x{}, but the left camera has {}x{}; those of a pair have "
                    "one size",
                    right.where("image_width"), b.width, b.height, a.width, a.height));
  }
  if (model_of(left).model != model_of(right).model) {
    throw UserError(fmt::format("{}: {}, but the left camera has {}; both lenses of a pair are of one model",
                                right.where(kModel), model_of(right).name, model_of(left).name));
  }
}

}  // namespace

bool is_vins_calibration(const TopLevel& file) {
  return file.has(kModel) || file.has(kLeftPose) || file.has(kRightPose);
}

StatedCalibration read_vins_calibration(const CalibrationRequest& request) {
  std::vector<YamlEntries> cameras, estimators;
  for (const CalibrationRequest::File& file : request.files) {
    const YamlEntries entries(file);
    (entries.has(kModel) ? cameras : estimators).push_back(entries);
  }
  if (estimators.size() != 1 || cameras.size() != 2) {
    throw UserError(fmt::format(
        "{}: {} with {} and {} with {}; a pair is two files of cameras, left and right, and the estimator's, "
        "which says where they are",
        request.source(), cameras.size(), kModel, estimators.size(), kLeftPose));
  }
  check_alike(cameras[0], cameras[1]);
  StatedCalibration stated;
  stated.source = request.source();
  stated.unit = "m";
  stated.model = model_of(cameras[0]).model;
  stated.size = size_of(cameras[0]);
  stated.left = lens_of(cameras[0], model_of(cameras[0]));
  stated.right = lens_of(cameras[1], model_of(cameras[1]));
  const YamlEntries& rig = estimators[0];
  stated.pose = pose_of(rigid_inverse(rigid_transform(rig, kRightPose)) * rigid_transform(rig, kLeftPose),
                        rig.where(kRightPose));
  return stated;
}

std::vector<std::string> camera_files_of_estimator(const CalibrationRequest::File& file) {
  const TopLevel top(file.text);
  if (top.has(kModel) || !is_vins_calibration(top)) return {};
  const YamlEntries entries(file);
  const std::filesystem::path folder = std::filesystem::path(file.path).parent_path();
  return {(folder / entries.text("cam0_calib")).string(), (folder / entries.text("cam1_calib")).string()};
}

}  // namespace parallax
