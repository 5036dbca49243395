// SPDX-License-Identifier: Apache-2.0
#include "platform/input/opencv_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <optional>

#include "platform/input/file_storage_entries.hpp"
#include "platform/input/quoted_text.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

using EntryNames = std::vector<std::string>;

const EntryNames kModelName{"camera_model"};
const EntryNames kDistortionModelName{"distortion_model"};

// The last ones are of ORB-SLAM2, whose R and P of each camera are rotation and projection of the rectified
// pair.
const EntryNames kR1{"R1", "LEFT.R"};
const EntryNames kR2{"R2", "RIGHT.R"};
const EntryNames kP1{"P1", "LEFT.P"};
const EntryNames kP2{"P2", "RIGHT.P"};

std::string side_name(const std::string& side) { return side == "1" ? "LEFT" : "RIGHT"; }

EntryNames camera_names(const std::string& side) {
  return {"K" + side, "M" + side, "cameraMatrix" + side, side_name(side) + ".K"};
}

template <int R, int C>
cv::Matx<double, R, C> entry(const FileStorageEntries& file, const EntryNames& names) {
  const std::vector<double> values = file.numbers(names, {{R, C}});
  return cv::Matx<double, R, C>(values.data());
}

bool any_of(const FileStorageEntries& file, const std::vector<EntryNames>& entries) {
  return std::any_of(entries.begin(), entries.end(),
                     [&file](const EntryNames& names) { return file.has(names); });
}

// Projections or Q, and nothing that would turn or straighten an image.
bool states_no_lens(const FileStorageEntries& file) {
  const bool lens = file.has(camera_names("1")) || file.has(camera_names("2"));
  return !lens && !any_of(file, {{"R"}, {"T"}, kR1, kR2}) && any_of(file, {kP1, kP2, {"Q"}});
}

LensModel named_model(const FileStorageEntries& file, const EntryNames& entry_name, const std::string& name,
                      const char* known) {
  if (name == "pinhole_radtan" || name == "pinhole") return LensModel::kPinhole;
  if (name == "fisheye_equidistant") return LensModel::kFisheye;
  if (const std::optional<LensModel> found = distortion_model(name)) return *found;
  throw UserError(fmt::format("{}: {} is not {}", file.where(entry_name), in_quotes(name), known));
}

LensModel model_of(const FileStorageEntries& file) {
  const std::string camera = file.text(kModelName, "");
  const std::string distortion = file.text(kDistortionModelName, "");
  const bool undistorted = distortion.empty() || distortion == "none";
  if (camera.empty() && undistorted) {
    return states_no_lens(file) ? LensModel::kRectified : LensModel::kPinhole;
  }
  std::optional<LensModel> model;
  if (camera == "rectified") {
    if (undistorted) return LensModel::kRectified;
  } else if (!camera.empty()) {
    model = named_model(file, kModelName, camera, "pinhole_radtan, fisheye_equidistant or rectified");
    if (undistorted) return *model;
  }
  const LensModel distorted =
      named_model(file, kDistortionModelName, distortion, "plumb_bob, rational_polynomial or equidistant");
  if (!camera.empty() && model != distorted) {
    throw UserError(
        fmt::format("{}: {} contradicts distortion_model: {}; a lens with equidistant distortion is "
                    "fisheye_equidistant, one "
                    "with radial-tangential distortion pinhole_radtan, and rectified images have none",
                    file.where(kModelName), excerpt(camera), excerpt(distortion)));
  }
  return distorted;
}

ImageSize stated_size(const FileStorageEntries& file, const ImageSize& otherwise) {
  const EntryNames both{"image_size", "imageSize"};
  std::optional<ImageSize> size;
  if (file.has(both)) {
    const std::vector<double> values = file.numbers(both, {{2, 1}, {1, 2}});
    size = image_size(values[0], values[1], file.where(both));
  }
  const EntryNames width{"image_width", "LEFT.width", "RIGHT.width"};
  const EntryNames height{"image_height", "LEFT.height", "RIGHT.height"};
  if (!file.has(width) && !file.has(height)) return size.value_or(otherwise);
  const ImageSize sides = image_size(file.numbers(width, {{1, 1}})[0], file.numbers(height, {{1, 1}})[0],
                                     file.where(width) + ", image_height");
  if (size && (size->width != sides.width || size->height != sides.height)) {
    throw UserError(fmt::format("{}: {}x{} contradicts image_width, image_height: {}x{}", file.where(both),
                                size->width, size->height, sides.width, sides.height));
  }
  return sides;
}

StatedCalibration::StatedLens stated_camera(const FileStorageEntries& file, const std::string& side) {
  StatedCalibration::StatedLens lens;
  lens.camera_name = file.where(camera_names(side));
  lens.lens.camera = entry<3, 3>(file, camera_names(side));
  return lens;
}

StatedCalibration::StatedLens stated_lens(const FileStorageEntries& file, const std::string& side) {
  StatedCalibration::StatedLens lens = stated_camera(file, side);
  const EntryNames names{"D" + side, "distCoeffs" + side, "distortion" + side, side_name(side) + ".D"};
  lens.distortion_name = file.where(names);
  lens.lens.distortion = file.numbers(names, {});
  return lens;
}

cv::Matx33d stated_rotation(const FileStorageEntries& file, const EntryNames& names) {
  const std::vector<double> values = file.numbers(names, {{3, 3}, {3, 1}, {1, 3}});
  if (values.size() != 3) return cv::Matx33d(values.data());
  cv::Matx33d r;
  cv::Rodrigues(cv::Vec3d(values.data()), r);
  return r;
}

StatedCalibration::Rotations stated_rotations(const FileStorageEntries& file) {
  return {file.where(kR1), file.where(kR2), stated_rotation(file, kR1), stated_rotation(file, kR2)};
}

StatedCalibration::Pose stated_pose(const FileStorageEntries& file, const cv::Matx33d& rotation) {
  return {file.where({"R"}), file.where({"T"}), rotation,
          cv::Vec3d(file.numbers({"T"}, {{3, 1}, {1, 3}}).data())};
}

StatedCalibration::Projections stated_projections(const FileStorageEntries& file) {
  return {file.where(kP1) + ", P2", entry<3, 4>(file, kP1), entry<3, 4>(file, kP2)};
}

void read_rectified_pair(const FileStorageEntries& file, StatedCalibration& stated) {
  if (any_of(file, {kP1, kP2})) stated.projections = stated_projections(file);
  if (file.has(camera_names("1")) && file.has(camera_names("2"))) {
    stated.left = stated_camera(file, "1");
    stated.right = stated_camera(file, "2");
  }
  if (file.has({"T"})) {
    stated.pose = stated_pose(file, file.has({"R"}) ? stated_rotation(file, {"R"}) : cv::Matx33d::eye());
  }
  if (file.has(kR1) && file.has(kR2)) {
    stated.rotations = stated_rotations(file);
  }
}

void read_raw_pair(const FileStorageEntries& file, StatedCalibration& stated) {
  stated.left = stated_lens(file, "1");
  stated.right = stated_lens(file, "2");
  const bool rectification = any_of(file, {kR1, kR2, kP1, kP2});
  if (rectification) {
    stated.rotations = stated_rotations(file);
    stated.projections = stated_projections(file);
  }
  if (!rectification || (file.has({"R"}) && file.has({"T"}))) {
    stated.pose = stated_pose(file, stated_rotation(file, {"R"}));
  }
}

}  // namespace

bool is_opencv_calibration(const TopLevel& file) { return file.begins_as_file_storage(); }

StatedCalibration read_opencv_calibration(const CalibrationRequest& request) {
  const FileStorageEntries file(request.files);
  StatedCalibration stated;
  stated.source = request.source();
  stated.model = model_of(file);
  stated.size = stated_size(file, request.images);
  stated.unit = file.text({"T_unit"}, "");
  if (stated.model == LensModel::kRectified) {
    read_rectified_pair(file, stated);
  } else {
    read_raw_pair(file, stated);
  }
  if (file.has({"Q"})) stated.reprojection = {file.where({"Q"}), entry<4, 4>(file, {"Q"})};
  return stated;
}

}  // namespace parallax
