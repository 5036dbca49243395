// SPDX-License-Identifier: Apache-2.0
// What `parallax run` writes and prints.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "platform/images/image_codecs.hpp"
#include "platform/results/disparity_bin.hpp"
#include "platform/results/result_images.hpp"
#include "tests/cli/program.hpp"
#include "tests/paths.hpp"

namespace parallax {
namespace run_results_test {

using nlohmann::json;

/// Of a frame with or without what needs ground truth and a calibration, after `folder`.
std::vector<std::string> frame_files(bool truth, bool points, const std::string& folder = "") {
  std::vector<std::string> files;
  for (const std::string name :
       {"cause_labels.png", "causes.png", "disparity.bin", "disparity.png", "disparity_color.png",
        "error.png", "left_rectified.png", "points.ply", "side_by_side.png"}) {
    if ((truth || name != "error.png") && (points || name != "points.ply")) files.push_back(folder + name);
  }
  return files;
}

class RunResults : public ::testing::Test {
 protected:
  test::Outcome run(const std::string& arguments) const {
    test::Outcome outcome = program_("run --disparities 32 " + arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return outcome;
  }

  cv::Mat image(const std::string& name) const { return read_image((program_ / name).string()); }

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
    EXPECT_EQ(image(folder + "side_by_side.png").cols, 2 * width + 8);
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

  /// error.png against what is beside it.
  void check_error(const std::string& truth_name, const std::string& mask_name,
                   const std::string& folder) const {
    const cv::Mat truth = image(truth_name), mask = image(mask_name);
    const cv::Mat found = image(folder + "disparity.png"), error = image(folder + "error.png");
    const Legend legend = error_legend();
    int kinds[3] = {};
    for (int y = 0; y < truth.rows; ++y) {
      for (int x = 0; x < truth.cols; ++x) {
        const int right = truth.at<std::uint16_t>(y, x), value = found.at<std::uint16_t>(y, x);
        const bool scored = right != 0 && mask.at<std::uint8_t>(y, x) == 255;
        const int kind = !scored ? 0 : value == 0 ? 1 : 2;
        ++kinds[kind];
        const cv::Vec3b expected = kind == 0   ? legend.entries[1].color
                                   : kind == 1 ? legend.entries[0].color
                                               : error_scale().color(std::abs(right - value) / 256.0);
        ASSERT_EQ(error.at<cv::Vec3b>(y, x), expected) << x << ' ' << y;
      }
    }
    for (const int pixels : kinds) EXPECT_GT(pixels, 20);
  }

  /// points.ply against disparity.png and the cameras' projections: u = P1 (X, Y, Z, 1), d = u_left -
  /// u_right.
  void check_points(const std::string& calibration, const std::string& folder) const {
    cv::FileStorage file((program_ / calibration).string(), cv::FileStorage::READ);
    cv::Mat p1, p2;
    file["P1"] >> p1;
    file["P2"] >> p2;
    const double f = p1.at<double>(0, 0), cx = p1.at<double>(0, 2), cy = p1.at<double>(1, 2);
    const double shift = cx - p2.at<double>(0, 2), baseline = -p2.at<double>(0, 3) / f;
    const cv::Mat disparities = image(folder + "disparity.png"), left = image(folder + "left_rectified.png");
    const std::string ply = program_.read(folder + "points.ply");
    const std::string end = "end_header\n";
    const char* next = ply.data() + ply.find(end) + end.size();
    int points = 0;
    for (int y = 0; y < disparities.rows; ++y) {
      for (int x = 0; x < disparities.cols; ++x) {
        const int value = disparities.at<std::uint16_t>(y, x);
        if (value <= 1 || value / 256.0 == shift) continue;  // invalid, or at infinity
        const double z = f * baseline / (value / 256.0 - shift);
        ASSERT_LE(next + 15, ply.data() + ply.size());
        float point[3];
        std::memcpy(point, next, sizeof point);
        EXPECT_NEAR(point[0], (x - cx) * z / f, 1e-5 * std::abs(z));
        EXPECT_NEAR(point[1], (y - cy) * z / f, 1e-5 * std::abs(z));
        EXPECT_NEAR(point[2], z, 1e-5 * std::abs(z));
        for (int channel = 12; channel < 15; ++channel) {
          ASSERT_EQ(static_cast<unsigned char>(next[channel]), left.at<std::uint8_t>(y, x));
        }
        next += 15;
        ++points;
      }
    }
    EXPECT_EQ(next, ply.data() + ply.size());
    EXPECT_GT(points, 1000);
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
    const bool counts = here != "/schema/version";  // an ordinal, of nothing
    EXPECT_EQ((numbers || value.is_number()) && counts, entry["unit"] != "")
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
  std::vector<std::string> expected = frame_files(true, true);
  expected.insert(expected.end(), {"profile.json", "timing.json"});
  std::sort(expected.begin(), expected.end());
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
  EXPECT_EQ(tree["performance"]["frame_rate"]["window"], "frames 10 to 11");
  EXPECT_GT(tree["performance"]["frame_rate"]["value"], 0);
  EXPECT_TRUE(tree["quality"].contains("bad_2"));
  EXPECT_TRUE(tree["configuration"].is_object());
  EXPECT_NE(tree["configuration"].dump().find("\"p1\""), std::string::npos);
}

TEST_F(RunResults, OfASinglePair) {
  ASSERT_EQ(program_("scene --size 96x64 --disparities 32 --rectified --out in").code, 0);
  run("--left in/left.png --right in/right.png --ground-truth in/disp_gt.png --mask in/mask_nocc.png "
      "--ground-truth-scale 256 --out out");
  std::vector<std::string> expected = frame_files(true, false);
  expected.insert(expected.end(), {"profile.json", "timing.json"});
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(program_.files("out"), expected) << "without a calibration there are no points";
  check_frame("out/", 96, 64);
  check_error("in/disp_gt.png", "in/mask_nocc.png", "out/");
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
    for (const std::string& file : frame_files(false, true, folder)) expected.push_back(file);
    check_frame("out/" + folder, 96, 64);
    check_points("in/calib.yml", "out/" + folder);
  }
  expected.insert(expected.end(), {"profile.json", "strip.gif", "timing.json"});
  EXPECT_EQ(program_.files("out"), expected);
  EXPECT_EQ(program_.read("out/strip.gif").substr(0, 6), "GIF89a");
  const json tree = timing("out/");
  check_metrics(tree, "");
  EXPECT_EQ(tree["input"]["frames_with_images"]["value"], 3);
  EXPECT_EQ(tree["input"]["frames"]["value"], 11);
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
  EXPECT_EQ(first.size(), 2 * 9U + 3);
  EXPECT_TRUE(first == results());
}

TEST_F(RunResults, TheCommandInTimingMakesTheRunAgain) {
  std::filesystem::create_directory(program_ / "o'ut");
  run("--size 64x48 --set matching.paths=w,n --out o'ut/it");
  EXPECT_EQ(timing("o'ut/it/")["run"]["command"]["value"],
            "parallax run --disparities 32 --size 64x48 --set matching.paths=w,n --out 'o'\\''ut/it'");
}

TEST_F(RunResults, MemoryStaysFlatOverASequence) {
  if (test::sanitized()) GTEST_SKIP() << "the sanitizer keeps freed memory for a while";
  const auto peak = [&](int frames) {
    run("--size 160x128 --frames " + std::to_string(frames) + " --out out");
    return timing("out/")["run"]["peak_memory"]["value"].get<double>();
  };
  EXPECT_LT(peak(100), peak(10) + 4.0);
  EXPECT_EQ(program_.files("out").size(), 100 * 10U + 3);
}

TEST_F(RunResults, StripThatDoesNotFitLeavesTheFramesOnly) {
  // A limit on the files' size, above that of any file of a frame.
  const test::Outcome outcome = program_("run --disparities 32 --size 96x64 --frames 40 --out out", [] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{150'000, 150'000};
    ::setrlimit(RLIMIT_FSIZE, &small);
  });
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err, "parallax: error: cannot write out/strip.gif: File too large\n");
  const std::vector<std::string> files = program_.files("out");
  EXPECT_GT(files.size(), 5 * 10U);
  EXPECT_EQ(files.size() % 10, 0U) << "whole frames";
  for (const std::string& file : files) EXPECT_EQ(file.rfind("frame_", 0), 0U) << file;
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

TEST_F(RunResults, VerboseNamesTheSynchroniserWhereItHoldsAStageBack) {
  const auto shares = [&](const std::string& more) {
    return run("--timing-only --no-verdict --size 160x128 --verbose " + more).out;
  };
  EXPECT_NE(
      shares("--set streams.default_kind=asynchronous --set streams.default_depth=4").find("% synchroniser"),
      std::string::npos);
  EXPECT_EQ(shares("").find("% synchroniser"), std::string::npos);
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

}  // namespace run_results_test
}  // namespace parallax
