// SPDX-License-Identifier: Apache-2.0
// Whatever is wrong with the input: one line on standard error, exit code 2, nothing on standard output, and
// nothing left behind.
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/stat.h>

#include <opencv2/core.hpp>

#include "platform/images/image_codecs.hpp"
#include "platform/results/output_file.hpp"
#include "tests/cli/program.hpp"
#include "tests/paths.hpp"
#include "tests/platform/unprivileged.hpp"

namespace parallax {
namespace bad_input_test {

namespace fs = std::filesystem;

cv::Mat noise(int width, int height, int type = CV_8UC1) {
  cv::Mat image(height, width, type);
  cv::theRNG().state = 1;
  cv::randu(image, 0, 256);
  return image;
}

class BadInput : public ::testing::Test {
 protected:
  void SetUp() override {
    image("left.png", noise(64, 48));
    image("right.png", noise(64, 48));
  }

  void image(const std::string& name, const cv::Mat& pixels) const {
    write_file(program_ / name, encode_image(fs::path(name).extension(), pixels));
  }
  void text(const std::string& name, const std::string& content) const {
    program_.folder().write(name, content);
  }
  void truncate(const std::string& name, std::uintmax_t size) const {
    fs::resize_file(program_ / name, size);
  }

  /// The one error line of a run into the new folder "out"; also checks all that a fault must not do.
  std::string error(const std::string& arguments, const std::function<void()>& prepare = {}) const {
    const auto before = program_.files();
    const test::Outcome outcome = program_("run --disparities 32 --out out " + arguments, prepare);
    EXPECT_EQ(outcome.code, 2) << arguments << '\n' << outcome.err;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_EQ(program_.files(), before) << arguments;
    const std::string prefix = "parallax: error: ";
    std::vector<std::string> errors;
    for (const std::string& line : test::lines(outcome.err)) {
      if (line.rfind(prefix, 0) == 0) {
        errors.push_back(line.substr(prefix.size()));
      } else {
        EXPECT_EQ(line.rfind("parallax: note: ", 0), 0U) << line;
      }
    }
    EXPECT_EQ(errors.size(), 1U) << outcome.err;
    return errors.empty() ? "" : errors.front();
  }
  std::string pair_error(const std::string& arguments) const {
    return error("--left left.png --right right.png " + arguments);
  }

  test::Program program_;
};

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

TEST_F(BadInput, Configuration) {
  EXPECT_EQ(pair_error("--set matching.p3=1").rfind("--set matching.p3=1: unknown key matching.p3", 0), 0U);
  EXPECT_NE(pair_error("--set matching.p3=1").find("matching.p"), std::string::npos);
  EXPECT_NE(pair_error("--set matching.p1=256").find("256"), std::string::npos);
  EXPECT_NE(pair_error("--set matching.p1=42").find("matching.p1"), std::string::npos);
  EXPECT_NE(pair_error("--set matching.disparity_offset=250").find("matching.disparity_offset"),
            std::string::npos);
  EXPECT_EQ(pair_error("--disparities 100"),
            "--disparities 100: must be a positive multiple of matching.parallelism = 32; the nearest are 96 "
            "and 128");
  EXPECT_EQ(pair_error("--set camera.frame_rate=1e-9")
                .rfind("camera.frame_rate = 1e-09: must be 0 or at least 0.001 frames/s", 0),
            0U);
  EXPECT_EQ(pair_error("--set camera.skew_ns=2000000"),
            "camera.skew_ns = 2000000: must be at most camera.skew_limit_ns = 1000000, or no two images are "
            "one frame "
            "(camera.skew_ns: --set camera.skew_ns=2000000)");
  EXPECT_EQ(pair_error("--set camera.early_start_rows=5 --set camera.fault=missing_row"),
            "camera.early_start_rows = 5: must be 0 with a camera.fault, which shows when the core has begun "
            "the frame "
            "(camera.early_start_rows: --set camera.early_start_rows=5, camera.fault: --set "
            "camera.fault=missing_row)");
  EXPECT_EQ(pair_error("--set camera.jitter_ns=5"),
            "camera.jitter_ns = 5: needs a camera.frame_rate above 0, exposures have no dates to miss "
            "(camera.jitter_ns: --set camera.jitter_ns=5)");
  EXPECT_EQ(
      pair_error("--set camera.jitter_ns=10000000 --set camera.frame_rate=100"),
      "camera.jitter_ns = 10000000: must be below the period of camera.frame_rate, 10000000 ns "
      "(camera.frame_rate: --set camera.frame_rate=100, camera.jitter_ns: --set camera.jitter_ns=10000000)");
  // 48 rows of 64 pixels and 32 of blanking, and 2048 after the frame.
  EXPECT_EQ(
      error("--size 64x48 --set clocks.camera_hz=1e6 --set camera.frame_rate=151"),
      "camera.frame_rate = 151: reading out 64x48 px takes 6656 pixel clocks, which allows at most 150.24 "
      "frames/s");
  EXPECT_NE(pair_error("--preset scenescan-por").find("scenescan-pro"), std::string::npos);
}

TEST_F(BadInput, OptionsThatContradict) {
  EXPECT_EQ(error("--left left.png"), "--right is missing: a pair needs --left and --right");
  EXPECT_EQ(error("--right right.png"), "--left is missing: a pair needs --left and --right");
  EXPECT_EQ(pair_error("--input ."), "--input and --left/--right exclude each other");
  EXPECT_EQ(pair_error("--map a.map --calibration c.yml"),
            "--map and --calibration exclude each other: both say how to rectify");
  EXPECT_EQ(pair_error("--fit"), "--fit needs --calibration");
  EXPECT_EQ(pair_error("--size 64x48"),
            "--size and --rectified are for the built-in scene, but images are given");
  EXPECT_EQ(pair_error("--seed 5"), "--seed is for the built-in scene, but images are given");
  EXPECT_EQ(pair_error("--frames -1"), "--frames is -1, allowed is 1 to 1000000000");
  EXPECT_EQ(pair_error("--frames 0"), "--frames is 0, allowed is 1 to 1000000000");
  EXPECT_EQ(pair_error("--timing-frames 0"), "--timing-frames is 0, allowed is 1 to 1000000000");
  EXPECT_EQ(error("--size 64"), "--size: '64' is not a size such as 640x480");
  EXPECT_EQ(error("--leftt left.png"), "unknown option --leftt; the nearest is --left");
  EXPECT_EQ(error("left.png"), "unexpected argument 'left.png'");
  EXPECT_EQ(error("--size 64x48 --set image.width=64"),
            "--size and image.width or image.height exclude each other: both say how large the scene is");
  EXPECT_EQ(error("--size 64x48 --seed -1"), "--seed: '-1' is not a whole number of at most 18 digits");
  EXPECT_EQ(error("--size 64x48 --seed 99999999999999999999"),
            "--seed: '99999999999999999999' is not a whole number of at most 18 digits");
  EXPECT_NE(error("--frames many"), "");
  EXPECT_NE(error("--left"), "");
  EXPECT_EQ(error("--left '' --right ''"), "--left: the value is empty");
  EXPECT_EQ(error("--size 64x48 --out ''"), "--out: the value is empty");
  EXPECT_NE(error("--frames 99999999999999999999").find("allowed is 1 to 1000000000"), std::string::npos);
}

TEST_F(BadInput, TimingOnlyHasNoImages) {
  for (const std::string option : {"--ground-truth truth.png", "--no-point-cloud"}) {
    EXPECT_EQ(pair_error("--timing-only " + option),
              "--timing-only computes no images: it cannot go with " + option.substr(0, option.find(' ')));
  }
  EXPECT_EQ(pair_error("--timing-only --mask mask.png"),
            "--timing-only computes no images: it cannot go with --mask");
  EXPECT_EQ(pair_error("--timing-only --set matching.p1=256").rfind("--set matching.p1=256: ", 0), 0U);
  EXPECT_EQ(error("--timing-only --left none.png --right right.png"), "image none.png does not exist");
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
            "truth.png: no pixel to score; every disparity is unknown or masked by black.png");
  text("twice.txt", "left.png right.png\nleft.png right.png\n");
  EXPECT_EQ(error("--input twice.txt --ground-truth truth.png"),
            "--ground-truth is for one pair, but the input has 2 frames; add --frames 1");
  EXPECT_EQ(error("--ground-truth truth.png"),
            "--ground-truth and --mask go with --left and --right; the built-in scene brings its own");
}

TEST_F(BadInput, Calibration) {
  ASSERT_EQ(program_("scene --size 96x64 --disparities 32 --out scene").code, 0);
  text("broken.yml", "%YAML:1.0\n---\nK1: [");
  text("poor.yml", "%YAML:1.0\n---\nK1: 5\n");
  EXPECT_EQ(pair_error("--calibration none.yml"), "none.yml: cannot read: No such file or directory");
  EXPECT_EQ(pair_error("--calibration scene/calib.yml"),
            "scene/calib.yml: the calibration is for images of 96x64, these have 64x48");
  EXPECT_EQ(pair_error("--calibration broken.yml").rfind("broken.yml: ", 0), 0U);
  EXPECT_EQ(pair_error("--calibration poor.yml").rfind("poor.yml: ", 0), 0U);
}

TEST_F(BadInput, Map) {
  ASSERT_EQ(program_("map encode --identity 64x48 -o good.map").code, 0);
  ASSERT_EQ(program_("map encode --identity 64x32 -o other.map").code, 0);
  ASSERT_EQ(program_("map encode --identity 64x48 --window 41 -o window.map").code, 0);
  fs::copy_file(program_ / "good.map", program_ / "short.map");
  truncate("short.map", 100);
  std::string bytes = program_.read("good.map");
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  text("flipped.map", bytes);
  EXPECT_EQ(pair_error("--map none.map"), "none.map: cannot read: No such file or directory");
  EXPECT_EQ(pair_error("--map left.png"),
            "left.png: not a rectification map: the first four bytes are not PLXM");
  EXPECT_EQ(pair_error("--map short.map").rfind("short.map: truncated rectification map", 0), 0U);
  EXPECT_EQ(pair_error("--map flipped.map").rfind("flipped.map: corrupt rectification map", 0), 0U);
  EXPECT_EQ(pair_error("--map other.map"), "other.map: a map of 64x32 px, but the images have 64x48");
  EXPECT_EQ(pair_error("--map window.map").rfind("window.map: a map for window 41", 0), 0U);
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

TEST_F(BadInput, OutputFolder) {
  text("file", "mine");
  const auto refused = [&](const std::string& folder) {
    return error("--size 64x32 --out " + folder);  // of two --out, the last one counts
  };
  EXPECT_EQ(refused("file"), "cannot make the output folder file: file is a file");
  EXPECT_EQ(refused("file/deeper"), "cannot make the output folder file/deeper: file is a file");
  EXPECT_EQ(program_.read("file"), "mine");
  fs::create_directory(program_ / "locked");
  ::chmod((program_ / "locked").c_str(), 0555);
  ::chmod(program_.folder().path().c_str(), 0755);
  if (::geteuid() == 0) {
    const auto become_nobody = [] { static_cast<void>(::setuid(65534) == 0); };
    EXPECT_EQ(error("--size 64x32 --out locked", become_nobody),
              "cannot write to the output folder locked: Permission denied");
    EXPECT_EQ(error("--size 64x32 --out locked/deeper", become_nobody),
              "cannot make the output folder locked/deeper: Permission denied");
  } else {
    EXPECT_EQ(refused("locked"), "cannot write to the output folder locked: Permission denied");
  }
}

TEST_F(BadInput, AFileThatDoesNotFitLeavesNothing) {
  // A limit on the size of a file stops a write half way, as a full disk does.
  const auto limited = [] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{20000, 20000};
    ::setrlimit(RLIMIT_FSIZE, &small);
  };
  EXPECT_EQ(error("--size 160x128", limited).rfind("cannot write out/", 0), 0U);
  // timing.json is the last file: without it there are no results either.
  const auto all_but_timing = [] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{40000, 40000};
    ::setrlimit(RLIMIT_FSIZE, &small);
  };
  EXPECT_EQ(error("--size 64x48 --no-point-cloud", all_but_timing),
            "cannot write out/timing.json: File too large");
}

TEST_F(BadInput, AFullDiskLeavesNothing) {
  fs::create_directory(program_ / "disk");
  const std::string disk = (program_ / "disk").string();
  if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=64k") != 0) {
    GTEST_SKIP() << "a small file system can be mounted by root only";
  }
  const std::string line = error("--size 160x128 --out disk/new");
  ::umount(disk.c_str());
  EXPECT_EQ(line.rfind("cannot write disk/new/", 0), 0U);
  EXPECT_NE(line.find("No space left on device"), std::string::npos);
}

TEST_F(BadInput, ADiskThatFillsUpLeavesTheFramesBefore) {
  fs::create_directory(program_ / "disk");
  const std::string disk = (program_ / "disk").string();
  if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=800k") != 0) {
    GTEST_SKIP() << "a small file system can be mounted by root only";
  }
  const test::Outcome outcome = program_("run --disparities 32 --size 64x48 --frames 1000 --out disk/new");
  const auto left = program_.files("disk/new");
  ::umount(disk.c_str());
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err.rfind("parallax: error: cannot write disk/new/frame_", 0), 0U) << outcome.err;
  EXPECT_EQ(test::lines(outcome.err).size(), 1U);
  EXPECT_GE(left.size(), 8U);
  EXPECT_EQ(left.size() % 8, 0U) << "whole frames: a folder and seven files each";
}

TEST_F(BadInput, WhatIsUnusualButFineIsSaidOnce) {
  fs::create_directory(program_ / "in");
  for (const char* name : {"left_0.png", "left_1.png", "right_0.png", "right_1.png"}) {
    image(std::string("in/") + name, noise(75, 50, CV_8UC3));
  }
  const test::Outcome colour = program_("run --disparities 32 --input in --out out");
  EXPECT_EQ(colour.code, 0) << colour.err;
  const auto notes = test::lines(colour.err);
  ASSERT_EQ(notes.size(), 2U) << colour.err;
  EXPECT_NE(notes[0].find("colour"), std::string::npos) << notes[0];
  EXPECT_NE(notes[1].find("75x50"), std::string::npos) << notes[1];
  for (const char* name : {"deep_l.png", "deep_r.png"}) {
    cv::Mat deep;
    noise(64, 48).convertTo(deep, CV_16U, 16);
    image(name, deep);
  }
  const test::Outcome deep = program_("run --disparities 32 --left deep_l.png --right deep_r.png");
  EXPECT_EQ(deep.code, 0) << deep.err;
  ASSERT_EQ(test::lines(deep.err).size(), 1U) << deep.err;
  EXPECT_EQ(deep.err.rfind("parallax: note: 16-bit images: ", 0), 0U) << deep.err;
}

TEST_F(BadInput, ExhaustedMemoryIsOneLineToo) {
  if (test::sanitized()) GTEST_SKIP() << "the sanitizer reserves more than any limit";
  const auto limited = [] {
    const rlimit small{300U << 20U, 300U << 20U};
    ::setrlimit(RLIMIT_AS, &small);
  };
  EXPECT_EQ(error("--size 64x48", limited), "this computer cannot hold a memory of 536870912 bytes");
  // The dates of as many tokens do not fit.
  const test::Outcome outcome = program_(
      "run --size 64x48 --set memory.size_bytes=2097152 --set streams.left_output.depth=16000000", limited);
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "parallax: internal error: out of memory\n");
}

}  // namespace bad_input_test
}  // namespace parallax
