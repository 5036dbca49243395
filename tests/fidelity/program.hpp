// SPDX-License-Identifier: Apache-2.0
// The real program, run as a user runs it.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <sstream>
#include <stdexcept>
#include <string>

#include "platform/images/image_codecs.hpp"
#include "tests/paths.hpp"
#include "tests/platform/temporary_folder.hpp"

namespace parallax::test {

/// One `parallax run`; its results live as long as the object.
class ProgramRun {
 public:
  explicit ProgramRun(const std::string& arguments) {
    const std::string command =
        program_path() + " run " + arguments + " --timing-frames 2 --no-verdict --no-point-cloud --out " +
        (folder_ / "out") + " >" + (folder_ / "stdout") + " 2>" + (folder_ / "stderr");
    if (std::system(command.c_str()) != 0) throw std::runtime_error(folder_.read("stderr"));
    results_ = nlohmann::json::parse(folder_.read("out/timing.json"));
  }

  cv::Mat image(const std::string& name) const { return read_image(folder_ / ("out/" + name)); }
  double quality(const std::string& name) const { return results_.at("quality").at(name).at("value"); }
  double map_bytes_per_pixel_and_image() const {
    return results_.at("memory").at("map").at("bytes_per_pixel_and_image").at("value");
  }

 private:
  parallax::TemporaryFolder folder_;
  nlohmann::json results_;
};

}  // namespace parallax::test
