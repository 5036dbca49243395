// SPDX-License-Identifier: Apache-2.0
#include "platform/input/orb_slam_calibration.hpp"

#include <fmt/format.h>

#include "platform/input/quoted_text.hpp"
#include "platform/input/rigid_transform.hpp"
#include "platform/input/yaml_entries.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr const char* kCameraType = "Camera.type";
constexpr const char* kRigTransform = "Stereo.T_c1_c2";
constexpr const char* kRigBaseline = "Stereo.b";

LensModel slam_model(const YamlEntries& file) {
  const std::string name = file.text(kCameraType);
  if (name == "PinHole") return LensModel::kPinhole;
  if (name == "KannalaBrandt8") return LensModel::kFisheye;
  if (name == "Rectified") return LensModel::kRectified;
  throw UserError(fmt::format("{}: {} is not PinHole, KannalaBrandt8 or Rectified", file.where(kCameraType),
                              in_quotes(name)));
}

StatedCalibration::StatedLens slam_camera(const YamlEntries& file, const std::string& name) {
  const auto number = [&](const char* entry) { return file.number(name + "." + entry); };
  StatedCalibration::StatedLens lens;
  lens.camera_name = file.where(name + ".fx");
  lens.distortion_name = file.where(name + ".k1");
  lens.lens.camera = {number("fx"), 0, number("cx"), 0, number("fy"), number("cy"), 0, 0, 1};
  return lens;
}

StatedCalibration::StatedLens slam_lens(const YamlEntries& file, const std::string& name, LensModel model) {
  StatedCalibration::StatedLens lens = slam_camera(file, name);
  std::vector<const char*> entries{"k1", "k2", "p1", "p2"};
  if (model == LensModel::kFisheye) entries = {"k1", "k2", "k3", "k4"};
  if (model == LensModel::kPinhole && file.has(name + ".k3")) entries.push_back("k3");
  for (const char* entry : entries) lens.lens.distortion.push_back(file.number(name + "." + entry));
  return lens;
}

}  // namespace

bool is_orb_slam_calibration(const TopLevel& file) { return file.has(kCameraType) && file.has("Camera1.fx"); }

StatedCalibration read_orb_slam_calibration(const CalibrationRequest& request) {
  const YamlEntries file(request.files.front());
  StatedCalibration stated;
  stated.source = request.source();
  stated.unit = "m";
  stated.model = slam_model(file);
  stated.size = image_size(file.number("Camera.width"), file.number("Camera.height"),
                           file.where("Camera.width") + ", Camera.height");
  if (stated.model == LensModel::kRectified) {
    stated.left = stated.right = slam_camera(file, "Camera1");
    const double baseline = file.number(kRigBaseline);
    stated.pose = {file.where(kRigBaseline), file.where(kRigBaseline), cv::Matx33d::eye(),
                   cv::Vec3d(-baseline, 0, 0)};
    return stated;
  }
  stated.left = slam_lens(file, "Camera1", stated.model);
  stated.right = slam_lens(file, "Camera2", stated.model);
  stated.pose = pose_of(rigid_inverse(rigid_transform(file, kRigTransform)), file.where(kRigTransform));
  return stated;
}

}  // namespace parallax
