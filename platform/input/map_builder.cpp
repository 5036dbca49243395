// SPDX-License-Identifier: Apache-2.0
#include "platform/input/map_builder.hpp"

#include <fmt/format.h>

#include <optional>

#include "platform/input/map_fit.hpp"
#include "tlm/error.hpp"

namespace parallax {

namespace {

std::string remedy(const Calibration& calibration, const OffsetRange& range) {
  if (const std::optional<Fit> found = fit(calibration, range)) {
    return fmt::format(", or --fit: {}", found->text());
  }
  const std::string none = "; no zoom of 0.25..4 and shift fits into this one";
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
  range.validate();
  const RawMaps maps = raw_maps(calibration);
  const WindowSurvey found = survey(maps, range);
  if (!found.fits()) {
    throw UserError(
        fmt::format("{}: {}", calibration.source, describe(found, maps, range, remedy(calibration, range))));
  }
  return quantise(maps, range);
}

RectificationMap build_map(const RawMaps& maps, const OffsetRange& range, const std::string& source) {
  range.validate();
  const WindowSurvey found = survey(maps, range);
  if (!found.fits()) {
    throw UserError(
        fmt::format("{}: {}", source, describe(found, maps, range, ", or maps of another zoom or shift")));
  }
  return quantise(maps, range);
}

}  // namespace parallax
