// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "modules/rectification_map.hpp"
#include "platform/input/calibration.hpp"
#include "platform/input/raw_maps.hpp"

namespace parallax {

/// The map of a calibration. Throws UserError when an offset is beyond the window: the line names the image,
/// the first pixel, its offset, how many pixels are affected, and the window or the zoom and shift that would
/// fit.
RectificationMap build_map(const Calibration& calibration, const OffsetRange& range);

/// The same, row by row from the top, without holding the map. When it throws, some rows may have been handed
/// out.
void build_map_rows(const Calibration& calibration, const OffsetRange& range,
                    const RowSink<OffsetPair>& emit);

/// The map of raw x and y maps; `source` names them in messages.
RectificationMap build_map(const RawMaps& maps, const OffsetRange& range, const std::string& source);

}  // namespace parallax
