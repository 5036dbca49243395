// SPDX-License-Identifier: Apache-2.0
#include "platform/images/image_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <opencv2/core.hpp>

#include "platform/images/image_codecs.hpp"
#include "platform/images/image_header.hpp"
#include "platform/images/stderr_capture.hpp"
#include "platform/results/output_file.hpp"
#include "tests/platform/error_of.hpp"
#include "tests/platform/temporary_folder.hpp"
#include "tests/platform/unprivileged.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace image_file_test {

constexpr const char* kExtensions[] = {".png", ".jpg", ".tiff", ".bmp", ".pgm", ".ppm", ".webp"};

cv::Mat picture(int width, int height, int type = CV_8UC1) {
  cv::Mat image(height, width, type);
  cv::theRNG().state = 1;
  cv::randu(image, 0, 256);
  return image;
}

std::string bytes_of(const std::string& extension, const cv::Mat& image) {
  const std::vector<std::uint8_t> bytes = encode_image(extension, image);
  return {bytes.begin(), bytes.end()};
}

TEST(ImageHeader, SizeWithoutUnpacking) {
  const TemporaryFolder folder;
  for (const char* extension : kExtensions) {
    const std::string path = folder / ("a" + std::string(extension));
    const bool colour = extension == std::string(".ppm");
    write_file(path, encode_image(extension, picture(37, 21, colour ? CV_8UC3 : CV_8UC1)));
    EXPECT_EQ(image_size_of_header(path), cv::Size(37, 21)) << extension;
  }
  const auto size = [&](const std::string& bytes) { return image_size_of_header(folder.write("a", bytes)); };
  EXPECT_EQ(size("P5\n# a comment\n 640 # another\n480\n255\n"), cv::Size(640, 480));
  EXPECT_EQ(size("P7\nWIDTH 640\nHEIGHT 480\nDEPTH 1\nMAXVAL 255\nENDHDR\n"), cv::Size(640, 480));
  using namespace std::string_literals;
  // The directory of a TIFF of the other byte order: width 640 as a short, height 480 as a long.
  EXPECT_EQ(
      size("MM\0*\0\0\0\x08\0\x02\x01\0\0\x03\0\0\0\x01\x02\x80\0\0\x01\x01\0\x04\0\0\0\x01\0\0\x01\xE0"s),
      cv::Size(640, 480));
  // A BigTIFF.
  EXPECT_EQ(size("II+\0\x08\0\0\0\x10\0\0\0\0\0\0\0\x02\0\0\0\0\0\0\0"
                 "\0\x01\x03\0\x01\0\0\0\0\0\0\0\x80\x02\0\0\0\0\0\0"
                 "\x01\x01\x04\0\x01\0\0\0\0\0\0\0\xE0\x01\0\0\0\0\0\0"s),
            cv::Size(640, 480));
  for (const std::string& none :
       {""s, "P5\n"s, "P5\n0 480\n255\n"s, "P5\nx 480\n"s, "\x89PNG\r\n\x1A\n"s, "\xFF\xD8\xFF\xE0"s,
        "II*\0"s, "BM"s, "GIF89a"s, "RIFF....WEBPVP8 "s, "P5\n99999999999 1\n"s}) {
    EXPECT_FALSE(size(none)) << none;
  }
}

/// A PNG whose header says this size, and which holds nothing.
std::string png_of(std::uint32_t width, std::uint32_t height) {
  std::string bytes = bytes_of(".png", picture(8, 8));
  for (int i = 0; i < 4; ++i) {
    bytes[static_cast<std::size_t>(16 + i)] = static_cast<char>(width >> (24 - 8 * i));
    bytes[static_cast<std::size_t>(20 + i)] = static_cast<char>(height >> (24 - 8 * i));
  }
  return bytes;
}

TEST(ImageFile, TheSizeIsJudgedBeforeAnythingIsUnpacked) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.png", png_of(20000, 20000));
  EXPECT_EQ(error_of([&] {
              read_image_file(path, "image", [](const cv::Size& size) {
                EXPECT_EQ(size, cv::Size(20000, 20000));
                throw UserError("too large");
              });
            }),
            "too large");
}

TEST(ImageFile, TheLargestImageOfAll) {
  const auto error = [](const cv::Size& size) {
    return error_of([&] { at_most_any_image("a.png", "result")(size); });
  };
  EXPECT_EQ(error({16384, 16384}), "(no error)");
  EXPECT_EQ(error({20000, 20000}),
            "result a.png is 20000x20000, larger than the largest size of 268435456 px");
}

TEST(ImageFile, WhatIsNoImageFile) {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& name) {
    const std::string line =
        error_of([&] { read_image_file(folder / name, "image", [](const cv::Size&) {}); });
    return line;
  };
  EXPECT_EQ(error("none"), "image " + (folder / "none") + " does not exist");
  EXPECT_EQ(error(""), folder.path().string() + "/ is a folder, expected an image");
  ::mkfifo((folder / "pipe").c_str(), 0600);
  EXPECT_EQ(error("pipe"), folder / "pipe" + " is no file, expected an image");
  folder.write("locked", "x");
  ::chmod((folder / "locked").c_str(), 0);
  ::chmod(folder.path().c_str(), 0755);
  {
    const Unprivileged unprivileged;
    EXPECT_EQ(error("locked"), "cannot read image " + (folder / "locked") + ": Permission denied");
  }
  std::filesystem::create_symlink("circle", folder.path() / "circle");
  EXPECT_EQ(error("circle"),
            "cannot read image " + (folder / "circle") + ": Too many levels of symbolic links");
  folder.write("header.png", png_of(16, 16));
  EXPECT_EQ(error("header.png"), "cannot read image " + (folder / "header.png") +
                                     ": it is damaged, or not a PNG, JPEG, TIFF, BMP, PNM or WebP file");
}

TEST(ImageFile, ADamagedFileIsSaidToBeOneOrHasItsSize) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& extension, const std::string& bytes) {
    const std::string path = folder.write("a" + extension, bytes);
    const StderrCapture capture;
    bool whole = false;
    const std::string line = error_of([&] {
      const cv::Mat image = read_image_file(path, "image", [](const cv::Size& size) {
        if (size.area() > 1 << 20) throw UserError("large");
      });
      whole = true;
      EXPECT_GT(image.total(), 0u);
    });
    EXPECT_EQ(capture.text(), "") << extension;
    EXPECT_EQ(line.find('\n'), std::string::npos);
    EXPECT_NE(whole, line != "(no error)");
    return whole;
  };
  for (const std::string extension : kExtensions) {
    SCOPED_TRACE(extension);
    const std::string whole = bytes_of(extension, picture(64, 48, extension == ".ppm" ? CV_8UC3 : CV_8UC1));
    EXPECT_TRUE(read(extension, whole));
    for (const std::size_t part : {0, 1, 4, 9, 20, 40, 60, 90}) {
      EXPECT_FALSE(read(extension, whole.substr(0, whole.size() * part / 100))) << part << " %";
    }
    for (std::size_t at = 0; at < 64; ++at) {
      std::string damaged = whole;
      damaged[at] = static_cast<char>(damaged[at] ^ 0x5A);
      read(extension, damaged);
    }
  }
}

}  // namespace image_file_test
}  // namespace parallax
