// SPDX-License-Identifier: Apache-2.0
// What `parallax run` writes and prints.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "platform/results/disparity_bin.hpp"
#include "tests/cli/program.hpp"

namespace parallax {
namespace {

using nlohmann::json;

const std::vector<std::string> kFrameFiles{"cause_labels.png", "causes.png",          "disparity.bin",
                                           "disparity.png",    "disparity_color.png", "left_rectified.png"};

class RunResults : public ::testing::Test {
 protected:
  test::Outcome run(const std::string& arguments) const {
    test::Outcome outcome = program_("run --disparities 32 " + arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return outcome;
  }

  cv::Mat image(const std::string& name) const {
    return cv::imread((program_ / name).string(), cv::IMREAD_UNCHANGED);
  }

  std::vector<std::uint16_t> disparities(const std::string& name, int width, int height) const {
    const std::string bytes = program_.read(name);
    return unpack_disparities({bytes.begin(), bytes.end()}, width, height);
  }

  /// Checks the files of one frame for their sizes, and against one another.
  void check_frame(const std::string& folder, int width, int height) const {
    const cv::Mat png = image(folder + "disparity.png");
    const cv::Mat causes = image(folder + "cause_labels.png");
    const cv::Size size(width, height);
    ASSERT_EQ(png.size(), size);
    ASSERT_EQ(png.type(), CV_16UC1);
    ASSERT_EQ(causes.size(), size);
    ASSERT_EQ(causes.type(), CV_8UC1);
    EXPECT_EQ(image(folder + "left_rectified.png").size(), size);
    EXPECT_EQ(image(folder + "left_rectified.png").type(), CV_8UC1);
    EXPECT_EQ(image(folder + "disparity_color.png").cols, width);
    EXPECT_EQ(image(folder + "causes.png").cols, width);
    const std::vector<std::uint16_t> values = disparities(folder + "disparity.bin", width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const std::uint16_t value = values[static_cast<std::size_t>(y * width + x)];
        const int expected = value == 0xFFF ? 0 : std::max(1, value * 16);
        ASSERT_EQ(png.at<std::uint16_t>(y, x), expected) << x << ' ' << y;
        const auto cause = static_cast<Cause>(causes.at<std::uint8_t>(y, x));
        ASSERT_EQ(value != 0xFFF, cause == Cause::kMatched || cause == Cause::kInterpolated) << x << ' ' << y;
      }
    }
  }

  json timing(const std::string& folder) const { return json::parse(program_.read(folder + "timing.json")); }

  test::Program program_;
};

/// Every leaf is a metric: a value that is not null, a unit, a description that is a sentence.
void check_metrics(const json& tree, const std::string& path) {
  for (const auto& [name, entry] : tree.items()) {
    const std::string here = path + "/" + name;
    if (here == "/configuration") continue;
    ASSERT_TRUE(entry.is_object()) << here;
    if (!entry.contains("value")) {
      check_metrics(entry, here);
      continue;
    }
    const json& value = entry["value"];
    const bool numbers = value.is_array() && std::all_of(value.begin(), value.end(), [](const json& number) {
                           return number.is_number();
                         });
    EXPECT_TRUE(numbers || (value.is_primitive() && !value.is_null())) << here;
    EXPECT_TRUE(entry["unit"].is_string()) << here;
    EXPECT_EQ(numbers || value.is_number(), entry["unit"] != "")
        << here << ": a number, or a row of them, has a unit, a word none";
    ASSERT_TRUE(entry["description"].is_string()) << here;
    const std::string description = entry["description"];
    EXPECT_EQ(description.substr(description.size() - 1), ".") << here;
    if (entry.contains("window")) {
      EXPECT_NE(entry["window"], "") << here;
    }
  }
}

TEST_F(RunResults, OfTheBuiltInScene) {
  const test::Outcome outcome = run("--size 96x64 --seed 7 --out out");
  std::vector<std::string> expected = kFrameFiles;
  expected.insert(expected.end(), {"points.ply", "timing.json"});
  EXPECT_EQ(program_.files("out"), expected);
  check_frame("out/", 96, 64);
  const std::string ply = program_.read("out/points.ply");
  EXPECT_EQ(ply.rfind("ply\nformat binary_little_endian 1.0\n", 0), 0U);
  EXPECT_NE(outcome.out.find("image               96 x 64 px, disparities"), std::string::npos);
  EXPECT_NE(outcome.out.find("ground truth        coverage "), std::string::npos);

  const json tree = timing("out/");
  check_metrics(tree, "");
  EXPECT_EQ(tree["run"]["command"]["value"], "parallax run --disparities 32 --size 96x64 --seed 7 --out out");
  EXPECT_EQ(tree["run"]["seed"]["value"], "7");
  for (const char* name : {"version", "revision", "wall_time", "simulated_time", "speed", "peak_memory"}) {
    EXPECT_TRUE(tree["run"].contains(name)) << name;
  }
  EXPECT_NEAR(tree["run"]["speed"]["value"].get<double>() * tree["run"]["wall_time"]["value"].get<double>(),
              tree["run"]["simulated_time"]["value"].get<double>(), 1e-9);
  EXPECT_EQ(tree["performance"]["frame_rate"]["window"], "frames 8 to 9");
  EXPECT_GT(tree["performance"]["frame_rate"]["value"], 0);
  EXPECT_TRUE(tree["quality"].contains("bad_2"));
  EXPECT_TRUE(tree["configuration"].is_object());
  EXPECT_NE(tree["configuration"].dump().find("\"p1\""), std::string::npos);
}

TEST_F(RunResults, OfASinglePair) {
  ASSERT_EQ(program_("scene --size 96x64 --disparities 32 --rectified --out in").code, 0);
  run("--left in/left.png --right in/right.png --ground-truth in/disp_gt.png --mask in/mask_nocc.png --out "
      "out");
  std::vector<std::string> expected = kFrameFiles;
  expected.push_back("timing.json");
  EXPECT_EQ(program_.files("out"), expected) << "without a calibration there are no points";
  check_frame("out/", 96, 64);
  const json tree = timing("out/");
  check_metrics(tree, "");
  EXPECT_FALSE(tree["run"].contains("seed"));
  EXPECT_GT(tree["quality"]["coverage"]["value"], 30);
}

TEST_F(RunResults, OfASequence) {
  ASSERT_EQ(program_("scene --size 96x64 --disparities 32 --frames 3 --out in").code, 0);
  run("--input in --calibration in/calib.yml --out out");
  std::vector<std::string> expected;
  for (const std::string folder : {"frame_0000/", "frame_0001/", "frame_0002/"}) {
    expected.push_back(folder);
    for (const std::string& file : kFrameFiles) expected.push_back(folder + file);
    expected.push_back(folder + "points.ply");
    check_frame("out/" + folder, 96, 64);
  }
  expected.push_back("timing.json");
  EXPECT_EQ(program_.files("out"), expected);
  const json tree = timing("out/");
  check_metrics(tree, "");
  EXPECT_EQ(tree["input"]["frames_with_images"]["value"], 3);
  EXPECT_EQ(tree["input"]["frames"]["value"], 9);
}

TEST_F(RunResults, OfAFrameAlone) {
  run("--size 64x48 --timing-frames 1 --out out");
  check_metrics(timing("out/"), "");
}

TEST_F(RunResults, TheSameInputGivesTheSameBytes) {
  const auto results = [&] {
    run("--size 96x64 --frames 2 --out out");
    std::map<std::string, std::string> contents;
    for (const std::string& name : program_.files("out")) {
      if (name.back() != '/') contents[name] = program_.read("out/" + name);
    }
    json tree = json::parse(contents["timing.json"]);
    for (const char* name : {"wall_time", "speed", "peak_memory"}) tree["run"].erase(name);
    contents["timing.json"] = tree.dump();
    return contents;
  };
  const auto first = results();
  EXPECT_EQ(first.size(), 2 * 7U + 1);
  EXPECT_TRUE(first == results());
}

TEST_F(RunResults, TheCommandInTimingMakesTheRunAgain) {
  std::filesystem::create_directory(program_ / "o'ut");
  run("--size 64x48 --set matching.paths=w,n --out o'ut/it");
  EXPECT_EQ(timing("o'ut/it/")["run"]["command"]["value"],
            "parallax run --disparities 32 --size 64x48 --set matching.paths=w,n --out 'o'\\''ut/it'");
}

TEST_F(RunResults, MemoryStaysFlatOverASequence) {
#ifdef PARALLAX_SANITIZED
  GTEST_SKIP() << "the sanitizer keeps freed memory for a while";
#endif
  const auto peak = [&](int frames) {
    run("--size 160x128 --frames " + std::to_string(frames) + " --out out");
    return timing("out/")["run"]["peak_memory"]["value"].get<double>();
  };
  EXPECT_LT(peak(100), peak(10) + 4.0);
  EXPECT_EQ(program_.files("out").size(), 100 * 8U + 1);
}

TEST_F(RunResults, JsonIsAllThatJsonPrints) {
  const test::Outcome outcome = run("--size 64x48 --json --out out");
  const json printed = json::parse(outcome.out);
  EXPECT_EQ(printed, timing("out/"));
}

TEST_F(RunResults, QuietPrintsNothing) {
  // A size that asks for a note otherwise.
  const test::Outcome outcome = run("--size 75x50 --out out --quiet");
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "");
  check_frame("out/", 75, 50);
  EXPECT_TRUE(json::parse(run("--size 75x50 -q --json").out).is_object());
}

TEST_F(RunResults, VerbosePrintsTheStagesToo) {
  const std::string normal = run("--size 64x48").out;
  const std::string verbose = run("--size 64x48 --verbose").out;
  EXPECT_EQ(normal.find("stage "), std::string::npos);
  EXPECT_NE(verbose.find("stage "), std::string::npos) << verbose;
}

TEST_F(RunResults, OtherCommandsAreQuietToo) {
  const test::Outcome encoded = program_("map encode --identity 64x48 -o a.map --quiet");
  EXPECT_EQ(encoded.code, 0);
  EXPECT_EQ(encoded.out + encoded.err, "");
  const test::Outcome scene = program_("scene --size 64x48 --out scene --quiet");
  EXPECT_EQ(scene.code, 0);
  EXPECT_EQ(scene.out + scene.err, "");
  EXPECT_TRUE(json::parse(program_("map info a.map --json --quiet").out).is_object());
}

}  // namespace
}  // namespace parallax
