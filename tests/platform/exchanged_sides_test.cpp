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

bool look_exchanged(const cv::Mat& left, const cv::Mat& right) {
  return sides_look_exchanged({left, right}, {right, left}, kLargest);
}

TEST(ExchangedSides, TheBuiltInScene) {
  SceneConfig config;
  config.distortion = false;
  const StereoImages images = Scene(config).render(0);
  EXPECT_FALSE(look_exchanged(images.left, images.right));
  EXPECT_TRUE(look_exchanged(images.right, images.left));
}

TEST(ExchangedSides, WhatSaysNothing) {
  cv::Mat left(480, 640, CV_8UC1), right(480, 640, CV_8UC1);
  cv::theRNG().state = 7;
  cv::randu(left, 0, 256);
  cv::randu(right, 0, 256);
  EXPECT_FALSE(look_exchanged(left, right)) << "nothing in common";
  EXPECT_FALSE(look_exchanged(left, left)) << "no disparity";
  const cv::Mat flat(480, 640, CV_8UC1, cv::Scalar(90));
  EXPECT_FALSE(look_exchanged(flat, flat)) << "no texture";
  for (const cv::Size size :
       {cv::Size(1, 1), cv::Size(8, 8), cv::Size(32, 16), cv::Size(640, 1), cv::Size(4, 480)}) {
    const cv::Mat small = left(cv::Rect(cv::Point(), size));
    EXPECT_FALSE(look_exchanged(small, small));
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
    EXPECT_FALSE(look_exchanged(left, right)) << name;
    EXPECT_TRUE(look_exchanged(right, left)) << name;
  }
}

}  // namespace exchanged_sides_test
}  // namespace parallax
