// SPDX-License-Identifier: Apache-2.0
#include "platform/results/ground_truth.hpp"

#include <cstdlib>
#include <fstream>
#include <opencv2/core.hpp>

#include "platform/images/image_codecs.hpp"
#include "tlm/error.hpp"
#include "tlm/units.hpp"

namespace parallax {

namespace {

constexpr int kTruthShift = 8 - kDisparityFractionBits;
constexpr std::uint8_t kScored = 255;

std::string size_text(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

cv::Mat image_of_size(const char* what, const std::string& path, int width, int height) {
  cv::Mat image;
  // OpenCV writes a warning of its own about a file that it cannot open.
  if (std::ifstream(path).good()) image = read_image(path);
  if (image.empty()) throw UserError(path + ": cannot read the " + what + " (missing, or not an image)");
  if (image.cols != width || image.rows != height) {
    throw UserError(path + ": the " + what + " is " + size_text(image.cols, image.rows) +
                    ", the images are " + size_text(width, height));
  }
  return image;
}

std::string format_text(const cv::Mat& image) {
  return std::to_string(8 * image.elemSize1()) + " bit with " + std::to_string(image.channels()) +
         " channel" + (image.channels() == 1 ? "" : "s");
}

template <class T>
std::vector<T> pixels_of(const cv::Mat& image) {
  return {image.begin<T>(), image.end<T>()};
}

}  // namespace

bool GroundTruth::scored(std::size_t pixel) const {
  return disparity[pixel] != 0 && (mask.empty() || mask[pixel] == kScored);
}

int GroundTruth::error(std::size_t pixel, const Disparity& found) const {
  return std::abs((found.value << kTruthShift) - disparity[pixel]);
}

GroundTruth read_ground_truth(const std::string& path, const std::string& mask_path, int width, int height) {
  const cv::Mat truth = image_of_size("ground truth", path, width, height);
  if (truth.type() != CV_16UC1) {
    throw UserError(path + ": the ground truth is " + format_text(truth) +
                    ", it must be 16 bit with 1 channel (disparity * 256, 0 = unknown)");
  }
  GroundTruth result{width, height, pixels_of<std::uint16_t>(truth), {}};
  if (!mask_path.empty()) {
    const cv::Mat mask = image_of_size("ground-truth mask", mask_path, width, height);
    if (mask.type() != CV_8UC1) {
      throw UserError(mask_path + ": the ground-truth mask is " + format_text(mask) +
                      ", it must be 8 bit with 1 channel (255 = score)");
    }
    result.mask = pixels_of<std::uint8_t>(mask);
  }
  bool any = false;
  for (std::size_t i = 0; i < result.disparity.size() && !any; ++i) any = result.scored(i);
  if (!any) {
    throw UserError(path + ": no pixel to score; every disparity is 0 (unknown)" +
                    (mask_path.empty() ? "" : " or masked by " + mask_path));
  }
  return result;
}

GroundTruthScore score(const std::vector<Disparity>& disparity, int width, const GroundTruth& truth) {
  if (width != truth.width || disparity.size() != truth.disparity.size()) {
    const int height = width > 0 ? static_cast<int>(disparity.size()) / width : 0;
    throw UserError("the ground truth is " + size_text(truth.width, truth.height) + ", the disparities are " +
                    size_text(width, height));
  }
  GroundTruthScore result;
  result.pixels = disparity.size();
  for (std::size_t i = 0; i < disparity.size(); ++i) {
    if (!truth.scored(i)) continue;
    ++result.scored;
    if (!disparity[i].valid()) continue;
    ++result.valid;
    const int error = truth.error(i, disparity[i]);
    result.absolute_error += error;
    for (int limit = 1; limit <= GroundTruthScore::kLimits; ++limit) {
      result.bad[limit - 1] += error > limit * GroundTruth::kStepsPerPixel;
    }
  }
  return result;
}

double GroundTruthScore::coverage() const { return quotient(valid, scored); }

double GroundTruthScore::bad_share(int limit) const { return quotient(bad.at(limit - 1), valid); }

double GroundTruthScore::bad_share_all(int limit) const {
  return quotient(bad.at(limit - 1) + scored - valid, scored);
}

double GroundTruthScore::mean_error() const {
  return quotient(absolute_error, valid) / GroundTruth::kStepsPerPixel;
}

GroundTruthScore& GroundTruthScore::operator+=(const GroundTruthScore& other) {
  pixels += other.pixels;
  scored += other.scored;
  valid += other.valid;
  for (std::size_t i = 0; i < bad.size(); ++i) bad[i] += other.bad[i];
  absolute_error += other.absolute_error;
  return *this;
}

std::vector<Quality> GroundTruthScore::qualities() const {
  std::vector<Quality> result = {
      {"scored_pixels", static_cast<double>(scored)},
      {"valid_pixels", static_cast<double>(valid)},
      {"coverage", 100 * coverage()},
      {"mean_error", mean_error()},
  };
  for (int limit = 1; limit <= kLimits; ++limit) {
    const std::string n = std::to_string(limit);
    result.push_back({"bad_" + n, 100 * bad_share(limit)});
    result.push_back({"bad_" + n + "_all", 100 * bad_share_all(limit)});
  }
  return result;
}

}  // namespace parallax
