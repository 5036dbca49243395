// SPDX-License-Identifier: Apache-2.0
#include "platform/input/image_input.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "error_line.hpp"
#include "platform/images/image_codecs.hpp"
#include "platform/images/stderr_capture.hpp"
#include "platform/input/image_padding.hpp"
#include "platform/results/output_file.hpp"
#include "platform/scene/scene_hash.hpp"
#include "temporary_folder.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace image_input_test {

namespace fs = std::filesystem;

cv::Mat random_image(int width, int height, int type, int highest, std::uint64_t seed = 1) {
  cv::Mat image(height, width, CV_MAKETYPE(CV_16U, CV_MAT_CN(type)));
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < width * image.channels(); ++i) {
      image.ptr<std::uint16_t>(y)[i] = static_cast<std::uint16_t>(
          scene_hash(seed, static_cast<std::uint64_t>(y * 100000 + i)) % static_cast<unsigned>(highest + 1));
    }
  }
  image.at<std::uint16_t>(0, 0) = static_cast<std::uint16_t>(highest);
  cv::Mat result;
  image.convertTo(result, type);
  return result;
}

cv::Mat grey(int width, int height, std::uint64_t seed = 1) {
  return random_image(width, height, CV_8UC1, 255, seed);
}

void save(const fs::path& path, const cv::Mat& image) {
  fs::create_directories(path.parent_path());
  write_file(path, encode_image(path.extension(), image));
}

void save_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Loads all frames of the pair `left`, `right` and returns the error, checking that nothing else was
/// printed.
std::string load_error(const TemporaryFolder& folder, const std::string& left = "left.png",
                       const std::string& right = "right.png") {
  const StderrCapture capture;
  const std::string line = error_line<UserError>([&] {
    ImageInput({{folder / left, folder / right}}, {}, {});
  });
  EXPECT_EQ(capture.text(), "");
  EXPECT_EQ(line.find('\n'), std::string::npos);
  return line;
}

TEST(ImageInput, LoadsAPairAsItIs) {
  const TemporaryFolder folder;
  const cv::Mat left = grey(40, 30, 1), right = grey(40, 30, 2);
  save(folder / "left.png", left);
  save(folder / "right.png", right);
  std::vector<std::string> notices;
  ImageInput input({{folder / "left.png", folder / "right.png"}}, {},
                   [&](const std::string& n) { notices.push_back(n); });
  EXPECT_EQ(input.frames(), 1u);
  EXPECT_EQ(input.width(), 40);
  EXPECT_EQ(input.height(), 30);
  const StereoImages images = input.load(0);
  EXPECT_EQ(cv::norm(images.left, left, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(images.right, right, cv::NORM_INF), 0);
  EXPECT_TRUE(notices.empty());
}

TEST(ImageInput, MissingFile) {
  const TemporaryFolder folder;
  save(folder / "left.png", grey(8, 8));
  EXPECT_EQ(load_error(folder), "image " + (folder / "right.png") + " does not exist");
  EXPECT_EQ(load_error(folder, "none.png"), "image " + (folder / "none.png") + " does not exist");
  fs::create_directory(folder / "right.png");
  EXPECT_EQ(load_error(folder), (folder / "right.png") + " is a folder, expected an image");
}

TEST(ImageInput, LaterFrameMissingIsSaidBeforeAnyWork) {
  const TemporaryFolder folder;
  save(folder / "left.png", grey(8, 8));
  const fs::path left = folder / "left.png";
  EXPECT_EQ(error_line<UserError>([&] {
              ImageInput({{left, left}, {left, folder / "x.png"}}, {}, {});
            }),
            "image " + (folder / "x.png") + " does not exist");
  EXPECT_EQ(error_line<UserError>([&] { ImageInput({}, {}, {}); }), "there is no image pair to read");
}

TEST(ImageInput, DamagedFiles) {
  const TemporaryFolder folder;
  save(folder / "right.png", grey(200, 200));
  save(folder / "photo.jpg", grey(200, 200));
  const auto expected = [&](const char* name) {
    return "cannot read image " + (folder / name) +
           ": it is damaged, or not a PNG, JPEG, TIFF, BMP, PNM or WebP file";
  };
  save_bytes(folder / "empty.png", "");
  EXPECT_EQ(load_error(folder, "empty.png"), expected("empty.png"));
  save_bytes(folder / "text.png", "no image at all\n");
  EXPECT_EQ(load_error(folder, "text.png"), expected("text.png"));

  const std::string png = bytes_of(folder / "right.png");
  save_bytes(folder / "cut.png", png.substr(0, png.size() / 2));
  EXPECT_EQ(load_error(folder, "cut.png"), expected("cut.png"));
  save_bytes(folder / "header.png", png.substr(0, 20));
  EXPECT_EQ(load_error(folder, "header.png"), expected("header.png"));
  std::string flipped = png;
  flipped[flipped.size() / 2] = static_cast<char>(flipped[flipped.size() / 2] ^ 0x55);
  save_bytes(folder / "flipped.png", flipped);
  EXPECT_EQ(load_error(folder, "flipped.png"), expected("flipped.png"));

  const std::string jpg = bytes_of(folder / "photo.jpg");
  save_bytes(folder / "cut.jpg", jpg.substr(0, jpg.size() / 2));
  EXPECT_EQ(load_error(folder, "cut.jpg", "photo.jpg"), expected("cut.jpg"));
  EXPECT_EQ(load_error(folder, "photo.jpg"), "no error");

  save(folder / "whole.pgm", grey(200, 200));
  const std::string pgm = bytes_of(folder / "whole.pgm");
  save_bytes(folder / "cut.pgm", pgm.substr(0, pgm.size() / 2));
  EXPECT_EQ(load_error(folder, "cut.pgm"), expected("cut.pgm"));
}

TEST(ImageInput, FloatingPointImage) {
  const TemporaryFolder folder;
  save(folder / "left.tiff", cv::Mat(8, 8, CV_32FC1, cv::Scalar(0.5)));
  save(folder / "right.png", grey(8, 8));
  EXPECT_EQ(load_error(folder, "left.tiff"),
            "image " + (folder / "left.tiff") +
                " has floating-point values, expected unsigned integers of 8 or 16 bits");
}

TEST(ImageInput, SizesDiffer) {
  const TemporaryFolder folder;
  save(folder / "left.png", grey(40, 30));
  save(folder / "right.png", grey(41, 30));
  EXPECT_EQ(load_error(folder), "the left image " + (folder / "left.png") + " is 40x30, the right image " +
                                    (folder / "right.png") + " is 41x30; both must have one size");
}

TEST(ImageInput, SizeChangesInTheSequence) {
  const TemporaryFolder folder;
  save(folder / "a.png", grey(40, 30));
  save(folder / "b.png", grey(40, 32));
  const fs::path a = folder / "a.png", b = folder / "b.png";
  ImageInput input({{a, a}, {b, b}}, {}, {});
  EXPECT_EQ(
      error_line<UserError>([&] { input.load(1); }),
      "image " + b.string() + " is 40x32, but the sequence began with 40x30; all frames must have one size");
}

TEST(ImageInput, TooLarge) {
  const TemporaryFolder folder;
  save(folder / "left.png", cv::Mat(4, 1857, CV_8UC1, cv::Scalar(1)));
  save(folder / "right.png", cv::Mat(4, 1857, CV_8UC1, cv::Scalar(1)));
  EXPECT_EQ(load_error(folder),
            "image " + (folder / "left.png") + " is 1857x4, larger than the largest size 1856x1856");
  EXPECT_EQ(error_line<UserError>([&] {
              ImageInput({{folder / "left.png", folder / "right.png"}}, {{1857, 4}, {}, false}, {});
            }),
            "no error");
}

TEST(ImageInput, ColourBecomesMonoAndIsSaidOnce) {
  const TemporaryFolder folder;
  const cv::Mat colour = random_image(40, 30, CV_8UC3, 255);
  const cv::Mat clear = random_image(40, 30, CV_8UC4, 255);
  save(folder / "left.png", colour);
  save(folder / "right.png", clear);
  std::vector<std::string> notices;
  const ImagePair pair{folder / "left.png", folder / "right.png"};
  ImageInput input({pair, pair}, {}, [&](const std::string& n) { notices.push_back(n); });
  input.load(1);
  const StereoImages images = input.load(0);
  EXPECT_EQ(notices, (std::vector<std::string>{
                         "colour images (left.png) are converted to mono: 0.299 R + 0.587 G + 0.114 B"}));
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) {
      const auto p = colour.at<cv::Vec3b>(y, x);
      ASSERT_NEAR(images.left.at<std::uint8_t>(y, x), 0.114 * p[0] + 0.587 * p[1] + 0.299 * p[2], 0.51);
      const auto q = clear.at<cv::Vec4b>(y, x);
      ASSERT_NEAR(images.right.at<std::uint8_t>(y, x), 0.114 * q[0] + 0.587 * q[1] + 0.299 * q[2], 0.51);
    }
  }
}

/// The left images of a sequence whose right ones are upside down, as 8 bits, and what was said.
struct Taken {
  std::vector<cv::Mat> frames;
  std::vector<std::string> notices;
};

Taken take(const TemporaryFolder& folder, const std::vector<cv::Mat>& images, std::optional<int> bits = {}) {
  std::vector<ImagePair> pairs;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const fs::path path = folder / (std::to_string(i) + ".png");
    const fs::path other = folder / (std::to_string(i) + "_right.png");
    cv::Mat right;
    cv::flip(images[i], right, 0);
    save(path, images[i]);
    save(other, right);
    pairs.push_back({path, other});
  }
  Taken taken;
  ImageInput input(pairs, {{}, bits, false}, [&](const std::string& n) { taken.notices.push_back(n); });
  for (std::size_t i = 0; i < images.size(); ++i) taken.frames.push_back(input.load(i).left);
  return taken;
}

void expect_divided(const cv::Mat& found, const cv::Mat& image, int divisor) {
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      ASSERT_EQ(found.at<std::uint8_t>(y, x), image.at<std::uint16_t>(y, x) / divisor) << x << ',' << y;
    }
  }
}

TEST(ImageInput, SixteenBitsHoldAsManyAsTheLargestValueAsksFor) {
  struct Case {
    int largest, divisor;
    const char* taken;
  };
  const Case cases[] = {{255, 1, "8-bit as they are"},
                        {256, 4, "10-bit and the lower 2 bits are dropped"},
                        {1023, 4, "10-bit and the lower 2 bits are dropped"},
                        {4095, 16, "12-bit and the lower 4 bits are dropped"},
                        {4096, 64, "14-bit and the lower 6 bits are dropped"},
                        {16384, 256, "16-bit and the lower 8 bits are dropped"},
                        {65535, 256, "16-bit and the lower 8 bits are dropped"}};
  for (const Case& c : cases) {
    const TemporaryFolder folder;
    const cv::Mat image = random_image(20, 10, CV_16UC1, c.largest);
    const Taken taken = take(folder, {image});
    expect_divided(taken.frames.at(0), image, c.divisor);
    EXPECT_EQ(taken.notices, (std::vector<std::string>{"16-bit images: their values reach " +
                                                       std::to_string(c.largest) + ", so they are taken as " +
                                                       c.taken + "; --image-bits states another"}));
  }
}

TEST(ImageInput, ASequenceThatBeginsDarkIsTakenAsAWhole) {
  const TemporaryFolder folder;
  const cv::Mat dark = random_image(20, 10, CV_16UC1, 200), bright = random_image(20, 10, CV_16UC1, 60000);
  const Taken taken = take(folder, {dark, dark, bright});
  expect_divided(taken.frames.at(0), dark, 256);
  expect_divided(taken.frames.at(2), bright, 256);
  EXPECT_EQ(taken.notices.size(), 1u);
}

TEST(ImageInput, ASequenceThatBeginsWithEightBits) {
  const TemporaryFolder folder;
  const cv::Mat first = grey(20, 10), later = random_image(20, 10, CV_16UC1, 4000);
  const Taken taken = take(folder, {first, later});
  EXPECT_EQ(cv::norm(taken.frames.at(0), first, cv::NORM_INF), 0);
  expect_divided(taken.frames.at(1), later, 16);
}

TEST(ImageInput, AFrameThatCannotBeReadStopsNoneBeforeIt) {
  const TemporaryFolder folder;
  save(folder / "a.png", random_image(20, 10, CV_16UC1, 4000));
  save_bytes(folder / "b.png", "no image");
  const fs::path a = folder / "a.png", b = folder / "b.png";
  ImageInput input({{a, a}, {b, b}}, {}, {});
  EXPECT_EQ(input.load(0).left.cols, 20);
  EXPECT_NE(error_line<UserError>([&] { input.load(1); }).find("cannot read image"), std::string::npos);
}

TEST(ImageInput, StatedBits) {
  const TemporaryFolder folder;
  const cv::Mat image = random_image(20, 10, CV_16UC1, 900);
  const Taken taken = take(folder, {image, image}, 12);
  expect_divided(taken.frames.at(0), image, 16);
  EXPECT_TRUE(taken.notices.empty());
  EXPECT_EQ(error_line<UserError>([&] { take(folder, {cv::Mat(8, 8, CV_16UC1, cv::Scalar(1024))}, 10); }),
            "image " + (folder / "0.png") +
                " holds the value 1024, beyond the 10 bits of --image-bits (at most 1023)");
}

TEST(ImageInput, TheSamePictureTwiceIsSaid) {
  const TemporaryFolder folder;
  save(folder / "a.png", grey(20, 10));
  save(folder / "b.bmp", grey(20, 10));
  save(folder / "c.png", cv::Mat(10, 20, CV_8UC1, cv::Scalar(7)));
  const auto said = [&](const std::string& left, const std::string& right) {
    std::vector<std::string> notices;
    ImageInput({{folder / left, folder / right}}, {}, [&](const std::string& n) { notices.push_back(n); });
    return notices;
  };
  EXPECT_EQ(said("a.png", "b.bmp"),
            (std::vector<std::string>{"the left image " + (folder / "a.png") + " and the right image " +
                                      (folder / "b.bmp") + " are the same picture"}));
  EXPECT_TRUE(said("c.png", "c.png").empty()) << "of one value";
  EXPECT_TRUE(said("a.png", "c.png").empty());
}

TEST(ImageInput, SixteenBitsBesideEight) {
  const TemporaryFolder folder;
  const cv::Mat left = random_image(20, 10, CV_16UC1, 65535), right = grey(20, 10);
  save(folder / "l.png", left);
  save(folder / "r.png", right);
  ImageInput input({{folder / "l.png", folder / "r.png"}}, {}, {});
  expect_divided(input.load(0).left, left, 256);
  EXPECT_EQ(cv::norm(input.load(0).right, right, cv::NORM_INF), 0);
}

TEST(ImagePairs, NeitherFolderNorFile) {
  const TemporaryFolder links;
  std::filesystem::create_symlink("circle", links.path() / "circle");
  EXPECT_NE(error_line<UserError>([&] {
              find_image_pairs(links.path() / "circle");
            }).find("does not exist; expected a folder or a list of image pairs"),
            std::string::npos);
  EXPECT_EQ(error_line<UserError>([] { find_image_pairs("/no/such/place"); }),
            "/no/such/place does not exist; expected a folder or a list of image pairs");
}

TEST(ImagePairs, ListFile) {
  const TemporaryFolder folder;
  for (const char* name : {"a.png", "b.png", "c d.png"}) {
    save_bytes(folder / name, "x");
  }
  save_bytes(folder / "list.txt", "# left right\n\na.png b.png\r\n  b.png\t\"c d.png\"  # the last\n" +
                                      (folder / "a.png") + " a.png");
  const std::vector<ImagePair> pairs = find_image_pairs(folder / "list.txt");
  ASSERT_EQ(pairs.size(), 3u);
  EXPECT_EQ(pairs[0].left, folder / "a.png");
  EXPECT_EQ(pairs[0].right, folder / "b.png");
  EXPECT_EQ(pairs[1].right, folder / "c d.png");
  EXPECT_EQ(pairs[2].left, folder / "a.png");
}

TEST(ImagePairs, ListErrors) {
  const TemporaryFolder folder;
  save_bytes(folder / "a.png", "x");
  const std::string list = (folder / "list.txt");
  const auto error = [&](const std::string& text) {
    save_bytes(list, text);
    return error_line<UserError>([&] { find_image_pairs(list); });
  };
  EXPECT_EQ(error("a.png a.png\na.png\n"), list + ":2: 1 path in this line, expected two: left right");
  EXPECT_EQ(error("a.png a.png a.png"), list + ":1: 3 paths in this line, expected two: left right");
  EXPECT_EQ(error("\na.png b.png"), list + ":2: " + (folder / "b.png") + " does not exist");
  EXPECT_EQ(error("# nothing\n"),
            "the list of pairs " + list + " is empty; expected two paths a line: left right");
}

TEST(ImagePadding, PadsByRepetitionAndCropsBack) {
  const StereoImages images{grey(45, 33, 1), grey(45, 33, 2)};
  const StereoImages padded = pad_images(images, ImageConfig{}.granularity());
  ASSERT_EQ(padded.left.size(), cv::Size(64, 48));
  ASSERT_EQ(padded.right.size(), cv::Size(64, 48));
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      ASSERT_EQ(padded.left.at<std::uint8_t>(y, x),
                images.left.at<std::uint8_t>(std::min(y, 32), std::min(x, 44)));
    }
  }
  EXPECT_EQ(cv::norm(crop_image(padded.right, {45, 33}), images.right, cv::NORM_INF), 0);
  EXPECT_EQ(pad_images(padded, ImageConfig{}.granularity()).left.data, padded.left.data)
      << "nothing to do, nothing copied";

  std::vector<Disparity> map(64 * 48);
  for (std::size_t i = 0; i < map.size(); ++i) {
    map[i].value = static_cast<std::uint16_t>(i);
  }
  const std::vector<Disparity> cropped = crop_disparities(map, 64, {45, 33});
  ASSERT_EQ(cropped.size(), 45u * 33u);
  EXPECT_EQ(cropped[45 * 32 + 44].value, 64 * 32 + 44);
}

TEST(ImagePadding, Notice) {
  EXPECT_EQ(padding_notice({640, 480}, ImageConfig{}.granularity()), "");
  EXPECT_EQ(padding_notice({450, 375}, ImageConfig{}.granularity()),
            "image size 450x375 is not a multiple of 32x16: processed as 480x384 by repeating the last "
            "column and row, "
            "results are cropped back");
}

}  // namespace image_input_test
}  // namespace parallax
