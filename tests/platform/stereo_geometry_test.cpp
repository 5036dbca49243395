// SPDX-License-Identifier: Apache-2.0
#include "platform/input/stereo_geometry.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "platform/results/point_cloud.hpp"
#include "tests/platform/test_calibrations.hpp"

namespace parallax {
namespace stereo_geometry_test {

using test::message;

struct Projections {
  cv::Matx34d left{500, 0, 320, 0, 0, 500, 240, 0, 0, 0, 1, 0};
  cv::Matx34d right{500, 0, 320, -50, 0, 500, 240, 0, 0, 0, 1, 0};  // 50 / 500 = 0.1 to the right

  std::string line() const {
    return message([&] { check_projections(left, right, "c: P1, P2"); });
  }
};

struct Vertex {
  float x, y, z;
};

// The points of a row of pixels, each with this disparity in 1/16 px.
std::vector<Vertex> points(const StereoGeometry& geometry, const std::vector<int>& sixteenths, int rows = 1) {
  const int columns = static_cast<int>(sixteenths.size()) / rows;
  std::vector<Disparity> map;
  for (const int value : sixteenths) map.push_back({static_cast<std::uint16_t>(value), Cause::kMatched});
  const std::vector<unsigned char> ply = encode_point_cloud_ply(
      {map, columns, rows}, cv::Mat(rows, columns, CV_8UC1, cv::Scalar(0)), disparity_to_depth(geometry));
  const std::string text(ply.begin(), ply.end());
  std::vector<Vertex> vertices;
  for (std::size_t at = text.find("end_header\n") + 11; at < text.size(); at += 15) {
    Vertex vertex{};
    std::memcpy(&vertex, &text[at], sizeof vertex);
    vertices.push_back(vertex);
  }
  return vertices;
}

TEST(StereoGeometry, TheBaselineIsBetweenTheTwoCameras) {
  // Cameras 2 and 3 of KITTI, both relative to camera 0: (45.75831 + 334.1081) / 707.0493 = 0.5372559 m; at
  // 20 px 379.86641 / 20 = 18.99332 m. The right one's column alone would give 334.1081 / 20 = 16.7054 m.
  const cv::Matx34d left(707.0493, 0, 604.0814, 45.75831, 0, 707.0493, 180.5066, -0.3454157, 0, 0, 1,
                         0.004981016);
  const cv::Matx34d right(707.0493, 0, 604.0814, -334.1081, 0, 707.0493, 180.5066, 2.33066, 0, 0, 1,
                          0.003201153);
  check_projections(left, right, "kitti");
  const StereoGeometry geometry = geometry_of(left, right);
  EXPECT_NEAR(geometry.baseline, 0.5372559, 1e-7);
  const std::vector<Vertex> cloud = points(geometry, {320});
  ASSERT_EQ(cloud.size(), 1U);
  EXPECT_NEAR(cloud[0].z, 18.99332, 1e-5);
  // Pixel (0, 0): X = -604.0814 / 707.0493 * 18.99332 = -16.22734.
  EXPECT_NEAR(cloud[0].x, -16.22734, 1e-4);
}

TEST(StereoGeometry, OnlyDifferencesOfTheTwoCount) {
  // Both cameras 3 above and 7 before the frame that P1 and P2 are given in.
  Projections p;
  for (cv::Matx34d* projection : {&p.left, &p.right}) {
    (*projection)(1, 3) = 1500;
    (*projection)(2, 3) = -7;
  }
  EXPECT_EQ(p.line(), "");
  EXPECT_DOUBLE_EQ(geometry_of(p.left, p.right).baseline, 0.1);
}

TEST(StereoGeometry, TwoPercentOfTheBaselineAreLevel) {
  Projections p;
  p.right(1, 3) = 1e-14;
  EXPECT_EQ(p.line(), "");
  p.right(1, 3) = -0.99;  // 0.99 / 500 = 0.00198 below, 1.98 % of 0.1
  EXPECT_EQ(p.line(), "");
  p.right(1, 3) = -1.01;
  EXPECT_EQ(p.line(),
            "c: P1, P2: the right camera lies 0.00202 below and 0 before the left one, more than 2 % of the "
            "baseline of "
            "0.1: rows do not match");
  p.right(1, 3) = 0;
  p.right(2, 3) = 0.0021;
  EXPECT_EQ(p.line(),
            "c: P1, P2: the right camera lies 0 below and -0.0021 before the left one, more than 2 % of the "
            "baseline "
            "of 0.1: rows do not match");
  p.right(2, 3) = 0;
  p.right(1, 3) = -60;
  EXPECT_EQ(
      p.line(),
      "c: P1, P2: the cameras are above each other, 0.12 against 0.1 beside; only side by side cameras are "
      "supported");
}

TEST(StereoGeometry, WithoutABaselineThereIsNoDepth) {
  Projections p;
  p.right(0, 3) = 0;
  EXPECT_EQ(p.line(),
            "c: P1, P2: no baseline: element (0,3) is 0 left and 0 right; it is smaller on the right by "
            "focal length * "
            "baseline");
  p.left(0, 3) = p.right(0, 3) = -50;
  EXPECT_EQ(p.line().substr(0, 24), "c: P1, P2: no baseline: ");
  p.right(0, 3) = std::nextafter(-50, -51);
  EXPECT_EQ(p.line().substr(0, 24), "c: P1, P2: no baseline: ") << "equal but for rounding";
  p.right(0, 3) = -25;
  EXPECT_EQ(p.line(),
            "c: P1, P2: the right camera lies 0.05 to the left of the left one; are the images exchanged?");
}

TEST(StereoGeometry, ABaselineBeyondAllUnitsIsRefused) {
  Projections p;
  p.right(0, 3) = -1e308;
  EXPECT_EQ(p.line(), "c: P1, P2: a baseline of 2e+305: the calibration is implausible");
}

TEST(StereoGeometry, WhatIsNoProjectionOfARectifiedPairIsRefused) {
  const auto with = [](int row, int column, double value) {
    Projections p;
    p.right(row, column) = value;
    return p.line();
  };
  EXPECT_EQ(with(0, 0, 510),
            "c: P1, P2: horizontal focal lengths 500 px left and 510 px right; rectified images have one");
  EXPECT_EQ(with(1, 1, 510),
            "c: P1, P2: vertical focal lengths 500 px left and 510 px right; rectified images have one");
  EXPECT_EQ(with(0, 0, 500.04), "");
  EXPECT_EQ(with(1, 2, 241),
            "c: P1, P2: principal points at row 240 left and 241 right; rectified images have them at the "
            "same one");
  EXPECT_EQ(with(1, 2, 240.09), "");
  EXPECT_EQ(with(0, 1, 2),
            "c: P1, P2: skewed: elements (0,1) and (1,0) are 2 and 0; those of a rectified image are 0");
  EXPECT_EQ(with(2, 2, 2),
            "c: P1, P2: the third row begins with 0, 0, 2; that of a projection matrix with 0, 0, 1");
  EXPECT_EQ(with(0, 0, -500),
            "c: P1, P2: focal lengths -500 and 500 px; those of a rectified image are from 1 to 10000000 px");
  EXPECT_EQ(with(1, 1, 0.8),
            "c: P1, P2: focal lengths 500 and 0.8 px; those of a rectified image are from 1 to 10000000 px");
  EXPECT_EQ(with(0, 2, 1e308), "c: P1, P2: principal point (1e+308, 240) px: the calibration is implausible");
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (const int column : {0, 1, 2, 3}) {
      EXPECT_EQ(
          with(1, column, value),
          "c: P1, P2: a projection matrix with a value that is not finite: the calibration is implausible");
    }
  }
}

TEST(StereoGeometry, PixelsThatAreNotSquareScaleY) {
  // fx = 500, fy = 400, baseline 0.1, d = 10 px: Z = 500 * 0.1 / 10 = 5, and at (1, 1) from cx = -99, cy =
  // -39: X = 100 / 500 * 5 = 1, Y = 40 / 400 * 5 = 0.5.
  StereoGeometry geometry;
  geometry.focal_x = 500;
  geometry.focal_y = 400;
  geometry.cx_left = geometry.cx_right = -99;
  geometry.cy = -39;
  geometry.baseline = 0.1;
  const std::vector<Vertex> cloud = points(geometry, {160, 160, 160, 160}, 2);
  ASSERT_EQ(cloud.size(), 4U);
  EXPECT_FLOAT_EQ(cloud[3].x, 1);
  EXPECT_FLOAT_EQ(cloud[3].y, 0.5);
  EXPECT_FLOAT_EQ(cloud[3].z, 5);
  EXPECT_FLOAT_EQ(cloud[0].y, 39.F / 400 * 5);
  const StereoGeometry again = geometry_of(disparity_to_depth(geometry), "Q");
  EXPECT_DOUBLE_EQ(again.focal_y, 400);
  EXPECT_DOUBLE_EQ(again.cy, -39);
}

TEST(StereoGeometry, PointsBehindTheCameraAreLeftOutAndCounted) {
  // cx 100 left, 96 right: doffs = -4, so that a point at infinity has the disparity 4 and Z = 500 * 0.1 / (d
  // - 4): d = 2 lies behind, 4 at infinity, 6 at 25, 14 at 5.
  StereoGeometry geometry;
  geometry.focal_x = geometry.focal_y = 500;
  geometry.cx_left = 100;
  geometry.cx_right = 96;
  geometry.baseline = 0.1;
  EXPECT_DOUBLE_EQ(geometry.doffs(), -4);
  const std::vector<Vertex> cloud = points(geometry, {32, 0, 64, 96, 224});
  ASSERT_EQ(cloud.size(), 2U);
  EXPECT_FLOAT_EQ(cloud[0].z, 25);
  EXPECT_FLOAT_EQ(cloud[1].z, 5);
  const std::vector<Disparity> map{{32, Cause::kMatched}, {0, Cause::kMatched}, {224, Cause::kMatched}};
  const std::vector<unsigned char> ply = encode_point_cloud_ply(
      {map, 3, 1}, cv::Mat(1, 3, CV_8UC1, cv::Scalar(0)), disparity_to_depth(geometry));
  EXPECT_NE(std::string(ply.begin(), ply.end())
                .find("\ncomment left out: 2 pixels whose points lie behind the camera\n"),
            std::string::npos);
}

TEST(StereoGeometry, AQOfAnotherFormIsRefused) {
  const cv::Matx44d good(1, 0, 0, -320, 0, 1, 0, -240, 0, 0, 0, 500, 0, 0, 10, 0);
  const auto with = [&good](int row, int column, double value) {
    cv::Matx44d q = good;
    q(row, column) = value;
    return message([&] { geometry_of(q, "c: Q"); });
  };
  EXPECT_EQ(message([&] { geometry_of(good, "c: Q"); }), "");
  const std::string form =
      "c: Q: not of the form that cv::stereoRectify gives: 1 0 0 -cx; 0 1 0 -cy; 0 0 0 f; 0 0 1/baseline "
      "(cx_right - "
      "cx)/baseline";
  EXPECT_EQ(with(0, 0, 0), form);
  EXPECT_EQ(with(1, 1, -1), form) << "y upwards";
  EXPECT_EQ(with(0, 1, 0.1), form);
  EXPECT_EQ(with(2, 2, 1), form);
  EXPECT_EQ(with(3, 1, std::numeric_limits<double>::quiet_NaN()), form);
  for (const auto& [value, text] : {std::pair{0.0, "0"}, {-10.0, "-10"}, {1e-300, "1e-300"}}) {
    EXPECT_EQ(with(3, 2, value),
              std::string("c: Q: element (3,2), 1/baseline, is ") + text +
                  "; with a right camera to the right of the left one it is 1e-09 and more");
  }
  EXPECT_EQ(with(2, 3, -500),
            "c: Q: focal lengths -500 and -500 px; those of a rectified image are from 1 to 10000000 px");
  EXPECT_EQ(with(0, 3, 1e308),
            "c: Q: principal points at columns -1e+308 and -1e+308, row 240: the calibration is implausible");
}

}  // namespace stereo_geometry_test
}  // namespace parallax
