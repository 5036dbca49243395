// SPDX-License-Identifier: Apache-2.0
#include "platform/results/legend.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "platform/results/result_images.hpp"

namespace parallax {
namespace legend_test {

const cv::Vec3b kWhite(255, 255, 255);
const cv::Vec3b kBlack(0, 0, 0);

bool is_empty(const cv::Mat& image) { return cv::countNonZero(image.reshape(1)) == 0; }

TEST(ColorScale, EndsAndBeyond) {
  const ColorScale scale(10, 12, {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}});
  EXPECT_EQ(scale.color(10), cv::Vec3b(1, 1, 1));
  EXPECT_EQ(scale.color(10.4), cv::Vec3b(1, 1, 1));
  EXPECT_EQ(scale.color(10.6), cv::Vec3b(2, 2, 2));
  EXPECT_EQ(scale.color(12), cv::Vec3b(3, 3, 3));
  EXPECT_EQ(scale.color(-5), cv::Vec3b(1, 1, 1));
  EXPECT_EQ(scale.color(99), cv::Vec3b(3, 3, 3));
  EXPECT_EQ(ColorScale(4, 4, {{7, 7, 7}}).color(4), cv::Vec3b(7, 7, 7));
  EXPECT_THROW(ColorScale(1, 0, {{7, 7, 7}}), std::invalid_argument);
  EXPECT_THROW(ColorScale(0, 1, {}), std::invalid_argument);
}

TEST(ColorScale, DisparitiesAreTheBrightPartOfTurbo) {
  const ColorScale scale = disparity_scale(0, 255);
  cv::Mat ramp(1, 256, CV_8UC1), turbo;
  for (int i = 0; i < 256; ++i) ramp.at<std::uint8_t>(i) = static_cast<std::uint8_t>(i);
  cv::applyColorMap(ramp, turbo, cv::COLORMAP_TURBO);
  for (int d = 0; d < 256; ++d) {
    EXPECT_EQ(scale.color(d), turbo.at<cv::Vec3b>(24 + d * 231 / 255)) << d;
    EXPECT_GT(cv::norm(scale.color(d), kBlack), 60) << "a valid pixel looks invalid";
  }
}

TEST(ScaleTicks, RoundNumbersBetweenTheEnds) {
  using Ticks = std::vector<int>;
  EXPECT_EQ(scale_ticks(0, 127, 8), (Ticks{0, 20, 40, 60, 80, 100, 127}));
  EXPECT_EQ(scale_ticks(0, 127, 7), (Ticks{0, 20, 40, 60, 80, 100, 127}));
  EXPECT_EQ(scale_ticks(0, 127, 6), (Ticks{0, 50, 127}));
  EXPECT_EQ(scale_ticks(0, 127, 2), (Ticks{0, 127}));
  EXPECT_EQ(scale_ticks(0, 127, 0), (Ticks{0, 127}));
  EXPECT_EQ(scale_ticks(64, 191, 6), (Ticks{64, 100, 120, 140, 160, 191})) << "80 and 180 are too close";
  EXPECT_EQ(scale_ticks(0, 5, 9), (Ticks{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(scale_ticks(3, 3, 9), (Ticks{3}));
}

class LegendAt : public ::testing::TestWithParam<int> {};

TEST_P(LegendAt, ShowsTheScale) {
  const int width = GetParam();
  const Legend legend = disparity_legend(disparity_scale(32, 159));
  const LegendScale& scale = *legend.scale;
  const cv::Mat image = draw_legend(legend, width);
  ASSERT_EQ(image.type(), CV_8UC3);
  ASSERT_EQ(image.cols, width);
  const ScalePlace place = scale_place(scale, width);
  EXPECT_GT(place.last - place.first, width / 2);
  // The bar has at each disparity the colour that the disparity has in the picture, but for the rounding to
  // a column.
  const double step = 127.0 / (place.last - place.first);
  for (int value = 32; value <= 159; ++value) {
    const auto shown = image.at<cv::Vec3b>((place.top + place.bottom) / 2, place.column(scale, value));
    double difference = 1e9;
    for (const double offset : {-step / 2, 0.0, step / 2}) {
      difference = std::min(difference, cv::norm(shown, scale.colors.color(value + offset), cv::NORM_INF));
    }
    EXPECT_LE(difference, 6) << value;
  }
  EXPECT_EQ(image.at<cv::Vec3b>(place.top, place.first), scale.colors.color(32));
  EXPECT_EQ(image.at<cv::Vec3b>(place.bottom, place.last), scale.colors.color(159));
  // Ticks are white in the row below the bar: at the ends, and at round disparities between.
  int ticks = 0;
  for (int x = 0; x < width; ++x) {
    const auto pixel = [&](int column) { return image.at<cv::Vec3b>(place.bottom + 1, column); };
    if (pixel(x) == kBlack) continue;
    const int begin = x;
    for (; pixel(x) != kBlack; ++x) EXPECT_EQ(pixel(x), kWhite);
    ++ticks;
    bool known = false;
    for (int value = 32; value <= 159; ++value) {
      const int column = place.column(scale, value);
      known |= begin <= column && column < x && (value % 5 == 0 || value == 32 || value == 159);
    }
    EXPECT_TRUE(known) << begin;
  }
  EXPECT_LE(ticks, 15);
  EXPECT_GE(ticks, width < 320 ? 2 : 4);
}

TEST_P(LegendAt, NothingIsClipped) {
  for (const Legend& legend : {disparity_legend(disparity_scale(0, 255)), cause_legend(), error_legend()}) {
    const cv::Mat image = draw_legend(legend, GetParam());
    EXPECT_FALSE(is_empty(image));
    EXPECT_TRUE(is_empty(image.col(0).clone()));
    EXPECT_TRUE(is_empty(image.col(image.cols - 1).clone()));
    EXPECT_TRUE(is_empty(image.row(0).clone()));
    EXPECT_TRUE(is_empty(image.row(image.rows - 1).clone()));
    for (const LegendEntry& entry : legend.entries) {
      cv::Mat found;
      cv::inRange(image, entry.color, entry.color, found);
      EXPECT_GE(cv::countNonZero(found), 8 * 8) << entry.name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Width, LegendAt, ::testing::Values(96, 97, 128, 320, 640, 1280, 1856, 3720));

TEST(Legend, NoneBelow96Pixels) {
  const Legend legend = cause_legend();
  EXPECT_EQ(draw_legend(legend, 95).size(), cv::Size(95, 0));
  const cv::Mat picture(5, 7, CV_8UC3, cv::Scalar(1, 2, 3));
  const cv::Mat labelled = with_legend(picture, legend);
  EXPECT_EQ(labelled.size(), picture.size());
  EXPECT_EQ(cv::norm(labelled, picture), 0);
}

TEST(Legend, LeavesThePictureAsItIs) {
  cv::Mat picture(40, 320, CV_8UC3);
  cv::randu(picture, 0, 255);
  const Legend legend = error_legend();
  const cv::Mat labelled = with_legend(picture, legend);
  ASSERT_EQ(labelled.size(), cv::Size(320, 40 + draw_legend(legend, 320).rows));
  EXPECT_EQ(cv::norm(labelled.rowRange(0, 40), picture), 0);
}

TEST(SideBySide, BothPicturesCaptionsAndLegend) {
  for (const int width : {40, 96, 640}) {
    const cv::Mat left(30, width, CV_8UC3, cv::Scalar(10, 20, 30));
    const cv::Mat right(30, width, CV_8UC3, cv::Scalar(40, 50, 60));
    const Legend legend = disparity_legend(disparity_scale(0, 127));
    const cv::Mat image = side_by_side(left, "rectified left", right, "disparity", legend);
    const int legend_rows = draw_legend(legend, image.cols).rows;
    const int top = image.rows - legend_rows - 30;
    EXPECT_EQ(top > 0, width >= 96) << "captions";
    EXPECT_EQ(cv::norm(image(cv::Rect(0, top, width, 30)), left), 0);
    EXPECT_EQ(cv::norm(image(cv::Rect(image.cols - width, top, width, 30)), right), 0);
    if (top == 0) continue;
    for (const int x : {0, image.cols - width}) {
      EXPECT_FALSE(is_empty(image(cv::Rect(x, 0, width, top)).clone())) << "no caption at " << x;
      EXPECT_TRUE(is_empty(image(cv::Rect(x + width - 1, 0, 1, top)).clone())) << "caption is clipped";
    }
  }
}

}  // namespace legend_test
}  // namespace parallax
