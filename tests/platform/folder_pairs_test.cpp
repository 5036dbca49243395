// SPDX-License-Identifier: Apache-2.0
#include "platform/input/folder_pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "error_line.hpp"
#include "platform/input/folder_layouts.hpp"
#include "platform/input/image_names.hpp"
#include "temporary_folder.hpp"
#include "tests/paths.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace folder_pairs_test {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

void make(const TemporaryFolder& folder, const Names& files) {
  for (const std::string& file : files) folder.write(file, "x");
}

/// "left right" of each pair, relative to the folder.
Names pairs_of(const Names& files) {
  const TemporaryFolder folder;
  make(folder, files);
  Names found;
  for (const ImagePair& pair : pairs_of_folder(folder.path())) {
    found.push_back(fs::relative(pair.left, folder.path()).string() + " " +
                    fs::relative(pair.right, folder.path()).string());
  }
  return found;
}

std::string error_of_files(const Names& files) {
  const TemporaryFolder folder;
  make(folder, files);
  std::string line = error_line<UserError>([&] { pairs_of_folder(folder.path()); });
  const std::string name = folder.path().string();
  EXPECT_EQ(line.rfind(name, 0), 0u) << line;
  return line.substr(std::min(name.size(), line.size()));
}

TEST(ImageNames, NaturalOrder) {
  EXPECT_TRUE(natural_less("left_9.png", "left_10.png"));
  EXPECT_FALSE(natural_less("left_10.png", "left_9.png"));
  EXPECT_TRUE(natural_less("left_009.png", "left_10.png"));
  EXPECT_TRUE(natural_less("a", "a1"));
  EXPECT_TRUE(natural_less("a2b1", "a2b2"));
  EXPECT_FALSE(natural_less("a", "a"));
  EXPECT_NE(natural_less("a1", "a01"), natural_less("a01", "a1"));
}

TEST(ImageNames, WhatIsNoImageByItsName) {
  const TemporaryFolder folder;
  make(folder, {"a.png", "B.JPG", "disp2.png", "aloeGT.png", "mask_nocc.png", "im0mask.png", "depth.tiff",
                ".half.png", "calib.txt", "disp0.pfm", "display.png"});
  EXPECT_EQ(image_names(folder.path()), (Names{"B.JPG", "a.png", "display.png"}));
  const TemporaryFolder truths;
  make(truths, {"disp2.png", "disp6.png"});
  EXPECT_EQ(image_names(truths.path()), (Names{"disp2.png", "disp6.png"})) << "there is nothing else";
  const TemporaryFolder links;
  fs::create_symlink("nowhere", links.path() / "left.png");
  fs::create_symlink("nowhere", links.path() / "right.png");
  EXPECT_EQ(pairs_of_folder(links.path()).size(), 1u) << "whoever reads it says that it does not exist";
}

struct FolderCase {
  const char* what;
  Names files;
  Names pairs;
};

TEST(FolderPairs, LayoutsOfDataSets) {
  const FolderCase cases[] = {
      {"single", {"left.png", "right.png", "disp_gt.png", "mask_nocc.png"}, {"left.png right.png"}},
      {"numbered",
       {"left_10.png", "right_10.png", "left_9.png", "right_9.png"},
       {"left_9.png right_9.png", "left_10.png right_10.png"}},
      {"one and numbered",
       {"left.png", "right.png", "left_2.png", "right_2.png"},
       {"left.png right.png", "left_2.png right_2.png"}},
      {"camel", {"Left01.jpg", "Right01.jpg"}, {"Left01.jpg Right01.jpg"}},
      {"other spelling", {"Left01.jpg", "right01.jpg"}, {"Left01.jpg right01.jpg"}},
      {"word at the end", {"a_left.png", "a_right.png"}, {"a_left.png a_right.png"}},
      {"word at the end without a bar", {"imgLeft.png", "imgRight.png"}, {"imgLeft.png imgRight.png"}},
      {"word in the middle",
       {"frame_left_0001.png", "frame_right_0001.png"},
       {"frame_left_0001.png frame_right_0001.png"}},
      {"Cityscapes",
       {"a_000019_leftImg8bit.png", "a_000019_rightImg8bit.png"},
       {"a_000019_leftImg8bit.png a_000019_rightImg8bit.png"}},
      {"letter", {"7_l.png", "7_r.png", "8_L.png", "8_R.png"}, {"7_l.png 7_r.png", "8_L.png 8_R.png"}},
      {"letter in front", {"l_01.png", "r_01.png"}, {"l_01.png r_01.png"}},
      {"capital", {"aloeL.jpg", "aloeR.jpg", "aloeGT.png"}, {"aloeL.jpg aloeR.jpg"}},
      {"Middlebury 2014",
       {"im0.png", "im1.png", "im1E.png", "im1L.png", "calib.txt", "disp0.pfm", "disp1.pfm", "disp0y.pfm"},
       {"im0.png im1.png"}},
      {"Middlebury 2014, numbers that go on", {"im0.png", "im1.png", "im10.png"}, {"im0.png im1.png"}},
      {"Middlebury 2003",
       {"im0.ppm", "im1.ppm", "im2.ppm", "im3.ppm", "im4.ppm", "im5.ppm", "im6.ppm", "im7.ppm", "im8.ppm",
        "disp2.pgm", "disp6.pgm"},
       {"im2.ppm im6.ppm"}},
      {"Middlebury 2003, two views", {"im2.png", "im6.png", "disp2.png", "disp6.png"}, {"im2.png im6.png"}},
      {"Middlebury 2006",
       {"view0.png", "view1.png", "view2.png", "view3.png", "view4.png", "view5.png", "view6.png",
        "disp1.png", "disp5.png", "dmin.txt"},
       {"view1.png view5.png"}},
      {"subfolders",
       {"left/2.png", "right/2.png", "left/1.png", "right/1.png"},
       {"left/1.png right/1.png", "left/2.png right/2.png"}},
      {"subfolders in other spelling", {"Left/1.png", "RIGHT/1.png"}, {"Left/1.png RIGHT/1.png"}},
      {"subfolders with sides in the names",
       {"left/left_01.png", "left/left_02.png", "right/right_01.png", "right/right_02.png"},
       {"left/left_01.png right/right_01.png", "left/left_02.png right/right_02.png"}},
      {"KITTI odometry",
       {"image_0/000.png", "image_1/000.png", "image_2/000.png", "image_3/000.png", "calib.txt", "times.txt"},
       {"image_0/000.png image_1/000.png"}},
      {"KITTI 2015",
       {"image_2/000000_10.png", "image_2/000000_11.png", "image_3/000000_10.png", "image_3/000000_11.png",
        "disp_noc_0/000000_10.png", "disp_occ_0/000000_10.png", "calib_cam_to_cam/000000.txt"},
       {"image_2/000000_10.png image_3/000000_10.png", "image_2/000000_11.png image_3/000000_11.png"}},
      {"KITTI 2012, colour only",
       {"colored_0/000000_10.png", "colored_1/000000_10.png", "disp_occ/000000_10.png"},
       {"colored_0/000000_10.png colored_1/000000_10.png"}},
      {"KITTI raw",
       {"image_00/data/0000000000.png", "image_00/timestamps.txt", "image_01/data/0000000000.png",
        "image_02/data/0000000000.png", "image_03/data/0000000000.png", "oxts/data/0000000000.txt"},
       {"image_00/data/0000000000.png image_01/data/0000000000.png"}},
      {"KITTI raw, colour",
       {"image_02/data/0000000005.png", "image_03/data/0000000005.png"},
       {"image_02/data/0000000005.png image_03/data/0000000005.png"}},
      {"EuRoC",
       {"cam0/data/1403715273262142976.png", "cam0/data/1403715273312143104.png", "cam0/data.csv",
        "cam0/sensor.yaml", "cam1/data/1403715273262142976.png", "cam1/data/1403715273312143104.png",
        "imu0/data.csv"},
       {"cam0/data/1403715273262142976.png cam1/data/1403715273262142976.png",
        "cam0/data/1403715273312143104.png cam1/data/1403715273312143104.png"}},
      {"EuRoC, one folder up",
       {"mav0/cam0/data/1.png", "mav0/cam1/data/1.png"},
       {"mav0/cam0/data/1.png mav0/cam1/data/1.png"}},
      {"TartanAir",
       {"image_left/000000_left.png", "image_left/000001_left.png", "image_right/000000_right.png",
        "image_right/000001_right.png", "depth_left/000000_left_depth.npy", "seg_left/000000_left_seg.npy",
        "pose_left.txt"},
       {"image_left/000000_left.png image_right/000000_right.png",
        "image_left/000001_left.png image_right/000001_right.png"}},
      {"TartanAir 2",
       {"image_lcam_front/000000_lcam_front.png", "image_rcam_front/000000_rcam_front.png",
        "depth_lcam_front/000000_lcam_front_depth.png"},
       {"image_lcam_front/000000_lcam_front.png image_rcam_front/000000_rcam_front.png"}},
      {"Sintel",
       {"clean_left/alley_1/frame_0001.png", "clean_left/market_2/frame_0001.png",
        "clean_right/alley_1/frame_0001.png", "clean_right/market_2/frame_0001.png",
        "final_left/alley_1/frame_0001.png", "final_right/alley_1/frame_0001.png",
        "disparities/alley_1/frame_0001.png", "occlusions/alley_1/frame_0001.png",
        "outofframe/alley_1/frame_0001.png"},
       {"clean_left/alley_1/frame_0001.png clean_right/alley_1/frame_0001.png",
        "clean_left/market_2/frame_0001.png clean_right/market_2/frame_0001.png"}},
      {"DrivingStereo",
       {"left-image-half-size/2018-07-09.jpg", "right-image-half-size/2018-07-09.jpg",
        "disparity-map-half-size/2018-07-09.png"},
       {"left-image-half-size/2018-07-09.jpg right-image-half-size/2018-07-09.jpg"}},
      {"DrivingStereo, training",
       {"train-left-image/2018-07-09/a.jpg", "train-right-image/2018-07-09/a.jpg"},
       {"train-left-image/2018-07-09/a.jpg train-right-image/2018-07-09/a.jpg"}},
      {"RealSense",
       {"infra1/000.png", "infra2/000.png", "depth/000.png", "color/000.png"},
       {"infra1/000.png infra2/000.png"}},
      {"RealSense, names that tell",
       {"infra1/infra1_7.png", "infra2/infra2_7.png"},
       {"infra1/infra1_7.png infra2/infra2_7.png"}},
      {"RealSense in one folder",
       {"infra1_0001.png", "infra2_0001.png", "depth_0001.png"},
       {"infra1_0001.png infra2_0001.png"}},
      {"Spring",
       {"frame_left/frame_left_0001.png", "frame_right/frame_right_0001.png",
        "disp1_left/disp1_left_0001.dsp5"},
       {"frame_left/frame_left_0001.png frame_right/frame_right_0001.png"}},
      {"Virtual KITTI 2",
       {"frames/rgb/Camera_0/rgb_00000.jpg", "frames/rgb/Camera_1/rgb_00000.jpg",
        "frames/depth/Camera_0/depth_00000.png", "frames/depth/Camera_1/depth_00000.png"},
       {"frames/rgb/Camera_0/rgb_00000.jpg frames/rgb/Camera_1/rgb_00000.jpg"}},
      {"Virtual KITTI 2, from below",
       {"Camera_0/rgb_00000.jpg", "Camera_1/rgb_00000.jpg"},
       {"Camera_0/rgb_00000.jpg Camera_1/rgb_00000.jpg"}},
      {"New Tsukuba",
       {"left/daylight_L_1.png", "right/daylight_R_1.png"},
       {"left/daylight_L_1.png right/daylight_R_1.png"}},
      {"Falling Things",
       {"0.left.jpg", "0.right.jpg", "0.left.depth.png", "0.right.depth.png", "0.left.seg.png",
        "0.right.seg.png"},
       {"0.left.jpg 0.right.jpg"}},
      {"truth beside the images of the same side",
       {"1_left.jpg", "1_right.jpg", "1_left.disp.png", "1_right.disp.png"},
       {"1_left.jpg 1_right.jpg"}},
      {"two formats", {"left.png", "right.jpg"}, {"left.png right.jpg"}},
      {"two formats, in order",
       {"left_1.png", "right_1.png", "left_2.png", "right_2.JPG", "left_3.png", "right_3.png"},
       {"left_1.png right_1.png", "left_2.png right_2.JPG", "left_3.png right_3.png"}},
      {"the same format first",
       {"left.png", "right.jpg", "right.png", "left.jpg"},
       {"left.jpg right.jpg", "left.png right.png"}},
      {"folders of two formats",
       {"image_2/000000_10.png", "image_3/000000_10.jpg"},
       {"image_2/000000_10.png image_3/000000_10.jpg"}},
      {"folders of two formats with sides in the names",
       {"left/a/left_01.bmp", "right/a/right_01.jpg", "left/a/left_02.bmp", "right/a/right_02.bmp"},
       {"left/a/left_01.bmp right/a/right_01.jpg", "left/a/left_02.bmp right/a/right_02.bmp"}},
      {"half written", {"left.png", "right.png", ".left_2.png"}, {"left.png right.png"}},
  };
  for (const FolderCase& c : cases) {
    SCOPED_TRACE(c.what);
    EXPECT_EQ(pairs_of(c.files), c.pairs);
  }
}

TEST(FolderPairs, TheBestLayoutWins) {
  const FolderCase cases[] = {
      {"exact before a word", {"im0.png", "im1.png", "left.png", "right.png"}, {"im0.png im1.png"}},
      {"a word before a letter",
       {"left.png", "right.png", "al.png", "a_l.png", "a_r.png"},
       {"left.png right.png"}},
      {"complete before incomplete",
       {"image_0/1.png", "image_1/2.png", "image_2/1.png", "image_3/1.png"},
       {"image_2/1.png image_3/1.png"}},
      {"the most pairs",
       {"left/1.png", "right/1.png", "cam0/1.png", "cam1/1.png", "cam0/2.png", "cam1/2.png"},
       {"cam0/1.png cam1/1.png", "cam0/2.png cam1/2.png"}},
      {"pairs of true disparities are none",
       {"img_left.png", "img_right.png", "disp_left.png", "disp_right.png"},
       {"img_left.png img_right.png"}},
  };
  for (const FolderCase& c : cases) {
    SCOPED_TRACE(c.what);
    EXPECT_EQ(pairs_of(c.files), c.pairs);
  }
}

TEST(FolderPairs, AFrameThatLacksOneSide) {
  EXPECT_EQ(error_of_files({"left_1.png", "right_1.png", "left_2.png"}),
            ": the left image left_2.png has no partner right_2.png");
  EXPECT_EQ(error_of_files({"left_1.png", "right_1.png", "right_2.png"}),
            ": the right image right_2.png has no partner left_2.png");
  EXPECT_EQ(error_of_files({"left/1.png", "left/2.png", "right/1.png"}),
            ": the left image left/2.png has no partner right/2.png");
  EXPECT_EQ(error_of_files({"left/1.png", "right/1.png", "right/2.png", "right/3.png"}),
            ": the right image right/2.png has no partner left/2.png, and 1 more have none");
  EXPECT_EQ(error_of_files({"image_left/0_left.png", "image_right/0_right.png", "image_left/1_left.png"}),
            ": the left image image_left/1_left.png has no partner image_right/1_right.png");
  EXPECT_EQ(error_of_files({"im0.png", "im1L.png"}), ": the left image im0.png has no partner im1.png");
  EXPECT_EQ(error_of_files({"cam0/data/1.png", "cam1/data/2.png"}),
            ": the left image cam0/data/1.png has no partner cam1/data/1.png, and 1 more have none");
  EXPECT_EQ(error_of_files({"left.png", "right.jpg", "right.bmp"}),
            ": the left image left.png has no partner right.png, and 2 more have none")
      << "either may be";
  // A pair of another layout does not hide it.
  EXPECT_EQ(error_of_files({"left/1.png", "left/2.png", "left/3.png", "right/1.png", "right/3.png", "a_l.png",
                            "a_r.png"}),
            ": the left image left/2.png has no partner right/2.png");
}

TEST(FolderPairs, NothingFits) {
  for (const Names& files : {Names{}, Names{"photo.png", "left.txt", "right.txt"}, Names{"a_l.png"},
                             Names{"bright.png", "one.png"}}) {
    const std::string line = error_of_files(files);
    EXPECT_EQ(line, " holds no stereo pair; looked for " + folder_layouts_text() +
                        "; or give a list file, two paths a line: left right");
    EXPECT_EQ(line.find('\n'), std::string::npos);
  }
  for (const FolderLayout& layout : folder_layouts()) {
    EXPECT_NE(folder_layouts_text().find(layout.left), std::string::npos) << layout.left;
    EXPECT_NE(folder_layouts_text().find(layout.right), std::string::npos) << layout.right;
  }
  EXPECT_EQ(error_line<UserError>([] { pairs_of_folder("/no/such/place"); }),
            "cannot read the folder /no/such/place: No such file or directory");
}

TEST(FolderPairs, ScenesBelowAreNamed) {
  const TemporaryFolder folder;
  make(folder, {"teddy/im2.png", "teddy/im6.png", "cones/im2.png", "cones/im6.png", "cones/below/left.png",
                "cones/below/right.png", "drives/1/image_00/data/1.png", "drives/1/image_01/data/1.png",
                "odd/left.png", "notes/a.txt", "a/b/c/d/left.png", "a/b/c/d/right.png"});
  const std::string path = folder.path().string();
  EXPECT_EQ(error_line<UserError>([&] { pairs_of_folder(folder.path()); }),
            path +
                " holds no stereo pair itself, but 3 scenes below: cones, drives/1, teddy; to run one: "
                "parallax run --input " +
                path + "/cones");
  EXPECT_EQ(pairs_of_folder(folder.path() / "drives/1").size(), 1u);
  const TemporaryFolder one;
  make(one, {"it's one/left.png", "it's one/right.png"});
  EXPECT_EQ(error_line<UserError>([&] { pairs_of_folder(one.path()); }),
            one.path().string() +
                " holds no stereo pair itself, but a scene below: it's one; to run one: "
                "parallax run --input '" +
                one.path().string() + "/it'\\''s one'");
  const TemporaryFolder many;
  for (int i = 0; i < 12; ++i)
    make(many, {std::to_string(i) + "/left.png", std::to_string(i) + "/right.png"});
  EXPECT_NE(error_line<UserError>([&] {
              pairs_of_folder(many.path());
            }).find("12 scenes below: 0, 1, 2, 3, 4, 5, 6, 7 and 4 more; to run one"),
            std::string::npos);
}

TEST(FolderPairs, ACircleOfLinksEnds) {
  const TemporaryFolder folder;
  make(folder, {"left/a/1.png", "right/a/1.png"});
  fs::create_directory_symlink(folder.path() / "left", folder.path() / "left" / "b");
  EXPECT_NE(error_line<UserError>([&] { pairs_of_folder(folder.path()); }).find("has no partner"),
            std::string::npos);
}

TEST(FolderPairs, RealSequences) {
  for (const auto& [name, frames] : {std::pair("euroc_v101", 8u), {"kitti_seq2", 6u}, {"cones", 1u}}) {
    const std::string folder = test::shared_data(name);
    if (!fs::exists(folder)) GTEST_SKIP() << "no development data";
    EXPECT_EQ(pairs_of_folder(folder).size(), frames) << name;
  }
}

}  // namespace folder_pairs_test
}  // namespace parallax
