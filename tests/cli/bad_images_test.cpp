// SPDX-License-Identifier: Apache-2.0
// Whatever is wrong with images, truths and sequences: one line on standard error, exit code 2, nothing on
// standard output, and nothing left behind.
#include <gtest/gtest.h>

#include "tests/cli/bad_input.hpp"

namespace parallax {
namespace bad_images_test {

namespace fs = std::filesystem;
using test::BadInput;
using test::noise;

TEST_F(BadInput, MissingOrUnreadableImage) {
  text("text.png", "hello");
  text("empty.png", "");
  fs::create_directory(program_ / "folder.png");
  fs::copy_file(program_ / "left.png", program_ / "half.png");
  truncate("half.png", 1500);
  EXPECT_EQ(error("--left none.png --right right.png"), "image none.png does not exist");
  EXPECT_EQ(error("--left left.png --right none.png"), "image none.png does not exist");
  EXPECT_EQ(error("--left left.png --right folder.png"), "folder.png is a folder, expected an image");
  for (const std::string name : {"text.png", "empty.png", "half.png"}) {
    EXPECT_EQ(
        error("--left left.png --right " + name),
        "cannot read image " + name + ": it is damaged, or not a PNG, JPEG, TIFF, BMP, PNM or WebP file");
  }
}

TEST_F(BadInput, ImagesOfOtherSizes) {
  image("small.png", noise(32, 48));
  image("wide.png", noise(1953, 4));
  image("high.png", noise(4, 1857));
  EXPECT_EQ(error("--left left.png --right small.png"),
            "the left image left.png is 64x48, the right image small.png is 32x48; both must have one size");
  EXPECT_EQ(error("--left wide.png --right wide.png"),
            "image wide.png is 1953x4, larger than the largest size 1952x1856");
  EXPECT_EQ(error("--left high.png --right high.png"),
            "image high.png is 4x1857, larger than the largest size 1952x1856");
  EXPECT_EQ(
      error("--size 1953x16"),
      "images of 1984 columns do not fit: 2 tiles of 1024 columns (tiles.largest_number, tiles.limit) that "
      "overlap by 32 + 32 + disparity offset 0 + range 32 hold 1952");
  EXPECT_EQ(error("--size 16x1857"),
            "the built-in scene would be 16x1857, larger than the largest size 1952x1856 (image.max_width, "
            "image.max_height)");
  EXPECT_EQ(error("--size 65x16 --set image.max_width=64"),
            "the built-in scene would be 65x16, larger than the largest size 64x1856 (image.max_width, "
            "image.max_height)");
  EXPECT_EQ(pair_error("--set image.width=32"),
            "image.width = 32, but left.png has 64 px; 0 takes it from the images");
  // Refused by its header: there is nothing more in the file.
  std::string bytes = program_.read("left.png");
  bytes[18] = bytes[22] = 78;
  bytes[19] = bytes[23] = 32;
  text("huge.png", bytes);
  EXPECT_EQ(error("--left huge.png --right huge.png"),
            "image huge.png is 20000x20000, larger than the largest size 1952x1856");
  EXPECT_EQ(pair_error("--ground-truth huge.png"),
            "huge.png: the ground truth is 20000x20000, the images are 64x48");
}

TEST_F(BadInput, BitsOfImages) {
  EXPECT_EQ(pair_error("--image-bits 7"), "--image-bits is 7, allowed is 8 to 16");
  EXPECT_EQ(pair_error("--image-bits 17"), "--image-bits is 17, allowed is 8 to 16");
  EXPECT_EQ(error("--image-bits 12"), "--image-bits is for 16-bit images, but none are given");
  EXPECT_EQ(pair_error("--image-bits 12"),
            "--image-bits is for 16-bit images, but left.png and its partner have 8 bits");
  EXPECT_EQ(pair_error("--timing-only --image-bits 12"),
            "--timing-only computes no images: it cannot go with --image-bits");
  image("bright.png", cv::Mat(48, 64, CV_16UC1, cv::Scalar(5000)));
  EXPECT_EQ(error("--left bright.png --right bright.png --image-bits 12"),
            "image bright.png holds the value 5000, beyond the 12 bits of --image-bits (at most 4095)");
}

TEST_F(BadInput, GroundTruth) {
  image("other.png", cv::Mat(48, 32, CV_16UC1, cv::Scalar(256)));
  image("truth.png", cv::Mat(48, 64, CV_16UC1, cv::Scalar(256)));
  cv::Mat colour = noise(64, 48, CV_8UC3);
  image("colour.png", colour);
  image("truth.tiff", cv::Mat(48, 64, CV_32FC1, cv::Scalar(5)));
  image("mask.png", cv::Mat(48, 32, CV_8UC1, cv::Scalar(255)));
  EXPECT_NE(pair_error("--ground-truth none.png").find("none.png"), std::string::npos);
  EXPECT_NE(pair_error("--ground-truth other.png").find("32x48"), std::string::npos);
  EXPECT_NE(pair_error("--ground-truth colour.png").find("3 channels"), std::string::npos);
  EXPECT_EQ(pair_error("--ground-truth truth.png --ground-truth-scale 0"),
            "--ground-truth-scale is 0, allowed is a number above 0");
  EXPECT_EQ(pair_error("--ground-truth-scale 4"), "--ground-truth-scale needs --ground-truth");
  EXPECT_EQ(pair_error("--ground-truth-encoding sintel"), "--ground-truth-encoding needs --ground-truth");
  EXPECT_EQ(pair_error("--ground-truth colour.png --ground-truth-encoding packed"),
            "--ground-truth-encoding is 'packed', expected values or sintel");
  EXPECT_EQ(pair_error("--ground-truth colour.png --ground-truth-encoding sintel --ground-truth-scale 4"),
            "--ground-truth-encoding sintel and --ground-truth-scale exclude each other: Sintel's are in "
            "pixels");
  // A damaged header.
  for (const auto& [name, at] : {std::pair("truth.png", 24), {"mask.png", 24}}) {
    std::string bytes = program_.read(name);
    bytes[static_cast<std::size_t>(at)] = 77;
    text("damaged_" + std::string(name), bytes);
  }
  EXPECT_EQ(
      pair_error("--ground-truth damaged_truth.png").rfind("cannot read ground truth damaged_truth.png: ", 0),
      0U);
  text("damaged_truth.tiff", program_.read("truth.tiff").substr(0, 2000));
  EXPECT_EQ(pair_error("--ground-truth damaged_truth.tiff")
                .rfind("cannot read ground truth damaged_truth.tiff: ", 0),
            0U);
  EXPECT_EQ(pair_error("--ground-truth truth.png --mask damaged_mask.png").rfind("damaged_mask.png: ", 0),
            0U);
  EXPECT_NE(pair_error("--ground-truth truth.png --mask mask.png").find("mask.png"), std::string::npos);
  EXPECT_EQ(pair_error("--mask mask.png"), "--mask needs --ground-truth");
  image("unknown.png", cv::Mat(48, 64, CV_16UC1, cv::Scalar(0)));
  image("black.png", cv::Mat(48, 64, CV_8UC1, cv::Scalar(0)));
  EXPECT_EQ(pair_error("--ground-truth unknown.png"),
            "unknown.png: no pixel to score; every disparity is unknown");
  EXPECT_EQ(pair_error("--ground-truth truth.png --mask black.png"),
            "black.png: marks no pixel: 255 says score, its largest value is 0");
  text("twice.txt", "left.png right.png\nleft.png right.png\n");
  EXPECT_EQ(error("--input twice.txt --ground-truth truth.png"),
            "--ground-truth is for one pair, but the input has 2 frames; add --frames 1");
  EXPECT_EQ(error("--ground-truth truth.png"),
            "--ground-truth and --mask go with --left and --right; the built-in scene brings its own");
}

TEST_F(BadInput, Sequences) {
  fs::create_directory(program_ / "nothing");
  text("empty.txt", "\n# nothing\n");
  text("one.txt", "left.png\n");
  text("gone.txt", "left.png right.png\nleft.png none.png\n");
  fs::create_directory(program_ / "odd");
  fs::copy_file(program_ / "left.png", program_ / "odd/left_0.png");
  EXPECT_EQ(error("--input none"), "none does not exist; expected a folder or a list of image pairs");
  EXPECT_EQ(error("--input nothing").rfind("nothing holds no stereo pair", 0), 0U);
  EXPECT_EQ(error("--input odd"), "odd: the left image left_0.png has no partner right_0.png");
  EXPECT_EQ(error("--input empty.txt").rfind("the list of pairs empty.txt is empty", 0), 0U);
  EXPECT_EQ(error("--input one.txt"), "one.txt:1: 1 path in this line, expected two: left right");
  EXPECT_EQ(error("--input gone.txt"), "gone.txt:2: none.png does not exist");
  EXPECT_NE(error("--input left.png"), "");
}

TEST_F(BadInput, AFrameThatBreaksLeavesThoseBeforeItComplete) {
  fs::create_directory(program_ / "in");
  for (int i = 0; i < 6; ++i) {
    for (const char* side : {"left", "right"}) {
      image("in/" + std::string(side) + "_" + std::to_string(i) + ".png", noise(64, 48));
    }
  }
  truncate("in/right_4.png", 1500);
  const test::Outcome outcome = program_("run --disparities 32 --input in --out out");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("parallax: error: cannot read image in/right_4.png: "), std::string::npos);
  const test::Outcome whole = program_("run --disparities 32 --input in --frames 4 --out whole");
  ASSERT_EQ(whole.code, 0) << whole.err;
  for (const char* file : {"profile.json", "strip.gif", "timing.json"}) fs::remove(program_ / "whole" / file);
  EXPECT_EQ(program_.files("out"), program_.files("whole"));
  for (const std::string& name : program_.files("whole")) {
    if (name.back() != '/') {
      EXPECT_EQ(program_.read("out/" + name), program_.read("whole/" + name)) << name;
    }
  }
}

TEST_F(BadInput, AFrameOfAnotherSizeIsABrokenFrame) {
  fs::create_directory(program_ / "in");
  for (const char* side : {"left", "right"}) {
    image("in/" + std::string(side) + "_0.png", noise(64, 48));
    image("in/" + std::string(side) + "_1.png", noise(32, 48));
  }
  const test::Outcome outcome = program_("run --disparities 32 --input in --out out");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("parallax: error: image in/left_1.png is 32x48, but the sequence began with "
                             "64x48; all frames must have one size\n"),
            std::string::npos);
  EXPECT_EQ(program_.files("out").size(), 8U) << "a folder and seven files: no calibration, no point cloud";
}

TEST_F(BadInput, WhatIsUnusualButFineIsSaidOnce) {
  fs::create_directory(program_ / "in");
  for (const char* name : {"left_0.png", "left_1.png", "right_0.png", "right_1.png"}) {
    cv::Mat pixels = noise(75, 50, CV_8UC3);
    if (name[0] == 'r') pixels = cv::Scalar::all(255) - pixels;
    image(std::string("in/") + name, pixels);
  }
  const test::Outcome colour = program_("run --disparities 32 --input in --out out");
  EXPECT_EQ(colour.code, 0) << colour.err;
  const auto notes = test::lines(colour.err);
  ASSERT_EQ(notes.size(), 2U) << colour.err;
  EXPECT_NE(notes[0].find("colour"), std::string::npos) << notes[0];
  EXPECT_NE(notes[1].find("75x50"), std::string::npos) << notes[1];
  for (const auto& [name, factor] : {std::pair("deep_l.png", 16), {"deep_r.png", 15}}) {
    cv::Mat deep;
    noise(64, 48).convertTo(deep, CV_16U, factor);
    image(name, deep);
  }
  const test::Outcome deep = program_("run --disparities 32 --left deep_l.png --right deep_r.png");
  EXPECT_EQ(deep.code, 0) << deep.err;
  ASSERT_EQ(test::lines(deep.err).size(), 1U) << deep.err;
  EXPECT_EQ(deep.err.rfind("parallax: note: 16-bit images: ", 0), 0U) << deep.err;
}

}  // namespace bad_images_test
}  // namespace parallax
