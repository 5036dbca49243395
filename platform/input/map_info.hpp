// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "modules/map_codec.hpp"

namespace parallax {

/// What `parallax map info` says about a map.
struct MapInfo {
  struct Largest {
    double x = 0;  ///< largest absolute horizontal offset, px
    double y = 0;  ///< vertical, px
  };

  int width = 0;   ///< px
  int height = 0;  ///< px
  OffsetRange range;
  std::size_t stream_bytes = 0;  ///< what the hardware reads for a frame
  std::size_t file_bytes = 0;    ///< with header and row lengths
  double bytes_per_pixel = 0;    ///< stream bytes per pixel and image
  Largest left;
  Largest right;
  std::vector<std::uint32_t> row_bytes;  ///< of each row
  std::uint32_t least_row = 0;           ///< bytes
  std::uint32_t largest_row = 0;         ///< bytes
  double mean_row = 0;                   ///< bytes
  std::size_t worst_row = 0;             ///< bytes that no row of this width and range can exceed

  std::string text(bool rows) const;
};

/// Decodes the map; throws UserError if that fails.
MapInfo inspect(const EncodedMap& map);

void to_json(nlohmann::json& json, const MapInfo& info);

}  // namespace parallax
