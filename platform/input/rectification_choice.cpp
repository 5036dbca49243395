// SPDX-License-Identifier: Apache-2.0
#include "platform/input/rectification_choice.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "platform/input/map_builder.hpp"
#include "platform/input/map_fit.hpp"
#include "platform/input/map_storage.hpp"
#include "platform/input/read_calibration.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

// Compresses the map of an image for the larger one that is processed: its offsets repeat the last column's
// and the last row's.
class PaddedMap {
 public:
  PaddedMap(const FrameSource& source, const cv::Size& processed, const OffsetRange& range)
      : width_(source.width()),
        height_(source.height()),
        processed_(processed),
        encoder_(processed.width, processed.height, range),
        row_(processed.width) {}

  void push(const OffsetPair* row) {
    const auto end = std::copy_n(row, width_, row_.begin());
    std::fill(end, row_.end(), row[width_ - 1]);
    encoder_.push(row_.data());
  }
  EncodedMap take() {
    for (int y = height_; y < processed_.height; ++y) encoder_.push(row_.data());
    return encoder_.take();
  }

 private:
  int width_;
  int height_;
  cv::Size processed_;
  MapEncoder encoder_;
  std::vector<OffsetPair> row_;
};

EncodedMap map_of_file(const std::string& path, const OffsetRange& range, const FrameSource& source) {
  EncodedMap encoded = read_map_file(path);
  if (encoded.width != source.width() || encoded.height != source.height()) {
    throw UserError(fmt::format("{}: a map of {}x{} px, but the images have {}x{}", path, encoded.width,
                                encoded.height, source.width(), source.height()));
  }
  if (!(encoded.range == range)) {
    throw UserError(fmt::format(
        "{}: a map for window {} with {} fraction bits, but rectification.window is {} and "
        "rectification.fraction_bits {}; set the keys, or encode the map anew",
        path, encoded.range.window, encoded.range.fraction_bits, range.window, range.fraction_bits));
  }
  return encoded;
}

// Where the principal points are apart, a point at infinity has a disparity, and smaller ones mean nothing.
void note_least_disparity(const Calibration& calibration, const NoticeSink& notice) {
  constexpr double kWorthSaying = 0.01;  // px
  if (!calibration.geometry || calibration.geometry->doffs() > -kWorthSaying) return;
  notice(fmt::format(
      "{}: a point at infinity has the disparity {:.2f} px, as the principal points are so far apart: "
      "points.ply leaves out what has a smaller one, which would lie behind the camera",
      calibration.source, -calibration.geometry->doffs()));
}

// Of a file without a size that is for larger or smaller images nothing else tells.
void note_principal_point(const Calibration& calibration, const NoticeSink& notice) {
  if (!calibration.geometry) return;
  const auto inside = [](double point, int side) {
    constexpr double kLeast = 0.28, kMost = 0.72;  // of the side: images of half or twice the size are beyond
    return point >= kLeast * side && point <= kMost * side;
  };
  const double x = calibration.geometry->cx_left, y = calibration.geometry->cy;
  const ImageSize& size = calibration.size;
  if (inside(x, size.width) || inside(y, size.height)) return;
  notice(
      fmt::format("{}: the principal point ({:.1f}, {:.1f}) is far from the middle of images of {}x{}: is "
                  "the calibration "
                  "for images of another size?",
                  calibration.source, x, y, size.width, size.height));
}

Calibration given_calibration(const RunOptions& options, const OffsetRange& range, const FrameSource& source,
                              const NoticeSink& notice) {
  const ImageSize size{source.width(), source.height()};
  Calibration calibration =
      read_calibration(options.calibration, size, camera_pair("--cameras", options.cameras));
  check_size(calibration, size);
  if (!calibration.choice.empty()) notice(fmt::format("{}: {}", calibration.source, calibration.choice));
  note_principal_point(calibration, notice);
  if (options.fit) {
    if (const std::optional<Fit> found = fit(calibration, range)) {
      notice(found->text());
      return found->calibration;
    }
  }
  return calibration;
}

}  // namespace

RectificationChoice choose_rectification(const RunOptions& options, const OffsetRange& range,
                                         const FrameSource& source, const cv::Size& processed,
                                         const NoticeSink& notice) {
  std::optional<Calibration> calibration = source.calibration();
  if (!options.calibration.empty()) {
    calibration = given_calibration(options, range, source, notice);
    if (options.point_cloud && !options.timing_only && !options.out.empty()) {
      note_least_disparity(*calibration, notice);
    }
  }
  RectificationChoice choice;
  if (calibration && calibration->geometry) choice.q = disparity_to_depth(*calibration->geometry);
  PaddedMap map(source, processed, range);
  const RowSink<OffsetPair> push = [&map](const OffsetPair* row) { map.push(row); };
  if (!options.map.empty()) {
    const EncodedMap file = map_of_file(options.map, range, source);
    try {
      decode_rows(file, push);
    } catch (const UserError& error) {
      throw UserError(fmt::format("{}: {}", options.map, error.what()));
    }
  } else if (calibration && calibration->model != LensModel::kRectified) {
    if (options.calibration.empty() && range.reach() == 0) {
      throw UserError(
          fmt::format("the built-in scene is distorted, but rectification.window = {} rectifies nothing: "
                      "--rectified is the scene "
                      "without distortion",
                      range.window));
    }
    build_map_rows(*calibration, range, push);
  } else {
    const std::vector<OffsetPair> zeros(source.width());
    for (int y = 0; y < source.height(); ++y) push(zeros.data());
  }
  choice.map = map.take();
  return choice;
}

}  // namespace parallax
