// SPDX-License-Identifier: Apache-2.0
#include "platform/results/truth_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <opencv2/core.hpp>

#include "platform/images/image_file.hpp"
#include "platform/images/image_header.hpp"
#include "platform/images/npy_file.hpp"
#include "platform/images/pfm_file.hpp"
#include "platform/images/zip_archive.hpp"
#include "platform/results/truth_array.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr const char* kTruthFile = "ground truth";
constexpr const char* kMaskFile = "ground-truth mask";

using Notice = std::function<void(const std::string&)>;

// What a file holds, one channel of any depth.
struct TruthValues {
  cv::Mat image;
  double unused_scale = 1;  // of the header of a float map
  bool in_pixels = false;   // by its encoding
};

SizeCheck same_size(const std::string& path, const std::string& what, int width, int height) {
  return [=](const cv::Size& size) {
    if (size == cv::Size(width, height)) return;
    throw UserError(
        fmt::format("{}: the {} is {}, the images are {}x{}", path, what, size_text(size), width, height));
  };
}

std::string format_text(const cv::Mat& image) {
  const char* const kind = image.depth() == CV_32F || image.depth() == CV_64F ? "floating point" : "bit";
  return fmt::format("{} {} with {} channel{}", 8 * image.elemSize1(), kind, image.channels(),
                     image.channels() == 1 ? "" : "s");
}

// The one channel of a grey image, also of one that was stored as colour.
cv::Mat grey(const cv::Mat& image) {
  if (image.channels() == 1) return image;
  std::vector<cv::Mat> channels;
  cv::split(image, channels);
  const auto equal = [&](std::size_t other) {
    return cv::norm(channels[0], channels[other], cv::NORM_INF) == 0;
  };
  const bool is_grey = channels.size() == 2 || (equal(1) && equal(2));  // the last of 2 or 4 is transparency
  return is_grey ? channels[0] : cv::Mat();
}

// The first bytes of a file, all when there are no more.
std::vector<std::uint8_t> bytes_of(const std::string& path, std::size_t most) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file ? std::streamoff(file.tellg()) : 0;
  std::vector<std::uint8_t> bytes(std::min<std::size_t>(most, std::max<std::streamoff>(0, size)));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return bytes;
}

// JPEG keeps what an eye sees, not values.
bool is_jpeg(const std::vector<std::uint8_t>& head) { return head[0] == 0xFF && head[1] == 0xD8; }

[[noreturn]] void refuse_colours(const std::string& path, const cv::Mat& image) {
  throw UserError(fmt::format(
      "{}: the {} is {} that differ: a picture of a disparity map in colours, as it looks, does not hold its "
      "values; expected 1 channel (or equal ones) of 8 or 16 bits or of floating point, disparity * "
      "scale{}",
      path, kTruthFile, format_text(image),
      image.depth() == CV_8U ? "; for values packed into colours as Sintel has them: --ground-truth-encoding "
                               "sintel"
                             : ""));
}

TruthValues read_truth_image(const std::string& path, TruthEncoding encoding, const SizeCheck& check) {
  if (!image_size_of_header(path)) {
    throw UserError(fmt::format(
        "cannot read {} {}: it is damaged, or not a PNG, JPEG, TIFF, BMP, PNM, WebP, PFM, NPY or NPZ file",
        kTruthFile, path));
  }
  const cv::Mat image = read_image_file(path, kTruthFile, check);
  if (encoding == TruthEncoding::kSintel) return {decode_sintel(image, path), 1, true};
  const int depth = image.depth();
  const bool possible = depth == CV_8U || depth == CV_16U || depth == CV_32F || depth == CV_64F;
  const cv::Mat values = grey(image);
  if (values.empty() && possible) refuse_colours(path, image);
  if (!possible) {
    throw UserError(fmt::format(
        "{}: the {} is {}, it must have 1 channel of 8 or 16 bits or of floating point (disparity * scale)",
        path, kTruthFile, format_text(image)));
  }
  return {values};
}

// `most`: bytes that a file of the right size has, and more.
TruthValues read_truth_values(const TruthFiles& files, std::size_t most, const SizeCheck& check,
                              const Notice& notice) {
  const TruthPath where = truth_path(files.truth);
  const std::string& path = where.file;
  require_image_file(path, kTruthFile);
  constexpr std::size_t kHead = 8;
  std::vector<std::uint8_t> head = bytes_of(path, kHead);
  head.resize(kHead);
  const bool archive = ZipArchive::begins(head);
  if (!archive && !where.array.empty()) {
    throw UserError(
        fmt::format("{}: no archive (.npz) that could hold an array {}", path, excerpt(where.array)));
  }
  const bool map = is_pfm(head), array = archive || is_npy(head);
  if ((map || array) && files.encoding != TruthEncoding::kValues) {
    throw UserError(fmt::format("{}: --ground-truth-encoding is for images, this is {}", path,
                                map ? "a float map" : "of NumPy"));
  }
  if (map) {
    const PfmImage pfm = read_pfm(bytes_of(path, most), path, check);
    return {pfm.values, pfm.scale};
  }
  if (array)
    return {read_npy(archive ? truth_array(where, most, notice) : bytes_of(path, most), files.truth, check)};
  if (is_jpeg(head) && notice) {
    notice(
        fmt::format("ground truth {}: JPEG changes values a little; PNG, TIFF, PFM and NPY keep them", path));
  }
  return read_truth_image(path, files.encoding, check);
}

cv::Mat read_mask(const std::string& path, const SizeCheck& check) {
  const cv::Mat image = read_image_file(path, kMaskFile, check);
  cv::Mat mask = grey(image);
  if (mask.type() != CV_8UC1) {
    throw UserError(fmt::format("{}: the {} is {}, it must be 8 bit with 1 channel (255 = score)", path,
                                kMaskFile, format_text(image)));
  }
  return mask;
}

double scale_of(const TruthFiles& files, const TruthValues& values, const Notice& notice) {
  if (values.unused_scale != 1 && notice) {
    notice(
        fmt::format("ground truth {}: the size of the scale in its header, {:g}, is not applied: data sets "
                    "write one that is for viewing",
                    files.truth, values.unused_scale));
  }
  if (files.scale) return *files.scale;
  if (values.in_pixels) return 1;
  const int depth = values.image.depth();
  constexpr double kKitti = 256;
  const double assumed = depth == CV_16U ? kKitti : 1;
  const char* const kind = depth == CV_16U   ? "16-bit integers"
                           : depth == CV_8U  ? "8-bit integers"
                           : depth == CV_32F ? "floating-point values"
                                             : "numbers";
  if (notice) {
    notice(fmt::format("ground truth {}: {}, taken as disparity * {:g}; --ground-truth-scale states another",
                       files.truth, kind, assumed));
  }
  return assumed;
}

std::vector<float> disparities(const cv::Mat& values, double scale) {
  cv::Mat doubles;
  values.convertTo(doubles, CV_64F);
  std::vector<float> result;
  result.reserve(doubles.total());
  for (auto it = doubles.begin<double>(); it != doubles.end<double>(); ++it) {
    const auto disparity = static_cast<float>(*it / scale);
    result.push_back(std::isfinite(disparity) && disparity > 0 ? disparity : 0);
  }
  return result;
}

// Of a truth without a disparity.
void check_sign(const std::string& path, const cv::Mat& values) {
  double least = 0, most = 0;
  cv::minMaxLoc(values, &least, &most);
  if (least < 0 && most <= 0) {
    throw UserError(fmt::format(
        "{}: no value is above 0, the least is {:g}: a disparity is x_left - x_right, and not negative", path,
        least));
  }
}

// Of a mask by which nothing counts.
void check_mask(const std::string& path, const std::vector<std::uint8_t>& mask) {
  constexpr int kScore = 255;
  const int most = mask.empty() ? kScore : *std::max_element(mask.begin(), mask.end());
  if (most != kScore)
    throw UserError(
        fmt::format("{}: marks no pixel: {} says score, its largest value is {}", path, kScore, most));
}

}  // namespace

GroundTruth read_ground_truth(const TruthFiles& files, int width, int height, const Notice& notice) {
  if (files.scale && !(*files.scale > 0 && std::isfinite(*files.scale)))
    throw UserError(fmt::format("--ground-truth-scale is {}, allowed is a number above 0", *files.scale));
  constexpr std::size_t kLargestSample = 8, kLongestHeader = 1 << 16;
  const std::size_t most =
      kLargestSample * static_cast<std::size_t>(width) * static_cast<std::size_t>(height) + kLongestHeader;
  const TruthValues values =
      read_truth_values(files, most, same_size(files.truth, kTruthFile, width, height), notice);
  const double scale = scale_of(files, values, notice);
  GroundTruth result{width, height, disparities(values.image, scale), {}, scale};
  if (!files.mask.empty()) {
    const cv::Mat mask = read_mask(files.mask, same_size(files.mask, kMaskFile, width, height));
    result.mask.assign(mask.begin<std::uint8_t>(), mask.end<std::uint8_t>());
  }
  bool any = false;
  for (std::size_t i = 0; i < result.disparity.size() && !any; ++i) any = result.scored(i);
  if (!any) {
    check_sign(files.truth, values.image);
    check_mask(files.mask, result.mask);
    throw UserError(fmt::format("{}: no pixel to score; every disparity is unknown{}", files.truth,
                                files.mask.empty() ? "" : " or masked by " + files.mask));
  }
  return result;
}

}  // namespace parallax
