// SPDX-License-Identifier: Apache-2.0
// Runs with something wrong, and what a fault must not do.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "platform/images/image_codecs.hpp"
#include "platform/results/output_file.hpp"
#include "tests/cli/program.hpp"

namespace parallax::test {

inline cv::Mat noise(int width, int height, int type = CV_8UC1) {
  cv::Mat image(height, width, type);
  cv::theRNG().state = 1;
  cv::randu(image, 0, 256);
  return image;
}

class BadInput : public ::testing::Test {
 protected:
  void SetUp() override {
    image("left.png", noise(64, 48));
    image("right.png", noise(64, 48));
  }

  void image(const std::string& name, const cv::Mat& pixels) const {
    write_file(program_ / name, encode_image(std::filesystem::path(name).extension(), pixels));
  }
  void text(const std::string& name, const std::string& content) const {
    program_.folder().write(name, content);
  }
  void truncate(const std::string& name, std::uintmax_t size) const {
    std::filesystem::resize_file(program_ / name, size);
  }

  /// The one error line of a run into the new folder "out"; also checks all that a fault must not do.
  std::string error(const std::string& arguments, const std::function<void()>& prepare = {}) const {
    const auto before = program_.files();
    const Outcome outcome = program_("run --disparities 32 --out out " + arguments, prepare);
    EXPECT_EQ(outcome.code, 2) << arguments << '\n' << outcome.err;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_EQ(program_.files(), before) << arguments;
    const std::string prefix = "parallax: error: ";
    std::vector<std::string> errors;
    for (const std::string& line : lines(outcome.err)) {
      if (line.rfind(prefix, 0) == 0) {
        errors.push_back(line.substr(prefix.size()));
      } else {
        EXPECT_EQ(line.rfind("parallax: note: ", 0), 0U) << line;
      }
    }
    EXPECT_EQ(errors.size(), 1U) << outcome.err;
    return errors.empty() ? "" : errors.front();
  }
  std::string pair_error(const std::string& arguments) const {
    return error("--left left.png --right right.png " + arguments);
  }

  Program program_;
};

}  // namespace parallax::test
