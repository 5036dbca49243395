// SPDX-License-Identifier: Apache-2.0
#include "platform/results/truth_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <opencv2/core.hpp>

#include "platform/images/image_codecs.hpp"
#include "platform/images/stderr_capture.hpp"
#include "platform/results/output_file.hpp"
#include "tests/platform/error_of.hpp"
#include "tests/platform/temporary_folder.hpp"

namespace parallax {
namespace truth_file_test {

using Floats = std::vector<float>;

constexpr float kInfinite = std::numeric_limits<float>::infinity();

/// The bytes of a number, the first one of the least or of the most weight.
template <class T>
std::string bytes_of(T value, bool big_endian) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (big_endian) bytes = {bytes.rbegin(), bytes.rend()};
  return bytes;
}

class TruthFile : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& bytes) const {
    return folder_.write(name, bytes);
  }
  std::string image(const std::string& name, const cv::Mat& pixels) const {
    write_file(folder_ / name, encode_image(std::filesystem::path(name).extension(), pixels));
    return folder_ / name;
  }
  /// Of 4 x 3 pixels.
  GroundTruth read(const std::string& path, std::optional<double> scale = {}) {
    notices_.clear();
    return read_ground_truth({path, "", scale}, 4, 3,
                             [this](const std::string& line) { notices_.push_back(line); });
  }
  /// What is said of the file `name`, without its path; nothing else may be printed.
  std::string complaint(const std::string& name, const std::string& mask = "") const {
    const StderrCapture capture;
    std::string line = error_of([&] {
      read_ground_truth({folder_ / name, mask.empty() ? "" : folder_ / mask, {}}, 4, 3, {});
    });
    EXPECT_EQ(capture.text(), "");
    const std::string path = folder_.path().string() + "/";
    for (std::size_t at = line.find(path); at != std::string::npos; at = line.find(path))
      line.erase(at, path.size());
    return line;
  }

  const TemporaryFolder folder_;
  std::vector<std::string> notices_;
};

/// A float map of 4 x 3 whose pixel (x, y), from the top, is 10 y + x + 0.5.
std::string pfm(const std::string& header, bool big_endian) {
  std::string bytes = header;
  for (int y = 2; y >= 0; --y) {
    for (int x = 0; x < 4; ++x) bytes += bytes_of(static_cast<float>(10 * y + x) + 0.5F, big_endian);
  }
  return bytes;
}

const Floats kRamp{0.5, 1.5, 2.5, 3.5, 10.5, 11.5, 12.5, 13.5, 20.5, 21.5, 22.5, 23.5};

TEST_F(TruthFile, PfmOfBothByteOrders) {
  EXPECT_EQ(read(write("a.pfm", pfm("Pf\n4 3\n-1.0\n", false))).disparity, kRamp);
  EXPECT_EQ(read(write("b.pfm", pfm("Pf\n4 3\n1\n", true))).disparity, kRamp);
  EXPECT_EQ(read(write("c.pfm", pfm("Pf\r\n4 3\r\n-1.000000\r\n", false))).disparity, kRamp);
  EXPECT_EQ(read(write("d.pfm", pfm("Pf 4 3 -1 ", false))).disparity, kRamp);
  EXPECT_EQ(read(write("e.pfm", pfm("Pf\n# made by hand\n4\n3\n-1\n", false))).disparity, kRamp);
  EXPECT_EQ(read(write("like_an_image.png", pfm("Pf\n4 3\n-1.0\n", false))).disparity, kRamp)
      << "content decides";
}

TEST_F(TruthFile, PfmWithAScaleForViewing) {
  EXPECT_EQ(read(write("a.pfm", pfm("Pf\n4 3\n-0.003922\n", false))).disparity, kRamp);
  const std::string file = "ground truth " + (folder_ / "a.pfm");
  EXPECT_EQ(
      notices_,
      (std::vector<std::string>{
          file + ": the size of the scale in its header, 0.003922, is not applied: data sets write one that "
                 "is for viewing",
          file + ": floating-point values, taken as disparity * 1; --ground-truth-scale states another"}));
  EXPECT_EQ(read(folder_ / "a.pfm", 0.5).disparity.at(3), 7);
}

TEST_F(TruthFile, PfmWithInvalidPixels) {
  std::string bytes = "Pf\n4 3\n-1\n";
  for (const float value :
       {kInfinite, -kInfinite, std::nanf(""), 0.F, -1.F, 7.F, 8.F, 300.25F, 1.F, 1.F, 1.F, 1.F})
    bytes += bytes_of(value, false);
  EXPECT_EQ(read(write("a.pfm", bytes)).disparity, (Floats{1, 1, 1, 1, 0, 7, 8, 300.25F, 0, 0, 0, 0}));
}

TEST_F(TruthFile, PfmThatIsNone) {
  write("colour.pfm", "PF\n4 3\n-1\n" + std::string(144, 'x'));
  EXPECT_EQ(complaint("colour.pfm"),
            "colour.pfm: a colour map (PF), expected one channel (Pf): disparities have no colour");
  write("size.pfm", pfm("Pf\n3 4\n-1\n", false));
  EXPECT_EQ(complaint("size.pfm"), "size.pfm: the ground truth is 3x4, the images are 4x3");
  for (const char* header : {"Pf\n4 3\n0\n", "Pf\n4 x\n-1\n", "Pf\n-4 3\n-1\n", "Pf\n4 3\nnan\n", "Pf\n",
                             "Pf\n99999999999 3\n1\n"}) {
    write("header.pfm", header);
    EXPECT_EQ(complaint("header.pfm").rfind("header.pfm: a damaged header: width '", 0), 0u)
        << complaint("header.pfm");
  }
  std::string bytes = pfm("Pf\n4 3\n-1\n", false);
  write("short.pfm", bytes.substr(0, bytes.size() - 1));
  EXPECT_EQ(complaint("short.pfm"), "short.pfm: 47 bytes of values, but 4x3 pixels of 4 bytes are 48");
  write("long.pfm", bytes + "!!");
  EXPECT_EQ(complaint("long.pfm"), "long.pfm: 50 bytes of values, but 4x3 pixels of 4 bytes are 48");
  write("large.pfm", "Pf\n1000000 1000000\n-1\n");
  EXPECT_EQ(complaint("large.pfm"), "large.pfm: the ground truth is 1000000x1000000, the images are 4x3");
}

/// An array as numpy.save writes it: the header is padded to a multiple of 64 bytes.
std::string npy(int version, const std::string& type, bool fortran, const std::string& shape,
                const std::string& values) {
  std::string header = "{'descr': '" + type + "', 'fortran_order': " + (fortran ? "True" : "False") +
                       ", 'shape': " + shape + ", }";
  const std::size_t front = version == 1 ? 10 : 12;
  while ((front + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  std::string bytes = "\x93NUMPY";
  bytes += static_cast<char>(version);
  bytes += '\0';
  bytes += version == 1 ? bytes_of(static_cast<std::uint16_t>(header.size()), false)
                        : bytes_of(static_cast<std::uint32_t>(header.size()), false);
  return bytes + header + values;
}

/// Pixel (x, y) is 10 y + x + 1.
template <class T>
std::string ramp(bool big_endian, bool fortran = false) {
  std::string bytes;
  for (int i = 0; i < 12; ++i) {
    const int x = fortran ? i / 3 : i % 4, y = fortran ? i % 3 : i / 4;
    bytes += bytes_of(static_cast<T>(10 * y + x + 1), big_endian);
  }
  return bytes;
}

TEST_F(TruthFile, NumPyArrays) {
  const Floats expected{1, 2, 3, 4, 11, 12, 13, 14, 21, 22, 23, 24};
  const auto disparities = [&](const std::string& bytes) {
    return read(write("a.npy", bytes), 1.0).disparity;
  };
  for (const int version : {1, 2, 3}) {
    EXPECT_EQ(disparities(npy(version, "<f4", false, "(3, 4)", ramp<float>(false))), expected);
  }
  EXPECT_EQ(disparities(npy(1, ">f4", false, "(3, 4)", ramp<float>(true))), expected);
  // 1.0 is 0x3C00, 2.5 is 0x4100, 1000 is 0x63D0 (IEEE 754, binary16).
  EXPECT_EQ(disparities(npy(1, "<f2", false, "(3, 4)",
                            bytes_of<std::uint16_t>(0x3C00, false) + bytes_of<std::uint16_t>(0x4100, false) +
                                bytes_of<std::uint16_t>(0x63D0, false) + std::string(18, '\0'))),
            (Floats{1, 2.5, 1000, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(disparities(npy(1, "<f8", false, "(3, 4)", ramp<double>(false))), expected);
  EXPECT_EQ(disparities(npy(1, ">f8", false, "(3, 4)", ramp<double>(true))), expected);
  EXPECT_EQ(disparities(npy(1, "|u1", false, "(3, 4)", ramp<std::uint8_t>(false))), expected);
  EXPECT_EQ(disparities(npy(1, "<u2", false, "(3, 4)", ramp<std::uint16_t>(false))), expected);
  EXPECT_EQ(disparities(npy(1, ">u2", false, "(3, 4)", ramp<std::uint16_t>(true))), expected);
  EXPECT_EQ(disparities(npy(1, "<i4", false, "(3, 4)", ramp<std::int32_t>(false))), expected);
  EXPECT_EQ(disparities(npy(1, "<i8", false, "(3, 4)", ramp<std::int64_t>(false))), expected);
  EXPECT_EQ(disparities(npy(1, "<f4", true, "(3, 4)", ramp<float>(false, true))), expected);
  EXPECT_EQ(disparities(npy(2, ">u2", true, "(3, 4)", ramp<std::uint16_t>(true, true))), expected);
  EXPECT_EQ(disparities(npy(1, "<f4", false, "(1, 3, 4)", ramp<float>(false))), expected);
  EXPECT_EQ(disparities(npy(1, "<f4", false, "(3, 4, 1)", ramp<float>(false))), expected);
}

TEST_F(TruthFile, NumPyArraysThatAreNone) {
  const auto error = [&](const std::string& bytes) {
    write("a.npy", bytes);
    return complaint("a.npy");
  };
  EXPECT_EQ(error(npy(1, "<f4", false, "(4, 3)", ramp<float>(false))),
            "a.npy: the ground truth is 3x4, the images are 4x3");
  EXPECT_EQ(error(npy(1, "<f4", false, "(12,)", ramp<float>(false))),
            "a.npy: a NumPy array of the shape (12,), expected (rows, columns)");
  EXPECT_EQ(error(npy(1, "<f4", false, "(3, 4, 3)", "")),
            "a.npy: a NumPy array of the shape (3, 4, 3), expected (rows, columns)");
  EXPECT_EQ(
      error(npy(1, "<c8", false, "(3, 4)", std::string(96, 'x'))),
      "a.npy: a NumPy array of the type 'c8', expected floating point of 16 to 64 bits or integers of 8 "
      "to 64 bits");
  EXPECT_EQ(error(npy(9, "<f4", false, "(3, 4)", "")),
            "a.npy: a NumPy array of format version 9, expected 1, 2 or 3");
  EXPECT_EQ(error(npy(1, "<f4", false, "(3, 4)", ramp<float>(false).substr(1))),
            "a.npy: 47 bytes of values, but 4x3 pixels of 4 bytes are 48");
  EXPECT_EQ(error(npy(1, "<f4", false, "3", "")), "a.npy: a NumPy array with a damaged header: no 'shape'");
  EXPECT_EQ(error(npy(1, "", false, "(3, 4)", "")),
            "a.npy: a NumPy array with a damaged header: no simple type in 'descr'");
  EXPECT_EQ(error("\x93NUMPY\x01"), "a.npy: a NumPy array with a damaged header: it ends there");
  const std::string whole = npy(1, "<f4", false, "(3, 4)", "");
  EXPECT_EQ(error(whole.substr(0, 30)), "a.npy: a NumPy array with a damaged header: it ends there");
  EXPECT_EQ(error("PK\x03\x04 and so on"), "a.npy: a damaged archive: it has no directory at its end");
}

TEST_F(TruthFile, ImagesOfIntegers) {
  cv::Mat sixteen(3, 4, CV_16UC1, cv::Scalar(0));
  sixteen.at<std::uint16_t>(1, 2) = 40000;
  Floats expected(12, 0.F);
  expected[6] = 40000.F / 256;
  for (const char* name : {"a.png", "a.tiff", "a.pgm"}) {
    EXPECT_EQ(read(image(name, sixteen)).disparity, expected) << name;
    EXPECT_EQ(notices_, (std::vector<std::string>{"ground truth " + (folder_ / name) +
                                                  ": 16-bit integers, taken as disparity * 256; "
                                                  "--ground-truth-scale states another"}));
  }
  expected[6] = 10000;
  EXPECT_EQ(read(folder_ / "a.png", 4.0).disparity, expected);
  EXPECT_TRUE(notices_.empty()) << "nothing was assumed";
  cv::Mat eight(3, 4, CV_8UC1, cv::Scalar(0));
  eight.at<std::uint8_t>(1, 2) = 66;
  expected[6] = 66;
  EXPECT_EQ(read(image("b.png", eight)).disparity, expected);
  EXPECT_EQ(notices_.at(0),
            "ground truth " + (folder_ / "b.png") +
                ": 8-bit integers, taken as disparity * 1; --ground-truth-scale states another");
  expected[6] = 16.5;
  EXPECT_EQ(read(folder_ / "b.png", 4.0).disparity, expected);
  cv::Mat colour;
  cv::merge(std::vector<cv::Mat>{eight, eight, eight}, colour);
  expected[6] = 66;
  EXPECT_EQ(read(image("grey_as_colour.png", colour)).disparity, expected);
}

TEST_F(TruthFile, ImagesOfFloatingPoint) {
  cv::Mat values(3, 4, CV_32FC1, cv::Scalar(0));
  values.at<float>(0, 0) = 12.34375F;
  values.at<float>(0, 1) = kInfinite;
  values.at<float>(0, 2) = -5;
  values.at<float>(0, 3) = std::nanf("");
  Floats expected(12, 0.F);
  expected[0] = 12.34375F;
  EXPECT_EQ(read(image("a.tiff", values)).disparity, expected);
  EXPECT_EQ(notices_.at(0),
            "ground truth " + (folder_ / "a.tiff") +
                ": floating-point values, taken as disparity * 1; --ground-truth-scale states another");
  cv::Mat doubles;
  values.convertTo(doubles, CV_64F);
  EXPECT_EQ(read(image("b.tif", doubles)).disparity, expected);
}

TEST_F(TruthFile, ColoursThatHoldValuesAsSintelPacksThem) {
  // B, G, R: 4 * 200 + 48 / 64 + 0; 0 + 255 / 64 + 1 / 16384; 4; unknown.
  cv::Mat packed(3, 4, CV_8UC3, cv::Scalar(0, 0, 0));
  packed.at<cv::Vec3b>(0, 0) = {0, 48, 200};
  packed.at<cv::Vec3b>(0, 1) = {1, 255, 0};
  packed.at<cv::Vec3b>(2, 3) = {0, 0, 1};
  Floats expected(12, 0.F);
  expected[0] = 800.75F;
  expected[1] = 3.984375F + 1.F / 16384;
  expected[11] = 4;
  const auto sintel = [&](const std::string& path) {
    notices_.clear();
    return read_ground_truth({path, "", {}, TruthEncoding::kSintel}, 4, 3,
                             [this](const std::string& line) { notices_.push_back(line); });
  };
  EXPECT_EQ(sintel(image("a.png", packed)).disparity, expected);
  EXPECT_TRUE(notices_.empty()) << "nothing was assumed";
  const std::string grey = image("grey.png", cv::Mat(3, 4, CV_16UC1, cv::Scalar(256)));
  EXPECT_EQ(error_of([&] { sintel(grey); }),
            grey +
                ": --ground-truth-encoding sintel is for colour images of 8 bits, this one has 1 channel of "
                "16 bits");
  const std::string map = write("a.pfm", pfm("Pf\n4 3\n-1.0\n", false));
  EXPECT_EQ(error_of([&] { sintel(map); }),
            map + ": --ground-truth-encoding is for images, this is a float map");
}

TEST_F(TruthFile, JpegIsSaidToChangeValues) {
  const std::string file = image("a.jpg", cv::Mat(3, 4, CV_8UC1, cv::Scalar(66)));
  EXPECT_EQ(read(file, 1.0).disparity, Floats(12, 66.F));
  EXPECT_EQ(notices_, (std::vector<std::string>{"ground truth " + file +
                                                ": JPEG changes values a little; PNG, TIFF, PFM and NPY keep "
                                                "them"}));
}

TEST_F(TruthFile, Masks) {
  image("truth.png", cv::Mat(3, 4, CV_16UC1, cv::Scalar(256)));
  cv::Mat mask(3, 4, CV_8UC1, cv::Scalar(128));
  mask.at<std::uint8_t>(2, 3) = 255;
  const GroundTruth truth = read_ground_truth({folder_ / "truth.png", image("mask.png", mask), {}}, 4, 3, {});
  EXPECT_FALSE(truth.scored(0));
  EXPECT_TRUE(truth.scored(11));
  EXPECT_TRUE(read_ground_truth({folder_ / "truth.png", "", {}}, 4, 3, {}).mask.empty());
  EXPECT_EQ(complaint("truth.png", "none.png"), "ground-truth mask none.png does not exist");
  EXPECT_EQ(complaint("truth.png", "truth.png"),
            "truth.png: the ground-truth mask is 16 bit with 1 channel, it must be 8 bit with 1 channel (255 "
            "= score)");
  image("large.png", cv::Mat(2, 4, CV_8UC1, cv::Scalar(255)));
  EXPECT_EQ(complaint("truth.png", "large.png"),
            "large.png: the ground-truth mask is 4x2, the images are 4x3");
  write("damaged.png", "\x89PNG\r\n\x1A\nand so on");
  EXPECT_EQ(complaint("truth.png", "damaged.png"),
            "cannot read ground-truth mask damaged.png: it is damaged, or not a PNG, JPEG, TIFF, BMP, PNM or "
            "WebP file");
  image("black.png", cv::Mat(3, 4, CV_8UC1, cv::Scalar(0)));
  EXPECT_EQ(complaint("truth.png", "black.png"),
            "black.png: marks no pixel: 255 says score, its largest value is 0");
  image("bool.png", cv::Mat(3, 4, CV_8UC1, cv::Scalar(1)));
  EXPECT_EQ(complaint("truth.png", "bool.png"),
            "bool.png: marks no pixel: 255 says score, its largest value is 1");
  cv::Mat half(3, 4, CV_16UC1, cv::Scalar(0));
  half.at<std::uint16_t>(0, 0) = 256;
  image("half.png", half);
  EXPECT_EQ(complaint("half.png", "mask.png"),
            "half.png: no pixel to score; every disparity is unknown or masked by mask.png");
}

TEST_F(TruthFile, DisparitiesOfTheOtherSign) {
  cv::Mat values(3, 4, CV_32FC1, cv::Scalar(-5));
  values.at<float>(0, 0) = 0;
  image("negative.tiff", values);
  EXPECT_EQ(complaint("negative.tiff"),
            "negative.tiff: no value is above 0, the least is -5: a disparity is x_left - x_right, and not "
            "negative");
}

TEST_F(TruthFile, FilesThatAreNone) {
  EXPECT_EQ(complaint("none.png"), "ground truth none.png does not exist");
  std::filesystem::create_directory(folder_.path() / "folder.png");
  EXPECT_EQ(complaint("folder.png"), "folder.png is a folder, expected a ground truth");
  for (const char* text : {"no image", "", "P", "Pf"}) {
    write("text.png", text);
    EXPECT_EQ(complaint("text.png"),
              "cannot read ground truth text.png: it is damaged, or not a PNG, JPEG, TIFF, BMP, PNM, WebP, "
              "PFM, NPY or "
              "NPZ file");
  }
  image("whole.png", cv::Mat(3, 4, CV_16UC1, cv::Scalar(256)));
  std::string png = folder_.read("whole.png");
  png[20] = 'x';  // the height
  write("damaged.png", png);
  EXPECT_EQ(complaint("damaged.png"), "damaged.png: the ground truth is 4x2013265923, the images are 4x3");
  png = folder_.read("whole.png");
  png[24] = 77;  // bits
  write("damaged.png", png);
  EXPECT_EQ(
      complaint("damaged.png"),
      "cannot read ground truth damaged.png: it is damaged, or not a PNG, JPEG, TIFF, BMP, PNM or WebP file");
  image("large.png", cv::Mat(3, 5, CV_16UC1, cv::Scalar(256)));
  EXPECT_EQ(complaint("large.png"), "large.png: the ground truth is 5x3, the images are 4x3");
  image("colour.png", cv::Mat(3, 4, CV_16UC3, cv::Scalar(7, 8, 9)));
  EXPECT_EQ(
      complaint("colour.png"),
      "colour.png: the ground truth is 16 bit with 3 channels that differ: a picture of a disparity map in "
      "colours, as it looks, does not hold its values; expected 1 channel (or equal ones) of 8 or 16 bits or "
      "of floating point, disparity * scale");
  image("jet.png", cv::Mat(3, 4, CV_8UC3, cv::Scalar(0, 8, 255)));
  EXPECT_EQ(
      complaint("jet.png"),
      "jet.png: the ground truth is 8 bit with 3 channels that differ: a picture of a disparity map in "
      "colours, as it looks, does not hold its values; expected 1 channel (or equal ones) of 8 or 16 "
      "bits or of floating point, disparity * scale; for values packed into colours as Sintel has them: "
      "--ground-truth-encoding sintel");
  image("unknown.png", cv::Mat(3, 4, CV_16UC1, cv::Scalar(0)));
  EXPECT_EQ(complaint("unknown.png"), "unknown.png: no pixel to score; every disparity is unknown");
  image("truth.png", cv::Mat(3, 4, CV_16UC1, cv::Scalar(256)));
  for (const double scale : {0.0, -4.0, std::nan("")}) {
    EXPECT_EQ(error_of([&] { read(folder_ / "truth.png", scale); }).rfind("--ground-truth-scale is ", 0), 0u);
  }
}

TEST_F(TruthFile, DamageAnywhereIsOneLineOrAnotherTruth) {
  image("a.tiff", cv::Mat(3, 4, CV_32FC1, cv::Scalar(5)));
  image("a.png", cv::Mat(3, 4, CV_16UC1, cv::Scalar(500)));
  const std::string files[] = {pfm("Pf\n4 3\n-1.0\n", false),
                               npy(1, "<f4", false, "(3, 4)", ramp<float>(false)),
                               npy(2, ">u2", true, "(3, 4)", ramp<std::uint16_t>(true)),
                               folder_.read("a.tiff"), folder_.read("a.png")};
  for (const std::string& whole : files) {
    for (std::size_t at = 0; at < whole.size(); at += 3) {
      for (const int flip : {0x01, 0xFF}) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ flip);
        write("damaged", damaged);
        EXPECT_EQ(complaint("damaged").find('\n'), std::string::npos) << at;
      }
      write("damaged", whole.substr(0, at));
      // The last bytes of a TIFF say that no other image follows.
      EXPECT_TRUE(complaint("damaged") != "(no error)" || at + 4 >= whole.size()) << at;
    }
  }
}

}  // namespace truth_file_test
}  // namespace parallax
