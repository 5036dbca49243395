// SPDX-License-Identifier: Apache-2.0
#include "platform/results/strip_gif.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "platform/images/image_codecs.hpp"
#include "platform/results/legend.hpp"
#include "platform/results/output_file.hpp"
#include "platform/results/peak_memory.hpp"
#include "platform/results/result_images.hpp"
#include "tests/paths.hpp"
#include "tests/platform/error_line.hpp"
#include "tests/platform/python.hpp"
#include "tests/platform/random_map.hpp"
#include "tests/platform/temporary_folder.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace strip_gif_test {

/// A GIF as Pillow reads it.
struct Animation {
  int loop = -1;
  std::vector<int> durations;  ///< ms
  std::vector<cv::Mat> frames;
};

Animation read_gif(const TemporaryFolder& folder) {
  const auto told = nlohmann::json::parse(test::python(folder, R"(
import json
from PIL import Image, ImageSequence
gif = Image.open("strip.gif")
durations = []
for number, frame in enumerate(ImageSequence.Iterator(gif)):
    durations.append(frame.info["duration"])
    frame.convert("RGB").save("%d.png" % number)
print(json.dumps({"loop": gif.info["loop"], "durations": durations})))"));
  Animation gif{told["loop"], told["durations"], {}};
  for (std::size_t i = 0; i < gif.durations.size(); ++i) {
    gif.frames.push_back(read_image(folder / (std::to_string(i) + ".png"), cv::IMREAD_COLOR));
  }
  return gif;
}

cv::Mat ramp(const cv::Size& size, int shift) {
  cv::Mat image(size, CV_8UC1);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>((x + y + shift) & 255);
    }
  }
  return image;
}

class Strip : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!test::python_has("PIL")) GTEST_SKIP() << "no python3-pil";
  }

  TemporaryFolder folder_;
};

TEST_F(Strip, AnotherReaderSeesTheFrames) {
  const cv::Size size(160, 48);
  const ColorScale scale = disparity_scale(0, 255);
  const std::vector<double> arrivals{21.2, 31.2, 131.2, 187.0};  // ms
  OutputFile file(folder_ / "strip.gif");
  StripGif strip(file, size, scale);
  std::vector<cv::Mat> left, disparities;
  for (int i = 0; i < 4; ++i) {
    const std::vector<Disparity> map =
        test::random_map(size.width, size.height, static_cast<std::uint64_t>(i));
    left.push_back(ramp(size, 40 * i));
    disparities.push_back(disparity_colors({map, size.width, size.height}, scale));
    strip.add(left.back(), {map, size.width, size.height}, arrivals[static_cast<std::size_t>(i)]);
  }
  strip.complete();
  EXPECT_FALSE(std::filesystem::exists(folder_ / "strip.gif"));
  file.publish();

  const Animation gif = read_gif(folder_);
  EXPECT_EQ(gif.loop, 0) << "for ever";
  EXPECT_EQ(gif.durations, (std::vector<int>{20, 100, 60, 60}))
      << "at least 20 ms; the last as the one before";
  ASSERT_EQ(gif.frames.size(), 4U);
  const cv::Mat legend = draw_legend(disparity_legend(scale), 320);
  for (std::size_t i = 0; i < 4; ++i) {
    const cv::Mat& frame = gif.frames[i];
    ASSERT_EQ(frame.size(), cv::Size(320, 48 + legend.rows));
    cv::Mat grey;
    cv::cvtColor(left[i], grey, cv::COLOR_GRAY2BGR);
    EXPECT_LE(cv::norm(frame(cv::Rect({0, 0}, size)), grey, cv::NORM_INF), 4) << i;
    const cv::Mat right = frame(cv::Rect({160, 0}, size));
    EXPECT_LE(cv::norm(right, disparities[i], cv::NORM_INF), 8) << i;
    // Invalid pixels are exactly black, and they alone.
    cv::Mat black, invalid;
    cv::inRange(right, cv::Scalar::all(0), cv::Scalar::all(0), black);
    cv::inRange(disparities[i], cv::Scalar::all(0), cv::Scalar::all(0), invalid);
    EXPECT_EQ(cv::norm(black, invalid), 0) << i;
    EXPECT_LE(cv::norm(frame.rowRange(48, frame.rows), legend, cv::NORM_INF), 8) << i << ": the legend stays";
  }
}

TEST_F(Strip, LargeFramesAreMadeSmaller) {
  const cv::Size size(1856, 928);
  const ColorScale scale = disparity_scale(0, 127);
  std::vector<Disparity> map(static_cast<std::size_t>(size.area()));
  for (std::size_t i = map.size() / 2; i < map.size(); ++i) map[i].value = 100 * 16;
  OutputFile file(folder_ / "strip.gif");
  StripGif strip(file, size, scale);
  strip.add(cv::Mat(size, CV_8UC1, cv::Scalar(200)), {map, size.width, size.height}, 0);
  strip.complete();
  file.publish();
  const Animation gif = read_gif(folder_);
  ASSERT_EQ(gif.frames.size(), 1U);
  const cv::Mat& frame = gif.frames[0];
  EXPECT_EQ(frame.size(), cv::Size(640, 160 + draw_legend(disparity_legend(scale), 640).rows));
  EXPECT_EQ(frame.at<cv::Vec3b>(79, 639), cv::Vec3b(0, 0, 0));
  EXPECT_LE(cv::norm(frame.at<cv::Vec3b>(80, 639), scale.color(100), cv::NORM_INF), 8);
  EXPECT_LE(cv::norm(frame.at<cv::Vec3b>(80, 319), cv::Vec3b::all(200), cv::NORM_INF), 4);
}

TEST_F(Strip, TheSmallestFrames) {
  const std::vector<Disparity> map{{0, Cause::kMatched}};
  OutputFile file(folder_ / "strip.gif");
  StripGif strip(file, {1, 1}, disparity_scale(0, 0));
  for (int i = 0; i < 3; ++i) strip.add(cv::Mat(1, 1, CV_8UC1, cv::Scalar(255)), {map, 1, 1}, 1e9 * i);
  strip.complete();
  file.publish();
  const Animation gif = read_gif(folder_);
  ASSERT_EQ(gif.frames.size(), 3U);
  EXPECT_EQ(gif.frames[2].size(), cv::Size(2, 1));
  EXPECT_EQ(gif.durations[1], 655350) << "the longest that the format knows";
}

TEST(StripFile, MemoryStaysFlat) {
  if (test::sanitized()) GTEST_SKIP() << "the sanitizer keeps freed memory for a while";
  const TemporaryFolder folder;
  const cv::Size size(320, 240);
  const std::vector<Disparity> map = test::random_map(size.width, size.height, 3);
  const cv::Mat left = ramp(size, 0);
  OutputFile file(folder / "strip.gif");
  StripGif strip(file, size, disparity_scale(0, 255));
  const auto add = [&](int frames) {
    for (int i = 0; i < frames; ++i) strip.add(left, {map, size.width, size.height}, i);
    return peak_memory_megabytes();
  };
  const double before = add(20);
  EXPECT_LT(add(500), before + 2.0);
}

TEST(StripFile, NothingIsLeftWhenItDoesNotFit) {
  const TemporaryFolder folder;
  const cv::Size size(320, 240);
  const std::vector<Disparity> map = test::random_map(size.width, size.height, 3);
  // A limit on the file's size stops the write half way, as a full disk does.
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 100'000;
  ::setrlimit(RLIMIT_FSIZE, &small);
  const std::string line = error_line<UserError>([&] {
    OutputFile file(folder / "strip.gif");
    StripGif strip(file, size, disparity_scale(0, 255));
    for (int i = 0; i < 100; ++i) strip.add(ramp(size, i), {map, size.width, size.height}, i);
  });
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(line, "cannot write " + (folder / "strip.gif") + ": File too large");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace strip_gif_test
}  // namespace parallax
