// SPDX-License-Identifier: Apache-2.0
// What the host receives from a whole run equals, bit for bit, the plain kernels one after the other.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "modules/rectification.hpp"
#include "platform/config/configuration.hpp"
#include "platform/config/preset.hpp"
#include "platform/images/image_codecs.hpp"
#include "platform/input/image_padding.hpp"
#include "platform/input/map_builder.hpp"
#include "platform/input/read_calibration.hpp"
#include "platform/results/disparity_bin.hpp"
#include "tests/cli/program.hpp"
#include "tests/fidelity/stereo_chain.hpp"
#include "tests/paths.hpp"

namespace parallax {
namespace run_chain_test {

struct Case {
  std::string name;
  cv::Size size;
  std::vector<std::string> settings;
  bool rectified = true;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

/// The next row of a map that is smaller than the padded image: its last column and row go on.
std::vector<OffsetPair> padded_row(const RectificationMap& map, int y, int width) {
  const OffsetPair* row = map.row(std::min(y, map.height - 1));
  std::vector<OffsetPair> padded(row, row + map.width);
  padded.resize(static_cast<std::size_t>(width), padded.back());
  return padded;
}

StereoImages rectify(const RectificationConfig& config, const RectificationMap& map,
                     const StereoImages& images) {
  const int width = images.left.cols;
  const int height = images.left.rows;
  StereoImages out{cv::Mat(images.left.size(), CV_8UC1), cv::Mat(images.left.size(), CV_8UC1)};
  Rectification rectification(config, width, height);
  int rows = 0;
  const auto emit = [&](const Gray* left, const Gray* right) {
    std::copy(left, left + width, out.left.ptr<Gray>(rows));
    std::copy(right, right + width, out.right.ptr<Gray>(rows));
    ++rows;
  };
  for (int y = 0, next = 0; y < height; ++y) {
    rectification.push_map(padded_row(map, y, width).data(), emit);
    while (next < height && rectification.can_push_images()) {
      rectification.push_images(images.left.ptr<Gray>(next), images.right.ptr<Gray>(next), emit);
      ++next;
    }
  }
  EXPECT_EQ(rows, height);
  return out;
}

class RunChain : public ::testing::TestWithParam<Case> {};

TEST_P(RunChain, HostReceivesWhatTheKernelsCompute) {
  const Case& test_case = GetParam();
  const cv::Size size = test_case.size;
  const test::Program program;
  const std::string scene = fmt::format("scene --size {}x{} --disparities 32 --out in {}", size.width,
                                        size.height, test_case.rectified ? "--rectified" : "");
  ASSERT_EQ(program(scene).code, 0);
  std::string arguments =
      "run --no-verdict --left in/left.png --right in/right.png --timing-frames 2 --out out";
  if (!test_case.rectified) arguments += " --calibration in/calib.yml";
  for (const std::string& setting : test_case.settings) arguments += " --set " + setting;
  const test::Outcome outcome = program(arguments);
  ASSERT_EQ(outcome.code, 0) << outcome.err;

  ConfigurationRequest request;
  request.assignments = test_case.settings;
  const MachineConfig config = load_configuration(request, {test::source_path("platform/presets")}).machine;
  const auto read = [&](const std::string& name) { return read_image((program / name).string()); };
  const StereoImages raw{read("in/left.png"), read("in/right.png")};
  ASSERT_EQ(raw.left.size(), size);
  const RectificationMap map =
      test_case.rectified
          ? identity_map(size.width, size.height, config.rectification.range)
          : build_map(read_calibration({(program / "in/calib.yml").string()}, {size.width, size.height}),
                      config.rectification.range);
  const StereoImages images = rectify(config.rectification, map, pad_images(raw, config.image.granularity()));
  const std::vector<Disparity> expected =
      crop_disparities(test::run_chain(config, images.left, images.right), images.left.cols, size);

  const std::string bytes = program.read("out/disparity.bin");
  const std::vector<std::uint16_t> values =
      unpack_disparities({bytes.begin(), bytes.end()}, size.width, size.height);
  const cv::Mat causes = read("out/cause_labels.png");
  const cv::Mat left = read("out/left_rectified.png");
  ASSERT_EQ(values.size(), expected.size());
  std::size_t valid = 0;
  for (int y = 0, i = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x, ++i) {
      const Disparity& d = expected[static_cast<std::size_t>(i)];
      ASSERT_EQ(values[static_cast<std::size_t>(i)], d.value) << x << ' ' << y;
      ASSERT_EQ(causes.at<std::uint8_t>(y, x), static_cast<int>(d.cause)) << x << ' ' << y;
      ASSERT_EQ(left.at<Gray>(y, x), images.left.at<Gray>(y, x)) << x << ' ' << y;
      valid += d.valid() ? 1 : 0;
    }
  }
  if (size.width >= 64 && size.height >= 32) {
    EXPECT_GT(valid, expected.size() / 10) << "a map without values proves little";
  }
}

const std::vector<std::string> kSmall{"matching.iterations=1"};

std::vector<std::string> with(std::vector<std::string> settings) {
  settings.insert(settings.begin(), kSmall.begin(), kSmall.end());
  return settings;
}

const std::vector<std::string> kNoFilters{"uniqueness.enabled=false",        "consistency.enabled=false",
                                          "texture.enabled=false",           "speckle.iterations=0",
                                          "gap_interpolation.enabled=false", "noise_reduction.enabled=false"};

std::vector<Case> cases() {
  std::vector<Case> list{
      {"whole_tiles", {96, 64}, kSmall},
      {"padded_both", {75, 50}, kSmall},
      {"padded_width", {97, 48}, kSmall},
      {"padded_height", {64, 33}, kSmall},
      {"one_column", {1, 40}, kSmall},
      {"one_row", {64, 1}, kSmall},
      {"one_pixel", {1, 1}, kSmall},
      {"narrower_than_the_range", {40, 32}, {"matching.iterations=4"}},
      {"default_range", {160, 96}, {}},
      {"range_256", {320, 48}, {"matching.iterations=8"}},
      {"offset", {96, 64}, with({"matching.disparity_offset=3"})},
      {"p_16_n_i_3", {96, 64}, {"matching.parallelism=16", "matching.iterations=3"}},
      {"p_64_n_i_1", {96, 64}, {"matching.parallelism=64", "matching.iterations=1"}},
      {"p_1_n_i_20", {64, 32}, {"matching.parallelism=1", "matching.iterations=20"}},
      {"eight_paths", {96, 64}, with({"matching.paths=w,nw,n,ne,e,sw,s,se"})},
      {"two_paths", {96, 64}, with({"matching.paths=w,n"})},
      {"census_7x7", {96, 64}, with({"census.window_width=7", "census.window_height=7"})},
      {"delay_line_census", {96, 64}, with({"census.border=delay_line", "subpixel.mask_border=false"})},
      {"grey_values", {96, 64}, with({"census.enabled=false", "matching.cost=absolute_difference"})},
      {"delay_line_outside",
       {96, 64},
       with({"matching.outside_cost=delay_line", "matching.paths=w,nw,n,ne,s"})},
      {"narrow_path_costs",
       {96, 64},
       with({"matching.path_bits=6", "matching.sum_shift=1", "matching.path_start=first_column",
             "matching.path_storage=memory"})},
      {"median_3x3", {96, 64}, with({"noise_reduction.kind=median_3x3"})},
      {"median_5x5", {96, 64}, with({"noise_reduction.kind=median_5x5"})},
      {"no_border_mask", {96, 64}, with({"subpixel.mask_border=false"})},
      {"penalties", {96, 64}, with({"matching.p1=3", "matching.p2=120"})},
      {"no_filters", {96, 64}, with(kNoFilters)},
      {"unrectified", {160, 96}, kSmall, false},
      {"unrectified_padded", {150, 90}, kSmall, false},
      {"no_granularity", {75, 50}, with({"image.width_granularity=1", "image.height_granularity=1"})},
  };
  Case bare{"no_filters_padded_eight_paths", {75, 50}, with(kNoFilters)};
  bare.settings.insert(bare.settings.end(),
                       {"matching.paths=w,nw,n,ne,e,sw,s,se", "subpixel.mask_border=false"});
  list.push_back(bare);
  for (const std::string& setting : kNoFilters) {
    list.push_back({"without_" + setting.substr(0, setting.find('.')), {96, 64}, with({setting})});
  }
  return list;
}

INSTANTIATE_TEST_SUITE_P(On, RunChain, ::testing::ValuesIn(cases()),
                         [](const auto& chosen) { return chosen.param.name; });

}  // namespace run_chain_test
}  // namespace parallax
