// SPDX-License-Identifier: Apache-2.0
// parallax compare: when a circuit's tokens come beside when the model's do, and the image of what differs.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "platform/images/image_codecs.hpp"
#include "tests/cli/program.hpp"

namespace parallax::test {
namespace compare_dates_test {

constexpr std::size_t kWidth = 64, kHeight = 48;

class CompareDates : public ::testing::Test {
 protected:
  void make(const std::string& options) {
    ASSERT_EQ(program("vectors --stage noise_reduction --size 64x48 --out v " + options).code, 0);
    words = lines(program.read("v/smoothed.memh"));
    if (options.empty()) return;
    for (const std::string& line : lines(program.read("v/smoothed.dates"))) dates.push_back(std::stoll(line));
  }
  // A dump of the first tokens, with their cycles.
  void dump(const std::vector<std::int64_t>& cycles) const {
    std::ofstream file(program / "dump.csv");
    file << "cycle,data\n";
    for (std::size_t i = 0; i < cycles.size(); ++i) file << cycles[i] << ',' << words[i] << '\n';
  }
  nlohmann::json compare(int code, const std::string& options = "") const {
    const Outcome outcome = program("compare --vectors v --dump dump.csv --json " + options);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  }
  void expect_refused(const std::string& options, const std::string& message) const {
    const Outcome outcome = program("compare --vectors v " + options);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err, "parallax: error: " + message + "\n");
  }

  const Program program;
  std::vector<std::string> words;
  std::vector<std::int64_t> dates;  // of the model
};

TEST_F(CompareDates, CountFromTheFirstToken) {
  make("--dates");
  std::vector<std::int64_t> cycles = dates;
  for (std::size_t i = 0; i < cycles.size(); ++i) {
    cycles[i] += 1000;
    if (i >= 5 * kWidth + 7 && i < 7 * kWidth) cycles[i] += 4;  // from within row 5 to the end of row 6
  }
  dump(cycles);
  const nlohmann::json stream = compare(0).at("streams").at(0);
  EXPECT_EQ(stream.at("latest"), (nlohmann::json{{"cycles", 4}, {"token", 5 * kWidth + 7}}));
  EXPECT_EQ(stream.at("frame_cycles"), (std::vector<std::int64_t>{dates.back() - dates.front() + 1}));
  EXPECT_EQ(stream.at("frame_cycles"), stream.at("model_frame_cycles"));
  for (std::size_t row = 0; row < kHeight; ++row) {
    const std::int64_t model = dates[row * kWidth + kWidth - 1] - dates[row * kWidth] + 1;
    EXPECT_EQ(stream.at("model_row_cycles").at(row), model);
    EXPECT_EQ(stream.at("row_cycles").at(row), model + (row == 5 ? 4 : 0)) << row;
  }
  EXPECT_EQ(compare(0, "--bound 4").at("equal"), true);
  EXPECT_EQ(compare(1, "--bound 3").at("equal"), false);
  const Outcome said = program("compare --vectors v --dump dump.csv --bound 3");
  EXPECT_NE(said.out.find("at most 4 cycles later than the model, at token 327\n"
                          "                    more than the bound of 3 cycles\n"),
            std::string::npos)
      << said.out;
  EXPECT_NE(said.out.find("; most more in row 5\n"), std::string::npos) << said.out;
}

TEST_F(CompareDates, AreOfTheTokensThatThereAre) {
  make("--dates");
  dump({dates.begin(), dates.begin() + 100});
  const nlohmann::json stream = compare(1).at("streams").at(0);
  EXPECT_EQ(stream.at("latest").at("cycles"), 0);
  EXPECT_EQ(stream.at("frame_cycles"), nlohmann::json::array()) << "no frame is complete";
  dump({});
  EXPECT_FALSE(compare(1).at("streams").at(0).contains("latest"));
}

TEST_F(CompareDates, ABoundNeedsDatesOfBoth) {
  make("");
  expect_refused("--dump v/smoothed.memh --bound 3",
                 "--bound: v has no dates of smoothed; parallax vectors --dates writes them");
  make("--dates");
  expect_refused("--dump v/smoothed.memh --bound 3",
                 "--bound: v/smoothed.memh does not say in which cycles its tokens are; a VCD does, or a CSV "
                 "with a column cycle");
  dump(dates);
  std::ofstream(program / "v/smoothed.dates") << "12\n13x\n";
  expect_refused("--dump dump.csv", "v/smoothed.dates, line 2: no whole number");
  std::ofstream(program / "v/smoothed.dates") << "12\n13\n";
  expect_refused("--dump dump.csv",
                 "v/smoothed.dates: 2 dates of 3072 tokens; run parallax vectors --dates again");
}

TEST_F(CompareDates, AnImageShowsWhatDiffersAndWhatIsMissing) {
  make("");
  {
    std::ofstream file(program / "dump.memh");
    for (std::size_t i = 0; i < 40 * kWidth; ++i) file << (i % 11 == 0 ? "7" : words[i]) << '\n';
  }
  EXPECT_EQ(program("compare --vectors v --dump dump.memh --image where.png").code, 1);
  const cv::Mat image = read_image((program / "where.png").string());
  ASSERT_EQ(image.size(), cv::Size(kWidth, kHeight));
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool missing = i >= 40 * kWidth;
    const bool differs = !missing && i % 11 == 0 && words[i] != "007";
    EXPECT_EQ(image.at<cv::Vec3b>(static_cast<int>(i)), cv::Vec3b(missing ? 255 : 0, 0, differs ? 255 : 0))
        << i;
  }
  EXPECT_EQ(program("compare --vectors v --dump v/smoothed.memh --image none.png").code, 0);
  EXPECT_FALSE(std::filesystem::exists(program / "none.png"));
}

}  // namespace compare_dates_test
}  // namespace parallax::test
