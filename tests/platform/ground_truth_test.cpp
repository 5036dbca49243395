// SPDX-License-Identifier: Apache-2.0
#include "platform/results/ground_truth.hpp"

#include <gtest/gtest.h>

#include <map>

#include "tlm/error.hpp"

namespace parallax {
namespace ground_truth_test {

constexpr Disparity kNone = {kInvalidDisparity, Cause::kUniqueness};

Disparity pixels(double value) { return {static_cast<std::uint16_t>(value * 16), Cause::kMatched}; }

TEST(GroundTruthScore, CountsWhatIsScoredValidAndBad) {
  // Truth 10 px everywhere it is known; a limit is exceeded, not met, to be bad.
  const std::vector<Disparity> disparity = {pixels(10),   pixels(11), pixels(11.0625), pixels(12.5),
                                            pixels(13.5), pixels(6),  kNone,           kNone,
                                            pixels(99),   pixels(99)};
  GroundTruth truth{10, 1, std::vector<float>(10, 10), std::vector<std::uint8_t>(10, 255), 1};
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
  const GroundTruth truth{2, 2, {1, 0, 2, 255.99609375F}, {}, 1};
  const GroundTruthScore result = score({pixels(1), pixels(1), kNone, {4094, Cause::kMatched}}, 2, truth);
  EXPECT_EQ(result.scored, 3);
  EXPECT_EQ(result.valid, 2);
  EXPECT_EQ(result.bad[0], 0);
}

TEST(GroundTruthScore, NothingToScoreGivesZeros) {
  const GroundTruth truth{2, 1, {0, 0}, {}, 1};
  const GroundTruthScore result = score({pixels(1), kNone}, 2, truth);
  EXPECT_EQ(result.coverage(), 0);
  EXPECT_EQ(result.bad_share(1), 0);
  EXPECT_EQ(result.bad_share_all(3), 0);
  EXPECT_EQ(result.mean_error(), 0);
}

TEST(GroundTruthScore, NamesEachNumber) {
  const GroundTruth truth{2, 1, {1, 1}, {}, 1};
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
  const GroundTruth truth{2, 2, {0, 0, 0, 0}, {}, 1};
  try {
    score({kNone, kNone, kNone}, 3, truth);
    FAIL();
  } catch (const UserError& error) {
    EXPECT_STREQ(error.what(), "the ground truth is 2x2, the disparities are 3x1");
  }
}

}  // namespace ground_truth_test
}  // namespace parallax
