// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <sstream>
#include <string>

#include "error_line.hpp"
#include "platform/images/image_codecs.hpp"
#include "platform/results/disparity_bin.hpp"
#include "platform/results/point_cloud.hpp"
#include "platform/results/result_images.hpp"
#include "platform/scene/scene_hash.hpp"
#include "python.hpp"
#include "random_map.hpp"
#include "temporary_folder.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace result_writers_test {

using test::random_map;

/// Bit by bit: pixel i of a row occupies the row's bits 12 i to 12 i + 11, least significant first.
int naive_unpack(const std::vector<unsigned char>& bytes, int width, int x, int y) {
  const int row_bits = (width * 12 + 7) / 8 * 8;
  int value = 0;
  for (int bit = 0; bit < 12; ++bit) {
    const int at = y * row_bits + x * 12 + bit;
    value |= ((bytes.at(static_cast<std::size_t>(at / 8)) >> (at % 8)) & 1) << bit;
  }
  return value;
}

TEST(DisparityBin, RoundTripAndIndependentUnpacker) {
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 1}, {3, 5}, {32, 16}, {33, 7}, {640, 3}}) {
    const std::vector<Disparity> map = random_map(width, height, 5);
    const std::vector<unsigned char> bytes = pack_disparities({map, width, height});
    EXPECT_EQ(bytes.size(), static_cast<std::size_t>((width * 12 + 7) / 8 * height));
    const std::vector<std::uint16_t> values = unpack_disparities(bytes, width, height);
    ASSERT_EQ(values.size(), map.size());
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const auto i = static_cast<std::size_t>(y * width + x);
        ASSERT_EQ(values[i], map[i].value);
        ASSERT_EQ(naive_unpack(bytes, width, x, y), map[i].value);
      }
    }
  }
}

TEST(DisparityBin, KnownBytes) {
  const std::vector<Disparity> map{
      {0xABC, Cause::kMatched}, {0x123, Cause::kMatched}, {0xFFF, Cause::kSpeckle}};
  EXPECT_EQ(pack_disparities({map, 3, 1}), (std::vector<unsigned char>{0xBC, 0x3A, 0x12, 0xFF, 0x0F}));
}

TEST(DisparityBin, WrongLengthIsAUserError) {
  EXPECT_EQ(error_line<UserError>([] { unpack_disparities(std::vector<unsigned char>(10), 4, 2); }),
            "the packed disparity map has 10 bytes, 4x2 pixels of 12 bits need 12");
}

TEST(DisparityView, SizeMustBeThatOfThePixels) {
  EXPECT_THROW(DisparityView(std::vector<Disparity>(5), 2, 3), std::invalid_argument);
  EXPECT_THROW(DisparityView({}, 0, 0), std::invalid_argument);
}

TEST(DisparityPng, KittiConvention) {
  const int width = 67, height = 31;
  std::vector<Disparity> map = random_map(width, height, 7);
  map[0] = {0, Cause::kMatched};
  map[1] = {1, Cause::kMatched};
  map[2] = {0xFFE, Cause::kMatched};
  const cv::Mat image = decode_image(encode_image(".png", disparity_values({map, width, height})));
  ASSERT_EQ(image.size(), cv::Size(width, height));
  ASSERT_EQ(image.type(), CV_16UC1);
  EXPECT_EQ(image.at<std::uint16_t>(0, 0), 1) << "disparity 0 is valid";
  EXPECT_EQ(image.at<std::uint16_t>(0, 1), 16);
  EXPECT_EQ(image.at<std::uint16_t>(0, 2), 0xFFE * 16);
  for (int i = 1; i < width * height; ++i) {
    const Disparity& d = map[static_cast<std::size_t>(i)];
    const int read = image.at<std::uint16_t>(i / width, i % width);
    ASSERT_EQ(read != 0, d.valid() || read == 1);
    if (d.valid() && d.value > 0) {
      ASSERT_EQ(read / 256.0, d.value / 16.0);
    }
  }
}

TEST(DisparityColors, EachPixelOnTheScale) {
  const int width = 320, height = 40;
  std::vector<Disparity> map(static_cast<std::size_t>(width * height));
  for (int i = 0; i < width; ++i) {
    map[static_cast<std::size_t>(i)] = {static_cast<std::uint16_t>(16 * 64 + i * 16 * 127 / (width - 1)),
                                        Cause::kMatched};
  }
  const ColorScale scale = disparity_scale(64, 191);
  const cv::Mat image = disparity_colors({map, width, height}, scale);
  ASSERT_EQ(image.type(), CV_8UC3);
  ASSERT_EQ(image.size(), cv::Size(width, height));
  for (int x = 0; x < width; ++x) {
    const double share = (map[static_cast<std::size_t>(x)].value / 16.0 - 64) / 127;
    ASSERT_EQ(image.at<cv::Vec3b>(0, x), scale.colors()[static_cast<std::size_t>(share * 255 + 0.5)]) << x;
    ASSERT_EQ(image.at<cv::Vec3b>(1, x), cv::Vec3b(0, 0, 0)) << "invalid";
  }
  const auto far = image.at<cv::Vec3b>(0, 20);
  const auto near = image.at<cv::Vec3b>(0, width - 20);
  EXPECT_GT(far[0], far[2]) << "blue";
  EXPECT_GT(near[2], near[0]) << "red";
}

TEST(CauseColors, ColourAndLabel) {
  const int width = 320, height = 20;
  const std::vector<Disparity> map = random_map(width, height, 9);
  const cv::Mat colour = cause_colors({map, width, height});
  const cv::Mat labels = decode_image(encode_image(".png", cause_labels({map, width, height})));
  ASSERT_EQ(labels.size(), cv::Size(width, height));
  ASSERT_EQ(labels.type(), CV_8UC1);
  ASSERT_EQ(colour.size(), cv::Size(width, height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto cause = static_cast<std::size_t>(map[static_cast<std::size_t>(y * width + x)].cause);
      ASSERT_EQ(labels.at<std::uint8_t>(y, x), cause);
      const auto& rgb = cause_styles()[cause].rgb;
      ASSERT_EQ(colour.at<cv::Vec3b>(y, x), cv::Vec3b(rgb[2], rgb[1], rgb[0]));
      EXPECT_EQ(cause_legend().entries[cause].color, colour.at<cv::Vec3b>(y, x));
      EXPECT_EQ(cause_legend().entries[cause].name, cause_styles()[cause].name);
    }
  }
}

TEST(ErrorColors, ErrorsInvalidAndNotScored) {
  const auto found = [](int sixteenths) {
    return Disparity{static_cast<std::uint16_t>(sixteenths), Cause::kMatched};
  };
  const Disparity none{kInvalidDisparity, Cause::kTexture};
  //                              right, 1 px less, 2.5 px more, 40 px more, invalid, unknown, both, masked
  const std::vector<Disparity> map{found(320), found(304), found(360), found(960),
                                   none,       found(320), none,       found(320)};
  const float t = 20;
  const GroundTruth truth{8, 1, {t, t, t, t, t, 0, 0, t}, {255, 255, 255, 255, 255, 255, 255, 0}, 1};
  const cv::Mat image = error_colors({map, 8, 1}, truth);
  ASSERT_EQ(image.size(), cv::Size(8, 1));
  const auto pixel = [&](int x) { return image.at<cv::Vec3b>(0, x); };
  const ColorScale scale = error_scale();
  EXPECT_EQ(pixel(0), scale.color(0));
  EXPECT_EQ(pixel(1), scale.color(1));
  EXPECT_EQ(pixel(2), scale.color(2.5));
  EXPECT_EQ(pixel(3), scale.color(5));
  const Legend legend = error_legend();
  ASSERT_EQ(legend.entries.size(), 2U);
  EXPECT_EQ(legend.entries[0].name, "invalid");
  EXPECT_EQ(pixel(4), legend.entries[0].color);
  EXPECT_EQ(legend.entries[1].name, "not scored");
  for (const int x : {5, 6, 7}) EXPECT_EQ(pixel(x), legend.entries[1].color) << x;
  EXPECT_THROW(error_colors({map, 4, 2}, truth), std::invalid_argument);
}

TEST(ErrorColors, WhatHasNoErrorIsNotTakenForOne) {
  const Legend legend = error_legend();
  for (const LegendEntry& entry : legend.entries) {
    for (const cv::Vec3b& color : legend.scale->colors.colors()) {
      EXPECT_GT(cv::norm(entry.color, color), 60) << entry.name;
    }
  }
}

TEST(CausesPng, EveryCauseHasItsOwnStyle) {
  for (std::size_t i = 0; i < cause_styles().size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(cause_styles()[i].cause), i)
        << "a cause without its style in result_images.cpp";
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_NE(cause_styles()[i].rgb, cause_styles()[j].rgb);
      EXPECT_NE(cause_styles()[i].name, cause_styles()[j].name);
    }
  }
}

TEST(GreyPng, RoundTrip) {
  cv::Mat image(7, 9, CV_8UC1);
  for (int i = 0; i < 63; ++i) {
    image.at<std::uint8_t>(i / 9, i % 9) =
        static_cast<std::uint8_t>(scene_hash(1, static_cast<std::uint64_t>(i)));
  }
  EXPECT_EQ(cv::norm(decode_image(encode_image(".png", image)), image, cv::NORM_INF), 0);
}

struct Vertex {
  float x, y, z;
  int grey;
};

std::vector<Vertex> parse_ply(const std::vector<unsigned char>& bytes) {
  const std::string text(bytes.begin(), bytes.end());
  const std::size_t body = text.find("end_header\n") + 11;
  std::istringstream header(text.substr(0, body));
  std::vector<std::string> lines;
  for (std::string line; std::getline(header, line);) lines.push_back(line);
  const std::size_t count = std::stoul(lines.at(4).substr(15));
  EXPECT_EQ(lines, (std::vector<std::string>{"ply", "format binary_little_endian 1.0",
                                             "comment unit: that of the calibration",
                                             "comment axes of the left camera: x right, y down, z forward",
                                             "element vertex " + std::to_string(count), "property float x",
                                             "property float y", "property float z", "property uchar red",
                                             "property uchar green", "property uchar blue", "end_header"}));
  EXPECT_EQ(bytes.size(), body + 15 * count);
  std::vector<Vertex> vertices;
  for (std::size_t i = 0; i < count; ++i) {
    Vertex v{};
    std::memcpy(&v.x, &bytes[body + 15 * i], 12);
    v.grey = bytes[body + 15 * i + 12];
    EXPECT_EQ(v.grey, bytes[body + 15 * i + 13]);
    EXPECT_EQ(v.grey, bytes[body + 15 * i + 14]);
    vertices.push_back(v);
  }
  return vertices;
}

TEST(PointCloud, VerticesAreTheReprojectedPixels) {
  const int width = 21, height = 9;
  std::vector<Disparity> map = random_map(width, height, 11);
  map[4] = {0, Cause::kMatched};  // at infinity: left out
  cv::Mat left(height, width, CV_8UC1);
  for (int i = 0; i < width * height; ++i) {
    left.at<std::uint8_t>(i / width, i % width) = static_cast<std::uint8_t>(i);
  }
  const double f = 500, cx = 10, cy = 4, baseline = 0.12;
  const cv::Matx44d q(1, 0, 0, -cx, 0, 1, 0, -cy, 0, 0, 0, f, 0, 0, 1 / baseline, 0);
  const std::vector<Vertex> vertices = parse_ply(encode_point_cloud_ply({map, width, height}, left, q));
  std::size_t next = 0;
  for (int i = 0; i < width * height; ++i) {
    const Disparity& d = map[static_cast<std::size_t>(i)];
    if (!d.valid() || d.value == 0) {
      continue;
    }
    ASSERT_LT(next, vertices.size());
    const Vertex& v = vertices[next++];
    const double z = f * baseline / (d.value / 16.0);
    EXPECT_NEAR(v.z / z, 1, 1e-6);
    EXPECT_NEAR(v.x, (i % width - cx) * z / f, 1e-5 * z);
    EXPECT_NEAR(v.y, (i / width - cy) * z / f, 1e-5 * z);
    EXPECT_EQ(v.grey, i & 255);
  }
  EXPECT_EQ(next, vertices.size());
}

TEST(PointCloud, AnotherReaderSeesThePoints) {
  if (!test::python_has("meshio")) GTEST_SKIP() << "no python3-meshio";
  const int width = 33, height = 17;
  const std::vector<Disparity> map = random_map(width, height, 13);
  const cv::Matx44d q(1, 0, 0, -16, 0, 1, 0, -8, 0, 0, 0, 500, 0, 0, 1 / 0.12, 0);
  const std::vector<unsigned char> bytes =
      encode_point_cloud_ply({map, width, height}, cv::Mat(height, width, CV_8UC1, cv::Scalar(77)), q);
  const TemporaryFolder folder;
  folder.write("points.ply", {bytes.begin(), bytes.end()});
  std::istringstream printed(test::python(folder, R"(
import meshio
mesh = meshio.read("points.ply")
print(*[mesh.point_data[channel].tolist() == [77] * len(mesh.points) for channel in ("red", "green", "blue")])
for point in mesh.points:
    print(*[float(axis).hex() for axis in point])
)"));
  std::string line;
  std::getline(printed, line);
  EXPECT_EQ(line, "True True True");
  const std::vector<Vertex> vertices = parse_ply(bytes);
  EXPECT_GT(vertices.size(), 50U);
  for (const Vertex& vertex : vertices) {
    std::string x, y, z;
    printed >> x >> y >> z;
    ASSERT_EQ(std::stof(x), vertex.x);
    ASSERT_EQ(std::stof(y), vertex.y);
    ASSERT_EQ(std::stof(z), vertex.z);
  }
  EXPECT_FALSE(printed >> line) << "more points";
}

TEST(PointCloud, OnlyWhatAFloatCanHold) {
  const std::vector<Disparity> map{{16, Cause::kMatched}, {32, Cause::kMatched}};
  const cv::Mat left(1, 2, CV_8UC1, cv::Scalar(0));
  cv::Matx44d q = cv::Matx44d::eye();
  q(2, 3) = 1e39;  // z beyond the largest float
  EXPECT_TRUE(parse_ply(encode_point_cloud_ply({map, 2, 1}, left, q)).empty());
  EXPECT_TRUE(parse_ply(encode_point_cloud_ply({map, 2, 1}, left, cv::Matx44d::zeros())).empty()) << "0 / 0";
}

TEST(PointCloud, NoValidPixelIsAnEmptyCloud) {
  const std::vector<Disparity> map(4);
  EXPECT_TRUE(parse_ply(encode_point_cloud_ply({map, 2, 2}, cv::Mat(2, 2, CV_8UC1, cv::Scalar(0)),
                                               cv::Matx44d::eye()))
                  .empty());
  EXPECT_THROW(encode_point_cloud_ply({map, 2, 2}, cv::Mat(3, 2, CV_8UC1, cv::Scalar(0)), cv::Matx44d::eye()),
               std::invalid_argument);
}

}  // namespace result_writers_test
}  // namespace parallax
