// SPDX-License-Identifier: Apache-2.0
#include "platform/results/ground_truth.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <opencv2/core.hpp>

#include "platform/images/image_codecs.hpp"
#include "platform/results/output_file.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace ground_truth_test {

namespace fs = std::filesystem;

/// A folder of its own for each test, gone afterwards.
class EvaluationFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              (std::string("evaluation_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const cv::Mat& image) const {
    const std::string path = (folder_ / name).string();
    write_file(path, encode_image(fs::path(name).extension(), image));
    return path;
  }

  static std::string complaint(const std::string& path, const std::string& mask_path = "") {
    try {
      read_ground_truth(path, mask_path, 4, 3);
    } catch (const UserError& error) {
      return error.what();
    }
    return {};
  }

  fs::path folder_;
};

TEST_F(EvaluationFiles, ReadsGroundTruthAndMask) {
  cv::Mat truth(3, 4, CV_16UC1, cv::Scalar(0));
  truth.at<std::uint16_t>(1, 2) = 40000;
  cv::Mat mask(3, 4, CV_8UC1, cv::Scalar(128));
  mask.at<std::uint8_t>(2, 3) = 255;
  mask.at<std::uint8_t>(1, 2) = 255;
  const GroundTruth read = read_ground_truth(write("gt.png", truth), write("mask.png", mask), 4, 3);
  EXPECT_EQ(read.width, 4);
  EXPECT_EQ(read.height, 3);
  ASSERT_EQ(read.disparity.size(), 12U);
  EXPECT_EQ(read.disparity[1 * 4 + 2], 40000);
  EXPECT_EQ(read.disparity[0], 0);
  ASSERT_EQ(read.mask.size(), 12U);
  EXPECT_EQ(read.mask[2 * 4 + 3], 255);
  EXPECT_EQ(read.mask[0], 128);
  EXPECT_TRUE(read_ground_truth(write("gt.png", truth), "", 4, 3).mask.empty());
}

TEST_F(EvaluationFiles, SaysWhatIsWrongWithAFile) {
  const std::string truth = write("gt.png", cv::Mat(3, 4, CV_16UC1, cv::Scalar(256)));
  EXPECT_EQ(complaint(truth), "");

  const std::string missing = (folder_ / "missing.png").string();
  EXPECT_EQ(complaint(missing), missing + ": cannot read the ground truth (missing, or not an image)");
  EXPECT_EQ(complaint(truth, missing),
            missing + ": cannot read the ground-truth mask (missing, or not an image)");

  const std::string text = (folder_ / "text.png").string();
  std::ofstream(text) << "no image";
  EXPECT_EQ(complaint(text), text + ": cannot read the ground truth (missing, or not an image)");

  EXPECT_EQ(complaint(folder_.string()),
            folder_.string() + ": cannot read the ground truth (missing, or not an image)");

  const std::string large = write("large.png", cv::Mat(3, 5, CV_16UC1, cv::Scalar(256)));
  EXPECT_EQ(complaint(large), large + ": the ground truth is 5x3, the images are 4x3");

  const std::string byte = write("byte.png", cv::Mat(3, 4, CV_8UC1, cv::Scalar(7)));
  EXPECT_EQ(complaint(byte),
            byte +
                ": the ground truth is 8 bit with 1 channel, it must be 16 bit with 1 channel "
                "(disparity * 256, 0 = unknown)");
  const std::string colour = write("colour.png", cv::Mat(3, 4, CV_16UC3, cv::Scalar(7, 7, 7)));
  EXPECT_EQ(complaint(colour),
            colour +
                ": the ground truth is 16 bit with 3 channels, it must be 16 bit with 1 channel "
                "(disparity * 256, 0 = unknown)");

  EXPECT_EQ(
      complaint(truth, truth),
      truth +
          ": the ground-truth mask is 16 bit with 1 channel, it must be 8 bit with 1 channel (255 = score)");
  const std::string large_mask = write("large_mask.png", cv::Mat(2, 4, CV_8UC1, cv::Scalar(255)));
  EXPECT_EQ(complaint(truth, large_mask), large_mask + ": the ground-truth mask is 4x2, the images are 4x3");
}

constexpr Disparity kNone = {kInvalidDisparity, Cause::kUniqueness};

Disparity pixels(double value) { return {static_cast<std::uint16_t>(value * 16), Cause::kMatched}; }

TEST(GroundTruthScore, CountsWhatIsScoredValidAndBad) {
  // Truth 10 px everywhere it is known; a limit is exceeded, not met, to be bad.
  const std::vector<Disparity> disparity = {pixels(10),   pixels(11), pixels(11.0625), pixels(12.5),
                                            pixels(13.5), pixels(6),  kNone,           kNone,
                                            pixels(99),   pixels(99)};
  GroundTruth truth{10, 1, std::vector<std::uint16_t>(10, 10 * 256), std::vector<std::uint8_t>(10, 255)};
  truth.disparity[8] = 0;  // unknown
  truth.mask[9] = 128;     // occluded
  const GroundTruthScore result = score(disparity, 10, truth);
  EXPECT_EQ(result.pixels, 10);
  EXPECT_EQ(result.scored, 8);
  EXPECT_EQ(result.valid, 6);
  EXPECT_EQ(result.bad, (std::array<std::int64_t, 3>{4, 3, 2}));
  EXPECT_DOUBLE_EQ(result.coverage(), 6.0 / 8);
  EXPECT_DOUBLE_EQ(result.bad_share(2), 3.0 / 6);
  EXPECT_DOUBLE_EQ(result.bad_share_all(2), 5.0 / 8);
  EXPECT_DOUBLE_EQ(result.mean_error(), (0 + 1 + 1.0625 + 2.5 + 3.5 + 4) / 6);
}

TEST(GroundTruthScore, WithoutAMaskAllKnownPixelsAreScored) {
  const GroundTruth truth{2, 2, {256, 0, 512, 65535}, {}};
  const GroundTruthScore result = score({pixels(1), pixels(1), kNone, {4094, Cause::kMatched}}, 2, truth);
  EXPECT_EQ(result.scored, 3);
  EXPECT_EQ(result.valid, 2);
  EXPECT_EQ(result.bad[0], 0);
}

TEST(GroundTruthScore, NothingToScoreGivesZeros) {
  const GroundTruth truth{2, 1, {0, 0}, {}};
  const GroundTruthScore result = score({pixels(1), kNone}, 2, truth);
  EXPECT_EQ(result.coverage(), 0);
  EXPECT_EQ(result.bad_share(1), 0);
  EXPECT_EQ(result.bad_share_all(3), 0);
  EXPECT_EQ(result.mean_error(), 0);
}

TEST(GroundTruthScore, NamesEachNumber) {
  const GroundTruth truth{2, 1, {256, 256}, {}};
  const std::vector<Quality> qualities = score({pixels(3.5), kNone}, 2, truth).qualities();
  std::vector<std::string> names;
  std::map<std::string, double> values;
  for (const Quality& quality : qualities) {
    names.push_back(quality.name);
    values[quality.name] = quality.value;
  }
  EXPECT_DOUBLE_EQ(values["coverage"], 50);
  EXPECT_DOUBLE_EQ(values["bad_2"], 100);
  EXPECT_DOUBLE_EQ(values["bad_3"], 0);
  EXPECT_DOUBLE_EQ(values["bad_3_all"], 50);
  EXPECT_DOUBLE_EQ(values["mean_error"], 2.5);
  EXPECT_EQ(names,
            (std::vector<std::string>{"scored_pixels", "valid_pixels", "coverage", "mean_error", "bad_1",
                                      "bad_1_all", "bad_2", "bad_2_all", "bad_3", "bad_3_all"}));
}

TEST(GroundTruthScore, RejectsAnotherSize) {
  const GroundTruth truth{2, 2, {0, 0, 0, 0}, {}};
  try {
    score({kNone, kNone, kNone}, 3, truth);
    FAIL();
  } catch (const UserError& error) {
    EXPECT_STREQ(error.what(), "the ground truth is 2x2, the disparities are 3x1");
  }
}

}  // namespace ground_truth_test
}  // namespace parallax
