// SPDX-License-Identifier: Apache-2.0
#include "platform/input/map_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "modules/map_decoder.hpp"
#include "modules/map_file.hpp"
#include "tlm/units.hpp"
#include "traces/number_text.hpp"

namespace parallax {

namespace {

MapInfo::Largest largest(const RectificationMap& map, Offset OffsetPair::*side) {
  int x = 0;
  int y = 0;
  for (const OffsetPair& pair : map.offsets) {
    x = std::max(x, std::abs((pair.*side).dx));
    y = std::max(y, std::abs((pair.*side).dy));
  }
  const double scale = 1 << map.range.fraction_bits;
  return {x / scale, y / scale};
}

nlohmann::json pixels(const MapInfo::Largest& offset) { return {{"x", offset.x}, {"y", offset.y}}; }

}  // namespace

MapInfo inspect(const EncodedMap& encoded) {
  const RectificationMap map = decode(encoded);
  MapInfo info;
  info.width = map.width;
  info.height = map.height;
  info.range = map.range;
  info.stream_bytes = encoded.bytes.size();
  info.file_bytes = to_file_bytes(encoded).size();
  info.bytes_per_pixel = encoded.bytes_per_pixel();
  info.left = largest(map, &OffsetPair::left);
  info.right = largest(map, &OffsetPair::right);
  info.row_bytes = encoded.row_bytes;
  info.least_row = *std::min_element(info.row_bytes.begin(), info.row_bytes.end());
  info.largest_row = *std::max_element(info.row_bytes.begin(), info.row_bytes.end());
  info.mean_row = quotient(info.stream_bytes, info.height);
  info.worst_row = worst_row_bytes(info.width, info.range);
  return info;
}

std::string MapInfo::text(bool rows) const {
  const double worst = quotient(worst_row, 2.0 * width);
  std::string out = fmt::format(
      "size                    {}x{} px\n"
      "window                  {} px (-{}..+{}), {} fraction bits\n"
      "stream                  {} bytes, {} bytes per pixel and image (at most {})\n"
      "file                    {} bytes\n"
      "largest offsets, left   {} px horizontally, {} px vertically\n"
      "largest offsets, right  {} px horizontally, {} px vertically\n"
      "bytes per row           {} least, {} mean, {} largest, {} worst case\n",
      width, height, range.window, range.reach(), range.reach(), range.fraction_bits, stream_bytes,
      number_text(bytes_per_pixel, "B"), number_text(worst, "B"), file_bytes, number_text(left.x, "px"),
      number_text(left.y, "px"), number_text(right.x, "px"), number_text(right.y, "px"), least_row,
      number_text(mean_row, "B"), largest_row, worst_row);
  if (rows) {
    for (std::size_t y = 0; y < row_bytes.size(); ++y) {
      out += fmt::format("row {:5}  {} bytes\n", y, row_bytes[y]);
    }
  }
  return out;
}

void to_json(nlohmann::json& json, const MapInfo& info) {
  json = {{"width_px", info.width},
          {"height_px", info.height},
          {"window_px", info.range.window},
          {"fraction_bits", info.range.fraction_bits},
          {"stream_bytes", info.stream_bytes},
          {"file_bytes", info.file_bytes},
          {"bytes_per_pixel_and_image", info.bytes_per_pixel},
          {"worst_case_bytes_per_pixel_and_image", quotient(info.worst_row, 2.0 * info.width)},
          {"largest_offset_px", {{"left", pixels(info.left)}, {"right", pixels(info.right)}}},
          {"row_bytes",
           {{"least", info.least_row},
            {"mean", info.mean_row},
            {"largest", info.largest_row},
            {"worst_case", info.worst_row},
            {"rows", info.row_bytes}}}};
}

}  // namespace parallax
