// SPDX-License-Identifier: Apache-2.0
#include "platform/input/read_calibration.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "platform/input/euroc_calibration.hpp"
#include "platform/input/kalibr_calibration.hpp"
#include "platform/input/kitti_calibration.hpp"
#include "platform/input/kitti_raw_calibration.hpp"
#include "platform/input/middlebury_calibration.hpp"
#include "platform/input/opencv_calibration.hpp"
#include "platform/input/orb_slam_calibration.hpp"
#include "platform/input/ros_calibration.hpp"
#include "platform/input/text_file.hpp"
#include "platform/input/vins_calibration.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr std::size_t kLargestCalibration = std::size_t{1} << 24;

struct CalibrationFormat {
  const char* name;
  bool (*is)(const TopLevel& file);
  StatedCalibration (*read)(const CalibrationRequest& request);
  bool several_files;
  std::vector<const char*>
      numbered;  // beginnings of the names that end in a camera's number; none: two cameras
};

// The first that a file is of: OpenCV's head alone says little, as other YAML has it too.
const std::array kFormats{
    CalibrationFormat{
        "Middlebury calib.txt", is_middlebury_calibration, read_middlebury_calibration, false, {}},
    CalibrationFormat{"Kalibr camchain", is_kalibr_calibration, read_kalibr_calibration, false, {"cam"}},
    CalibrationFormat{"EuRoC sensor.yaml", is_euroc_calibration, read_euroc_calibration, true, {}},
    CalibrationFormat{"ROS camera_info", is_ros_calibration, read_ros_calibration, true, {}},
    CalibrationFormat{"KITTI calib_cam_to_cam.txt",
                      is_kitti_raw_calibration,
                      read_kitti_raw_calibration,
                      false,
                      {"P_rect_", "K_"}},
    CalibrationFormat{"KITTI calib.txt", is_kitti_calibration, read_kitti_calibration, false, {"P"}},
    CalibrationFormat{"VINS camera model", is_vins_calibration, read_vins_calibration, true, {}},
    CalibrationFormat{"ORB-SLAM3 settings", is_orb_slam_calibration, read_orb_slam_calibration, false, {}},
    CalibrationFormat{"OpenCV FileStorage", is_opencv_calibration, read_opencv_calibration, true, {}},
};

constexpr const char* kKnownFormats =
    "OpenCV FileStorage (YAML with the first line %YAML:1.0, XML or JSON), ROS camera_info or EuRoC "
    "sensor.yaml (two files), Kalibr camchain, KITTI calib.txt or calib_cam_to_cam.txt, Middlebury "
    "calib.txt, "
    "VINS-Fusion (its configuration, which names the files of both cameras), ORB-SLAM3";

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

// Of a file with several.
std::vector<int> cameras_in(const CalibrationFormat& format, const std::string& text) {
  const TopLevel top(text);
  std::vector<int> all;
  for (const char* beginning : format.numbered) {
    for (const int number : top.numbers(beginning)) all.push_back(number);
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::string listed(const std::vector<int>& numbers) {
  return fmt::format("{} and {}", fmt::join(numbers.begin(), numbers.end() - 1, ", "), numbers.back());
}

// The last two that are not those that are taken, which is a pair in all that is known.
std::string other_pair(const std::vector<int>& cameras) {
  return fmt::format("--cameras {},{}", cameras[cameras.size() - 2], cameras.back());
}

void check_cameras(const CalibrationRequest& request, const std::vector<int>& cameras, bool asked_for) {
  if (cameras.size() < 2) return;
  for (const int number : {request.cameras.left, request.cameras.right}) {
    if (std::find(cameras.begin(), cameras.end(), number) != cameras.end()) continue;
    if (asked_for) {
      throw UserError(
          fmt::format("{}: holds no camera {}, but {}", request.source(), number, listed(cameras)));
    }
    throw UserError(fmt::format("{}: holds the cameras {}, and 0 and 1 are taken if nothing is said: {}",
                                request.source(), listed(cameras), other_pair(cameras)));
  }
}

// What is wrong with a pair need not be wrong with another one.
Calibration completed(const StatedCalibration& stated, const std::string& choice) {
  try {
    return complete(stated);
  } catch (const UserError& error) {
    if (choice.empty() || stated.size.width == 0) throw;
    throw UserError(fmt::format("{}; {}", error.what(), choice));
  }
}

CalibrationRequest read_files(const std::vector<std::string>& paths) {
  CalibrationRequest request;
  const auto add = [&request](const std::string& path) {
    request.files.push_back({path, read_text_file(path, kLargestCalibration)});
  };
  for (const std::string& path : paths) add(path);
  if (paths.size() > 1) return request;
  for (const std::string& path : camera_files_of_estimator(request.files.front())) add(path);
  return request;
}

}  // namespace

Calibration read_calibration(const std::vector<std::string>& paths, const ImageSize& images,
                             const std::optional<CameraPair>& cameras) {
  CalibrationRequest request = read_files(paths);
  request.images = images;
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
    if (format.numbered.empty()) {
      throw UserError(fmt::format("{}: {} has no numbered cameras that --cameras could choose from",
                                  request.source(), format.name));
    }
    request.cameras = *cameras;
  }
  const std::vector<int> held = cameras_in(format, request.files.front().text);
  check_cameras(request, held, cameras.has_value());
  std::string choice;
  if (!cameras && held.size() > 2) {
    choice =
        fmt::format("of its cameras {}, 0 and 1 are taken; {} takes others", listed(held), other_pair(held));
  }
  Calibration calibration = completed(format.read(request), choice);
  calibration.choice = choice;
  return calibration;
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
