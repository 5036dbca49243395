// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/exchanged_sides.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>

#include "platform/images/image_codecs.hpp"
#include "platform/scene/scene.hpp"
#include "tests/paths.hpp"

namespace parallax {
namespace exchanged_sides_test {

constexpr int kLargest = 127;

TEST(ExchangedSides, TheBuiltInScene) {
  for (const bool distortion : {false, true}) {
    SceneConfig config;
    config.distortion = distortion;
    const StereoImages images = Scene(config).render(0);
    const int rows = distortion ? 16 : 0;
    EXPECT_FALSE(sides_look_exchanged(images.left, images.right, kLargest, rows));
    EXPECT_TRUE(sides_look_exchanged(images.right, images.left, kLargest, rows));
  }
}

TEST(ExchangedSides, WhatSaysNothing) {
  cv::Mat left(480, 640, CV_8UC1), right(480, 640, CV_8UC1);
  cv::theRNG().state = 7;
  cv::randu(left, 0, 256);
  cv::randu(right, 0, 256);
  EXPECT_FALSE(sides_look_exchanged(left, right, kLargest, 0)) << "nothing in common";
  EXPECT_FALSE(sides_look_exchanged(left, left, kLargest, 0)) << "no disparity";
  const cv::Mat flat(480, 640, CV_8UC1, cv::Scalar(90));
  EXPECT_FALSE(sides_look_exchanged(flat, flat, kLargest, 0)) << "no texture";
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(32, 16), cv::Size(1856, 1), cv::Size(4, 1000)}) {
    const cv::Mat small = left(cv::Rect(0, 0, std::min(640, size.width), std::min(480, size.height)));
    EXPECT_FALSE(sides_look_exchanged(small, small, 255, 16));
  }
}

TEST(ExchangedSides, RealPairs) {
  for (const char* name :
       {"tsukuba", "cones", "cloth3", "kitti2012_000000", "kitti2012_000028", "kitti_seq2"}) {
    const std::string folder = test::shared_data(name);
    const std::string number = name == std::string("kitti_seq2") ? "_00.png" : ".png";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no development data";
    const cv::Mat left = read_image(folder + "/left" + number, cv::IMREAD_GRAYSCALE);
    const cv::Mat right = read_image(folder + "/right" + number, cv::IMREAD_GRAYSCALE);
    EXPECT_FALSE(sides_look_exchanged(left, right, kLargest, 0)) << name;
    EXPECT_TRUE(sides_look_exchanged(right, left, kLargest, 0)) << name;
  }
}

}  // namespace exchanged_sides_test
}  // namespace parallax
