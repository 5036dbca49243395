// SPDX-License-Identifier: Apache-2.0
// The program's rectified image against OpenCV's, from the same calibration file and the same picture.
#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "platform/images/image_codecs.hpp"
#include "platform/results/output_file.hpp"
#include "tests/fidelity/program.hpp"
#include "tests/paths.hpp"
#include "tests/platform/test_calibrations.hpp"

namespace parallax::test {
namespace program_rectification_test {

/// The left image as cv::remap makes it, and where it does not look outside of its source.
struct Reference {
  cv::Mat image;
  cv::Mat inside;
};

Reference reference(const cv::Mat& source, const std::string& calibration) {
  const cv::FileStorage file(calibration, cv::FileStorage::READ);
  cv::Mat k, d, r, p, x, y;
  file["K1"] >> k;
  file["D1"] >> d;
  file["R1"] >> r;
  file["P1"] >> p;
  const cv::Mat camera = p.colRange(0, 3);
  if (static_cast<std::string>(file["camera_model"]) == "fisheye_equidistant") {
    cv::fisheye::initUndistortRectifyMap(k, d, r, camera, source.size(), CV_32FC1, x, y);
  } else {
    cv::initUndistortRectifyMap(k, d, r, camera, source.size(), CV_32FC1, x, y);
  }
  Reference result;
  cv::remap(source, result.image, x, y, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  result.inside = (x >= 1) & (y >= 1) & (x <= source.cols - 2) & (y <= source.rows - 2);
  return result;
}

void expect_rectified(const std::string& left, const std::string& right, const std::string& calibration,
                      const std::string& options) {
  const ProgramRun run("--left " + left + " --right " + right + " --calibration " + calibration + " " +
                       options);
  EXPECT_LE(run.map_bytes_per_pixel_and_image(), 1.0);
  const Reference expected = reference(read_image(left, cv::IMREAD_GRAYSCALE), calibration);
  cv::Mat difference;
  cv::absdiff(run.image("left_rectified.png"), expected.image, difference);
  difference.setTo(0, ~expected.inside);
  EXPECT_LE(cv::norm(difference, cv::NORM_INF), 1);
  EXPECT_GT(cv::countNonZero(expected.inside), expected.inside.total() / 2);
}

/// One pixel of this pair's right map lies just beyond the device's window of 79.
TEST(ProgramRectification, ChessboardPair) {
  const std::string folder = shared_data("opencv_chessboard01/");
  if (!std::filesystem::exists(folder + "calib.yml")) GTEST_SKIP() << "no stereo data here";
  expect_rectified(folder + "left.png", folder + "right.png", folder + "calib.yml",
                   "--set rectification.window=81");
}

/// OpenCV's default rectification of this pair reaches further than 39 rows: here with a larger window.
TEST(ProgramRectification, FlyingCamera) {
  const std::string folder = shared_data("euroc_v101/");
  if (!std::filesystem::exists(folder + "calib.yml")) GTEST_SKIP() << "no stereo data here";
  const std::string left = folder + "left_00.png";
  const std::string right = folder + "right_00.png";
  EXPECT_THROW(ProgramRun("--left " + left + " --right " + right + " --calibration " + folder + "calib.yml"),
               std::runtime_error);
  expect_rectified(left, right, folder + "calib.yml", "--set rectification.window=155");
  const ProgramRun fitted("--left " + left + " --right " + right + " --fit --calibration " + folder +
                          "calib.yml");
  EXPECT_LE(fitted.map_bytes_per_pixel_and_image(), 1.0);
  EXPECT_GT(fitted.quality("valid_share"), 40);
}

TEST(ProgramRectification, Fisheye) {
  const SyntheticPair pair = fisheye_pair();
  const cv::Size size(pair.width, pair.height);
  cv::Mat r1, r2, p1, p2, q;
  cv::fisheye::stereoRectify(pair.camera(0), pair.coefficients(), pair.camera(1), pair.coefficients(), size,
                             SyntheticPair::rotation(), SyntheticPair::translation(), r1, r2, p1, p2, q,
                             cv::fisheye::CALIB_ZERO_DISPARITY, size);
  cv::FileStorage rectification(".yml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  rectification << "R1" << r1 << "R2" << r2 << "P1" << p1 << "P2" << p2 << "Q" << q;
  const std::string entries = rectification.releaseAndGetString();
  const parallax::TemporaryFolder folder;
  const std::string calibration = folder.write("calib.yml", pair.text() + entries.substr(entries.find("R1")));
  cv::Mat picture(size, CV_8UC1);
  cv::RNG random(1);
  random.fill(picture, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(picture, picture, {}, 1.5);
  cv::normalize(picture, picture, 0, 255, cv::NORM_MINMAX);
  write_file(folder / "picture.png", encode_image(".png", picture));
  expect_rectified(folder / "picture.png", folder / "picture.png", calibration,
                   "--set rectification.window=255");
}

}  // namespace program_rectification_test
}  // namespace parallax::test
