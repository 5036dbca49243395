// SPDX-License-Identifier: Apache-2.0
// Entries of OpenCV's files: which there may be, and which contradict each other.
#include "platform/input/opencv_calibration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "platform/input/read_calibration.hpp"
#include "tests/platform/test_calibrations.hpp"

namespace parallax {
namespace opencv_calibration_test {

using test::message;
using test::SyntheticPair;
using test::with_entry;

class OpenCvCalibration : public test::ChangedCalibrationTest {};

constexpr const char* kRectifiedHead = "%YAML:1.0\n---\ncamera_model: rectified\nimage_size: [640, 480]\n";

std::string matrix_entry(const std::string& name, int rows, int columns, const std::string& data) {
  return name + ": !!opencv-matrix\n   rows: " + std::to_string(rows) +
         "\n   cols: " + std::to_string(columns) + "\n   dt: d\n   data: [ " + data + " ]\n";
}

TEST_F(OpenCvCalibration, ARectifiedPairNeedsNothingButItsSize) {
  const Calibration c =
      read_calibration({write("c.yml", "%YAML:1.0\n---\ncamera_model: rectified\nimage_size: [640, 480]\n")});
  EXPECT_EQ(c.size.width, 640);
  EXPECT_FALSE(c.geometry);
}

TEST_F(OpenCvCalibration, CamerasAndTOfARectifiedPairAreItsProjections) {
  const std::string k2 = matrix_entry("K2", 3, 3, "500, 0, 330, 0, 500, 240, 0, 0, 1");
  const auto with_t = [&](const std::string& t) {
    return write("d.yml", kRectifiedHead + matrix_entry("K1", 3, 3, "500, 0, 320, 0, 500, 240, 0, 0, 1") +
                              k2 + "T: [" + t + "]\n");
  };
  // A rectified right camera 0.1 to the right: T = (-0.1, 0, 0). doffs = 330 - 320.
  const Calibration c = read_calibration({with_t("-0.1, 0.0005, 0")});
  EXPECT_DOUBLE_EQ(c.geometry->baseline, 0.1);
  EXPECT_DOUBLE_EQ(c.geometry->doffs(), 10);
  const std::string file = with_t("-0.1, 0.01, 0");
  EXPECT_EQ(message([&] { read_calibration({file}); }),
            file +
                ": T: the right camera lies -0.01 below and 0 before the left one, more than 2 % of the "
                "baseline of "
                "0.1: rows do not match");
  SyntheticPair pair;
  pair.model = "rectified";
  EXPECT_EQ(message([&] { read_calibration({write("c.yml", pair.text())}); }),
            path("c.yml") + ": R: turns the right camera against the left one, but the images are rectified");
}

TEST_F(OpenCvCalibration, QAloneSufficesForACloud) {
  // cx = 320, cy = 240, f = 500, baseline = 1 / 8 = 0.125, cx_right - cx = 4 = Q(3,3) * baseline.
  const std::string q = matrix_entry("Q", 4, 4, "1, 0, 0, -320, 0, 1, 0, -240, 0, 0, 0, 500, 0, 0, 8, 32");
  for (const std::string& text : {kRectifiedHead + q, "%YAML:1.0\n---\n" + q}) {
    const Calibration c = read_calibration({write("q.yml", text)}, {640, 480});
    EXPECT_EQ(c.model, LensModel::kRectified);
    ASSERT_TRUE(c.geometry);
    EXPECT_DOUBLE_EQ(c.geometry->baseline, 0.125);
    EXPECT_DOUBLE_EQ(c.geometry->focal_x, 500);
    EXPECT_DOUBLE_EQ(c.geometry->focal_y, 500);
    EXPECT_DOUBLE_EQ(c.geometry->cx_left, 320);
    EXPECT_DOUBLE_EQ(c.geometry->cx_right, 324);
    EXPECT_DOUBLE_EQ(c.geometry->cy, 240);
  }
}

TEST_F(OpenCvCalibration, WhatContradictsTheProjectionsIsNamed) {
  const std::string p1 = matrix_entry("P1", 3, 4, "500, 0, 320, 0, 0, 500, 240, 0, 0, 0, 1, 0");
  const std::string p2 =
      matrix_entry("P2", 3, 4, "500, 0, 320, -50, 0, 500, 240, 0, 0, 0, 1, 0");  // 50 / 500 = 0.1
  const auto line = [&](const std::string& rest) {
    const std::string file = write("p.yml", kRectifiedHead + p1 + p2 + rest);
    const std::string text = message([&] { read_calibration({file}); });
    return text.empty() ? text : text.substr(file.size() + 2);
  };
  EXPECT_EQ(line(""), "");
  EXPECT_EQ(line("T: [-0.1, 0, 0]\n"), "");
  EXPECT_EQ(line("T: [-100, 0, 0]\n"),
            "T: contradicts the projections: it puts the right camera 100 to the right of the left one, they "
            "put it "
            "0.1; is one of them in another unit?");
  EXPECT_EQ(line(matrix_entry("Q", 4, 4, "1, 0, 0, -320, 0, 1, 0, -240, 0, 0, 0, 500, 0, 0, 10, 0")), "");
  EXPECT_EQ(line(matrix_entry("Q", 4, 4, "2, 0, 0, -640, 0, 2, 0, -480, 0, 0, 0, 1000, 0, 0, 20, 0")), "")
      << "Q has a common factor";
  EXPECT_EQ(line(matrix_entry("Q", 4, 4, "1, 0, 0, -320, 0, 1, 0, -240, 0, 0, 0, 500, 0, 0, 20, 0")),
            "Q: Q contradicts the projections: baseline 0.05 in Q, 0.1 in them");
  EXPECT_EQ(line(matrix_entry("Q", 4, 4, "1, 0, 0, -320, 0, 1, 0, -240, 0, 0, 0, 700, 0, 0, 10, 0")),
            "Q: Q contradicts the projections: focal length 700 in Q, 500 in them");
  EXPECT_EQ(line(matrix_entry("Q", 4, 4, "1, 0, 0, -320, 0, 1, 0, -250, 0, 0, 0, 500, 0, 0, 10, 0")),
            "Q: Q contradicts the projections: principal point's row 250 in Q, 240 in them");
  EXPECT_EQ(line(matrix_entry("Q", 4, 4, "1, 0, 0, -320, 0, 1, 0, -240, 0, 0, 0, 500, 0, 0, 10, 50")),
            "Q: Q contradicts the projections: distance of the principal points 5 in Q, 0 in them");
  const std::string missing = write("one.yml", kRectifiedHead + p1);
  EXPECT_EQ(message([&] { read_calibration({missing}); }), missing + ": P2 is missing");
}

TEST_F(OpenCvCalibration, RotationsMustAgreeWithR) {
  SyntheticPair pair;
  const Calibration c = read_calibration({write("c.yml", pair.text())});
  cv::FileStorage file(".yml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  file << "R1" << cv::Mat(c.R1.t()) << "R2" << cv::Mat(c.R2) << "P1" << cv::Mat(c.P1) << "P2"
       << cv::Mat(c.P2);
  const std::string text = file.releaseAndGetString();
  const std::string swapped = write("d.yml", pair.text() + text.substr(text.find("R1")));
  EXPECT_EQ(message([&] { read_calibration({swapped}); }),
            swapped + ": R: contradicts R1 and R2: R2 R is not R1");
}

TEST_F(OpenCvCalibration, ModelsThatContradictEachOtherAreRefused) {
  const auto line = [&](const std::string& models, const SyntheticPair& pair = {}) {
    return changed("camera_model", models, pair);
  };
  EXPECT_EQ(line("camera_model: pinhole\ndistortion_model: equidistant"),
            "camera_model: pinhole contradicts distortion_model: equidistant; a lens with equidistant "
            "distortion is "
            "fisheye_equidistant, one with radial-tangential distortion pinhole_radtan, and rectified images "
            "have none");
  EXPECT_EQ(line("distortion_model: plumb_bob\ncamera_model: fisheye")
                .rfind("camera_model: fisheye contradicts", 0),
            0U);
  EXPECT_EQ(line("camera_model: rectified\ndistortion_model: plumb_bob")
                .rfind("camera_model: rectified contradicts", 0),
            0U);
  EXPECT_EQ(line("camera_model: pinhole\ndistortion_model: plumb_bob"), "");
  EXPECT_EQ(line("camera_model: fisheye\ndistortion_model: equidistant", test::fisheye_pair()), "");
  EXPECT_EQ(line("distortion_model: omni"),
            "distortion_model: \"omni\" is not plumb_bob, rational_polynomial or equidistant");
  EXPECT_EQ(line("camera_model: pinhole\ndistortion_model: 3"), "distortion_model is not a text");
}

TEST_F(OpenCvCalibration, EntriesInSeveralPlacesMustBeTheSame) {
  const std::string text = SyntheticPair().text();
  const std::string first = write("a.yml", text);
  const std::string second = write("b.yml", "%YAML:1.0\n---\nT: [-0.2, 0, 0]\n");
  EXPECT_EQ(message([&] { read_calibration({first, second}); }), first + ": T contradicts " + second + ": T");
  const std::string other = write("d.yml", text + "imageSize: [641, 480]\n");
  EXPECT_EQ(message([&] { read_calibration({other}); }),
            other + ": imageSize: 641x480 contradicts image_width, image_height: 640x480");
  const std::string twice = write("e.yml", text + "T: [-0.2, 0, 0]\n");
  EXPECT_EQ(message([&] { read_calibration({twice}); }), twice + ": T occurs twice");
  const std::string unit = write("f.yml", "%YAML:1.0\n---\nT_unit: mm\n");
  EXPECT_EQ(message([&] {
              read_calibration({first, unit});
            }),
            unit + ": T_unit contradicts the same entry elsewhere: \"mm\" and \"m\"");
}

TEST_F(OpenCvCalibration, OpenCvsReasonAndLineAreTold) {
  const auto line = [&](const std::string& text) {
    const std::string file = write("bad.yml", text);
    const std::string whole = message([&] { read_calibration({file}); });
    const std::string prefix = file + ": not an OpenCV YAML, XML or JSON file: ";
    EXPECT_EQ(whole.find(prefix), 0U) << whole;
    EXPECT_EQ(whole.find('\n'), std::string::npos) << whole;
    return whole.substr(std::min(prefix.size(), whole.size()));
  };
  EXPECT_EQ(line("%YAML:1.0\n---\nK1:\t[1, 2]\n"), "line 3: Tabs are prohibited in YAML!");
  EXPECT_EQ(line("%YAML:1.0\n---\nR: [1, 2, 3]\nK1: [1, 2\n"), "line 4: Missing , between the elements");
  EXPECT_EQ(line("%YAML:1.0\n---\nK1: 1\n  K2: 2\n"), "line 4: Incorrect indentation");
  EXPECT_EQ(line("<?xml version=\"1.0\"?>\n<opencv_storage>\n<K1>1</K2>\n</opencv_storage>\n"),
            "line 3: Mismatched closing tag");
  EXPECT_EQ(line("{\"K1\": [1, 2}"), "line 1: Unexpected character");
  EXPECT_EQ(line("<?xml version=\"1.0\"?>\n<opencv_storage>\n</opencv_storage>\nx"), "it ends too early");
  EXPECT_EQ(line("%YAML:1.0\n---\nT: !!binary 1\n"), "line 3: !!binary without | and rows of base64");
  EXPECT_EQ(line(std::string("%YAML:1.0\n---\nT: 1\0\n", 20)), "it holds a zero byte");
  EXPECT_EQ(line("%YAML:1.0\n---\nK1: !!opencv-matrix\n   rows: 3\n   : 3\n"), "an entry has no name");
  EXPECT_EQ(line("%YAML:1.0\n---\n- 1\n- 2\n"), "it has no named entries");
}

TEST_F(OpenCvCalibration, WhatAFileSaysStaysInItsLine) {
  EXPECT_EQ(changed("camera_model", "camera_model: \"a\\nb\""),
            "camera_model: \"a b\" is not pinhole_radtan, fisheye_equidistant or rectified");
  EXPECT_EQ(changed("camera_model", "camera_model: " + std::string(90, 'x')),
            "camera_model: \"" + std::string(60, 'x') +
                "...\" is not pinhole_radtan, fisheye_equidistant or rectified");
}

TEST_F(OpenCvCalibration, ACommentBehindAWordIsNoPartOfIt) {
  EXPECT_EQ(changed("camera_model", "camera_model: pinhole_radtan   # both"), "");
  EXPECT_EQ(
      read_calibration({write("c.yml", with_entry(SyntheticPair().text(), "T_unit", "T_unit: m # metres"))})
          .unit,
      "m");
}

TEST_F(OpenCvCalibration, AMissingFirstLineIsNamed) {
  const std::string text = SyntheticPair().text();
  for (const char* head : {"", "---\n", "# mine\n%YAML:1.0\n---\n"}) {
    const std::string file = write("c.yml", head + text.substr(text.find("camera_model")));
    EXPECT_EQ(
        message([&] { read_calibration({file}); }),
        file +
            ": looks like OpenCV's YAML, but its first line is not %YAML:1.0, without which OpenCV does not "
            "read it");
  }
}

// A rectification of parallel cameras 0.1 apart: 50 / 500.
TEST_F(OpenCvCalibration, TheNamesOfOrbSlam) {
  std::string text =
      "%YAML:1.0\n---\nCamera.fx: 500.0\nCamera.bf: 50.\nLEFT.height: 480\nLEFT.width: 640\n"
      "RIGHT.height: 480\nRIGHT.width: 640\n";
  for (const auto& [side, x] : {std::pair<std::string, const char*>("LEFT", "0"), {"RIGHT", "-50."}}) {
    text += matrix_entry(side + ".D", 1, 5, "-0.28, 0.07, 0.0002, 1.7e-05, 0.") +
            matrix_entry(side + ".K", 3, 3, "458., 0., 367., 0., 457., 248., 0., 0., 1.") +
            matrix_entry(side + ".R", 3, 3, "1., 0., 0., 0., 1., 0., 0., 0., 1.") +
            matrix_entry(side + ".P", 3, 4,
                         "500., 0., 320., " + std::string(x) + ", 0., 500., 240., 0., 0., 0., 1., 0.");
  }
  const Calibration c = read_calibration({write("orb.yml", text)});
  EXPECT_EQ(c.model, LensModel::kPinhole);
  EXPECT_EQ(c.size.width, 640);
  EXPECT_EQ(c.left.camera, cv::Matx33d(458, 0, 367, 0, 457, 248, 0, 0, 1));
  EXPECT_EQ(c.right.distortion, (std::vector<double>{-0.28, 0.07, 0.0002, 1.7e-05, 0}));
  EXPECT_DOUBLE_EQ(c.geometry->baseline, 0.1);
  const std::string other = write("d.yml", with_entry(text, "RIGHT.width", "RIGHT.width: 320"));
  EXPECT_EQ(message([&] { read_calibration({other}); }),
            other + ": LEFT.width contradicts " + other + ": RIGHT.width");
}

TEST_F(OpenCvCalibration, MatricesInBase64AreRead) {
  const SyntheticPair pair;
  cv::FileStorage file(".yml", cv::FileStorage::WRITE_BASE64 | cv::FileStorage::MEMORY);
  file << "image_width" << pair.width << "image_height" << pair.height << "K1" << pair.camera(0) << "D1"
       << pair.coefficients() << "K2" << pair.camera(1) << "D2" << pair.coefficients() << "R"
       << pair.rotation() << "T" << pair.translation();
  const std::string text = file.releaseAndGetString();
  ASSERT_NE(text.find("!!binary |"), std::string::npos);
  EXPECT_EQ(read_calibration({write("b.yml", text)}).P2, read_calibration({write("c.yml", pair.text())}).P2);
}

TEST_F(OpenCvCalibration, HeadsAndLineEndsOfOtherSystemsAreRead) {
  const Calibration plain = read_calibration({write("c.yml", SyntheticPair().text())});
  std::string text = SyntheticPair().text();
  for (std::size_t end = 0; (end = text.find('\n', end)) != std::string::npos; end += 2)
    text.insert(end, "\r");
  EXPECT_EQ(read_calibration({write("d.yml", text)}).P2, plain.P2);
  EXPECT_EQ(read_calibration({write("e.yml", "\xef\xbb\xbf" + text)}).P2, plain.P2);
}

}  // namespace opencv_calibration_test
}  // namespace parallax
