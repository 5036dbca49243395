// SPDX-License-Identifier: Apache-2.0
// Synthetic calibrations, and tests with a folder to put files in.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "platform/input/read_calibration.hpp"
#include "tests/platform/temporary_folder.hpp"
#include "tlm/error.hpp"

namespace parallax::test {

/// The line of the UserError that `run` throws; empty if it throws none.
inline std::string message(const std::function<void()>& run) {
  try {
    run();
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

class FolderTest : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_ / name; }
  std::string write(const std::string& name, const std::string& text) const {
    return folder_.write(name, text);
  }

  const TemporaryFolder folder_;
};

/// A stereo pair of two similar lenses, the right one 0.1 to the right and turned a little.
struct SyntheticPair {
  std::string model = "pinhole_radtan";
  int width = 640;
  int height = 480;
  double focal = 500;
  std::vector<double> distortion = {-0.2, 0.05, 0.0005, -0.0003};

  cv::Mat camera(int side) const {
    const cv::Matx33d k(focal + side, 0, width / 2.0 - 3 * side, 0, focal - side, height / 2.0 + 2 * side, 0,
                        0, 1);
    return cv::Mat(k, true);
  }
  cv::Mat coefficients() const { return cv::Mat(distortion, true).reshape(1, 1).clone(); }
  static cv::Mat rotation() {
    // About 0.3 degrees around each axis.
    const double a = 0.005;
    const double c = std::cos(a);
    const double s = std::sin(a);
    const cv::Matx33d x(1, 0, 0, 0, c, -s, 0, s, c);
    const cv::Matx33d y(c, 0, s, 0, 1, 0, -s, 0, c);
    const cv::Matx33d z(c, -s, 0, s, c, 0, 0, 0, 1);
    return cv::Mat(x * y * z, true);
  }
  static cv::Mat translation() { return cv::Mat(cv::Vec3d(-0.1, 0.001, -0.0005), true); }

  /// FileStorage YAML with everything but the rectification.
  std::string text() const {
    cv::FileStorage file(".yml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
    file << "camera_model" << model << "image_width" << width << "image_height" << height;
    file << "K1" << camera(0) << "D1" << coefficients() << "K2" << camera(1) << "D2" << coefficients();
    file << "R" << rotation() << "T" << translation() << "T_unit"
         << "m";
    return file.releaseAndGetString();
  }
};

/// An equidistant lens of about 90 degrees across the diagonal.
inline SyntheticPair fisheye_pair() {
  SyntheticPair pair;
  pair.model = "fisheye_equidistant";
  pair.focal = 400;
  pair.distortion = {-0.01, 0.02, -0.01, 0.002};
  return pair;
}

/// `text` with the entry `name` (up to the next entry) replaced by `line`; an empty line removes it.
inline std::string with_entry(std::string text, const std::string& name, const std::string& line) {
  const std::size_t begin = text.find("\n" + name + ":") + 1;
  std::size_t end = text.find('\n', begin) + 1;
  while (end < text.size() && (text[end] == ' ' || text[end] == '\t')) {
    end = text.find('\n', end) + 1;
  }
  return text.replace(begin, end - begin, line.empty() ? "" : line + "\n");
}

/// Calibrations of which one entry is another.
class ChangedCalibrationTest : public FolderTest {
 protected:
  /// The line for a calibration in which one entry has been replaced, without the file name.
  std::string changed(const std::string& name, const std::string& line,
                      const SyntheticPair& pair = {}) const {
    const std::string file = write("c.yml", with_entry(pair.text(), name, line));
    const std::string text = message([&] { read_calibration({file}); });
    const std::string prefix = file + ": ";
    if (text.empty()) return text;
    EXPECT_EQ(text.substr(0, prefix.size()), prefix);
    EXPECT_EQ(text.find('\n'), std::string::npos);
    return text.size() > prefix.size() ? text.substr(prefix.size()) : text;
  }
};

}  // namespace parallax::test
