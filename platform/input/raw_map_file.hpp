// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "platform/input/raw_maps.hpp"

namespace parallax {

/// Reads raw maps: one OpenCV FileStorage file (YAML, XML, JSON) with the matrices left_x, left_y, right_x,
/// right_y, or four images of 32-bit float (TIFF, PFM) in this order. Throws UserError naming file and
/// matrix.
RawMaps read_raw_maps(const std::vector<std::string>& paths);

/// The files that write_raw_maps() writes: one for .yml, .yaml, .xml or .json, four for .tif or .tiff
/// (NAME_left_x.tiff ...). Throws UserError for another extension.
std::vector<std::string> raw_map_names(const std::string& path);

/// Writes what read_raw_maps() reads, and returns the names written; one file replaces an older one, of four
/// none does. Throws UserError when it cannot.
std::vector<std::string> write_raw_maps(const std::string& path, const RawMaps& maps);

}  // namespace parallax
