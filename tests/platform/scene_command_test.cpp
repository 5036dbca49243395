// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/scene_command.hpp"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <opencv2/core.hpp>
#include <sstream>

#include "platform/commands/command_context.hpp"
#include "platform/images/image_codecs.hpp"
#include "platform/input/image_input.hpp"
#include "platform/scene/scene.hpp"
#include "tests/platform/error_line.hpp"
#include "tests/platform/temporary_folder.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace scene_command_test {

int run(const std::string& arguments) {
  CLI::App app;
  std::ostringstream out;
  CommandContext context{out, out, CommandLine(0, nullptr)};
  add_scene_command(app, context);
  app.parse("scene " + arguments);
  return context.action();
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

TEST(SceneCommand, OnePair) {
  const TemporaryFolder folder;
  EXPECT_EQ(run("--out " + (folder / "a/b") + " --size 96x64 --disparities 32 --seed 5"), 0);
  SceneConfig config;
  config.width = 96;
  config.height = 64;
  config.disparities = 32;
  config.seed = 5;
  const Scene scene(config);
  const StereoImages images = scene.render(0);
  const SceneTruth truth = scene.truth(0);
  const auto read = [&](const std::string& name) { return read_image(folder / ("a/b/" + name)); };
  EXPECT_TRUE(same(read("left.png"), images.left));
  EXPECT_TRUE(same(read("right.png"), images.right));
  EXPECT_TRUE(same(read("disp_gt.png"), truth.disparity));
  EXPECT_TRUE(same(read("mask_nocc.png"), truth.mask));
  cv::FileStorage calibration((folder / "a/b/calib.yml"), cv::FileStorage::READ);
  EXPECT_EQ(static_cast<int>(calibration["image_width"]), 96);
}

TEST(SceneCommand, SequenceIsASequenceForTheImageInput) {
  const TemporaryFolder folder;
  EXPECT_EQ(run("--out " + folder.path().string() + " --size 33x17 --frames 3 --rectified"), 0);
  ImageInput input(find_image_pairs(folder.path()), {}, {});
  EXPECT_EQ(input.frames(), 3u);
  EXPECT_EQ(input.paths(2).left.filename(), "left_02.png");
  SceneConfig config;
  config.width = 33;
  config.height = 17;
  config.distortion = false;
  EXPECT_TRUE(same(input.load(2).right, Scene(config).render(2).right));
}

TEST(SceneCommand, Errors) {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& arguments) {
    return error_line<UserError>([&] { run("--out " + (folder / "new") + " " + arguments); });
  };
  EXPECT_EQ(error("--size 640"), "--size is '640', expected width x height such as 640x480");
  EXPECT_EQ(error("--size 640x480x3"), "--size is '640x480x3', expected width x height such as 640x480");
  EXPECT_EQ(error("--size 70000x480"), "scene.width is 70000, allowed is 1 to 65536");
  EXPECT_EQ(error("--frames 0"), "--frames is 0, allowed is 1 and more");
  EXPECT_FALSE(std::filesystem::exists(folder / "new"));
  EXPECT_EQ(error_line<UserError>([] { run("--size 8x8 --out /dev/null/x"); }),
            "cannot make the output folder /dev/null/x: /dev/null is a file");
}

}  // namespace scene_command_test
}  // namespace parallax
