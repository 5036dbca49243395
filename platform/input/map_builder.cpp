// SPDX-License-Identifier: Apache-2.0
#include "platform/input/map_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "platform/input/map_fit.hpp"
#include "tlm/error.hpp"

namespace parallax {

namespace {

std::string remedy(const Calibration& calibration, const OffsetRange& range) {
  if (const std::optional<Fit> found = fit(calibration, range)) {
    return fmt::format(", or --fit: {}", found->text());
  }
  std::string none = "; no zoom of 0.25..4 and shift fits into this one";
  OffsetRange wider = range;
  wider.window = smallest_window(calibration, range);
  if (wider.window == 0) {
    return none;
  }
  const std::optional<Fit> found = fit(calibration, wider);
  return none +
         (found ? fmt::format(", but --fit with a window of {}: {}", wider.window, found->text()) : "");
}

}  // namespace

RectificationMap build_map(const Calibration& calibration, const OffsetRange& range) {
  RectificationMap map = identity_map(calibration.size.width, calibration.size.height, range);
  OffsetPair* next = map.offsets.data();
  build_map_rows(calibration, range,
                 [&](const OffsetPair* row) { next = std::copy_n(row, map.width, next); });
  return map;
}

void build_map_rows(const Calibration& calibration, const OffsetRange& range,
                    const RowSink<OffsetPair>& emit) {
  range.validate();
  WindowSurvey found;
  for_each_band(calibration, [&](const RawMaps& band) {
    found.add(band, range);
    if (found.fits()) quantise_rows(band, range, emit);
  });
  if (!found.fits()) {
    throw UserError(
        fmt::format("{}: {}", calibration.source, describe(found, range, remedy(calibration, range))));
  }
}

RectificationMap build_map(const RawMaps& maps, const OffsetRange& range, const std::string& source) {
  range.validate();
  const WindowSurvey found = survey(maps, range);
  if (!found.fits()) {
    throw UserError(
        fmt::format("{}: {}", source, describe(found, range, ", or maps of another zoom or shift")));
  }
  return quantise(maps, range);
}

}  // namespace parallax
