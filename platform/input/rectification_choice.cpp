// SPDX-License-Identifier: Apache-2.0
#include "platform/input/rectification_choice.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "platform/input/map_builder.hpp"
#include "platform/input/map_fit.hpp"
#include "platform/input/map_storage.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

RectificationMap padded(const RectificationMap& map, const cv::Size& size) {
  RectificationMap larger{size.width, size.height, map.range, {}};
  larger.offsets.reserve(static_cast<std::size_t>(size.area()));
  for (int y = 0; y < size.height; ++y) {
    const OffsetPair* row = map.row(std::min(y, map.height - 1));
    for (int x = 0; x < size.width; ++x) larger.offsets.push_back(row[std::min(x, map.width - 1)]);
  }
  return larger;
}

RectificationMap map_of_file(const std::string& path, const OffsetRange& range, const FrameSource& source) {
  const EncodedMap encoded = read_map_file(path);
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
  try {
    return decode(encoded);
  } catch (const UserError& error) {
    throw UserError(fmt::format("{}: {}", path, error.what()));
  }
}

Calibration given_calibration(const RunOptions& options, const OffsetRange& range, const FrameSource& source,
                              const NoticeSink& notice) {
  const ImageSize size{source.width(), source.height()};
  Calibration calibration = read_calibration(options.calibration, size);
  check_size(calibration, size);
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
  if (!options.calibration.empty()) calibration = given_calibration(options, range, source, notice);
  RectificationChoice choice;
  if (calibration && calibration->metric()) choice.q = calibration->Q;
  RectificationMap map = identity_map(source.width(), source.height(), range);
  if (!options.map.empty()) {
    map = map_of_file(options.map, range, source);
  } else if (calibration && calibration->model != LensModel::kRectified) {
    map = build_map(*calibration, range);
  }
  choice.map = encode(padded(map, processed));
  return choice;
}

}  // namespace parallax
