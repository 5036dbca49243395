// SPDX-License-Identifier: Apache-2.0
#include "platform/input/read_calibration.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdio>

#include "platform/input/euroc_calibration.hpp"
#include "platform/input/kalibr_calibration.hpp"
#include "platform/input/kitti_calibration.hpp"
#include "platform/input/kitti_raw_calibration.hpp"
#include "platform/input/middlebury_calibration.hpp"
#include "platform/input/opencv_calibration.hpp"
#include "platform/input/ros_calibration.hpp"
#include "platform/input/text_file.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr std::size_t kLargestCalibration = std::size_t{1} << 24;

struct CalibrationFormat {
  const char* name;
  bool (*is)(const TopLevel& file);
  StatedCalibration (*read)(const CalibrationRequest& request);
  bool several_files;
  bool several_cameras;
};

// The first that a file is of: OpenCV's head alone says little, as other YAML has it too.
const std::array kFormats{
    CalibrationFormat{"Middlebury calib.txt", is_middlebury_calibration, read_middlebury_calibration, false,
                      false},
    CalibrationFormat{"Kalibr camchain", is_kalibr_calibration, read_kalibr_calibration, false, true},
    CalibrationFormat{"EuRoC sensor.yaml", is_euroc_calibration, read_euroc_calibration, true, false},
    CalibrationFormat{"ROS camera_info", is_ros_calibration, read_ros_calibration, true, false},
    CalibrationFormat{"KITTI calib_cam_to_cam.txt", is_kitti_raw_calibration, read_kitti_raw_calibration,
                      false, true},
    CalibrationFormat{"KITTI calib.txt", is_kitti_calibration, read_kitti_calibration, false, true},
    CalibrationFormat{"OpenCV FileStorage", is_opencv_calibration, read_opencv_calibration, true, false},
};

constexpr const char* kKnownFormats =
    "OpenCV FileStorage (YAML with the first line %YAML:1.0, XML or JSON), ROS camera_info or EuRoC "
    "sensor.yaml "
    "(two files), Kalibr camchain, KITTI calib.txt or calib_cam_to_cam.txt, Middlebury calib.txt";

// YAML with OpenCV's entries, but without its first line.
bool lacks_head(const TopLevel& file, const std::string& text) {
  if (text.find("!!opencv-matrix") != std::string::npos) return true;
  for (const char* name : {"K1", "M1", "cameraMatrix1", "R1", "P1", "Q", "T_unit"}) {
    if (file.has(name)) return true;
  }
  return false;
}

const CalibrationFormat& format_of(const CalibrationRequest::File& file) {
  const TopLevel top(file.text);
  for (const CalibrationFormat& format : kFormats) {
    if (format.is(top)) return format;
  }
  if (lacks_head(top, file.text)) {
    throw UserError(
        fmt::format("{}: looks like OpenCV's YAML, but its first line is not %YAML:1.0, without which OpenCV "
                    "does not read it",
                    file.path));
  }
  throw UserError(fmt::format("{}: not a calibration of a known format: {}", file.path, kKnownFormats));
}

}  // namespace

Calibration read_calibration(const std::vector<std::string>& paths, const ImageSize& images,
                             const std::optional<CameraPair>& cameras) {
  CalibrationRequest request;
  request.images = images;
  for (const std::string& path : paths)
    request.files.push_back({path, read_text_file(path, kLargestCalibration)});
  const CalibrationFormat& format = format_of(request.files.front());
  for (const CalibrationRequest::File& file : request.files) {
    const CalibrationFormat& other = format_of(file);
    if (&other != &format) {
      throw UserError(fmt::format("{}: {}, but {} is {}: one calibration is of one format", file.path,
                                  other.name, paths.front(), format.name));
    }
  }
  if (paths.size() > 1 && !format.several_files) {
    throw UserError(fmt::format("{}: {} is one file for both cameras, not {}", request.source(), format.name,
                                paths.size()));
  }
  if (cameras) {
    if (!format.several_cameras) {
      throw UserError(fmt::format("{}: {} has no numbered cameras that --cameras could choose from",
                                  request.source(), format.name));
    }
    request.cameras = *cameras;
  }
  return complete(format.read(request));
}

std::optional<CameraPair> camera_pair(const std::string& option, const std::string& text) {
  if (text.empty()) return std::nullopt;
  CameraPair pair;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%3d,%3d%c", &pair.left, &pair.right, &rest) != 2 || pair.left < 0 ||
      pair.right < 0 || pair.left == pair.right) {
    throw UserError(
        fmt::format("{}: \"{}\" is not a left and a right camera such as 2,3", option, excerpt(text)));
  }
  return pair;
}

}  // namespace parallax
