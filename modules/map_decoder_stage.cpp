// SPDX-License-Identifier: Apache-2.0
#include "modules/map_decoder_stage.hpp"

namespace parallax {
namespace {

Schedule map_schedule(const EncodedMap& map, Bytes word, int pairs, const StageTiming& timing) {
  std::vector<std::uint32_t> end_bit(map.width);
  const auto word_bits = static_cast<std::uint64_t>(word.count()) * 8;
  const Phase firing = fires().every(timing.interval);
  Firings firings;
  std::uint64_t read_bits = 0;  // of the frame's stream, in the words read so far
  std::uint64_t row_start = 0;  // byte of the frame's stream
  for (int y = 0; y < map.height; ++y) {
    map_code_ends(map.bytes.data() + row_start, map.row_bytes[y], map.range, y, end_bit);
    for (std::size_t last = pairs - 1; last < end_bit.size(); last += pairs) {
      const std::uint64_t needed = row_start * 8 + end_bit[last];
      while (read_bits + word_bits < needed) {
        firings.add(firing.reads(0b1));
        read_bits += word_bits;
      }
      if (read_bits < needed) {
        firings.add(firing.reads(0b1).writes(0b1));
        read_bits += word_bits;
      } else {
        firings.add(firing.writes(0b1));
      }
    }
    row_start += map.row_bytes[y];
    firings.add(idles(timing.row_overhead));
  }
  // The padding of the last word belongs to no row; a word that holds nothing else is read all the same.
  for (; read_bits < map.bytes.size() * 8; read_bits += word_bits) firings.add(firing.reads(0b1));
  firings.add(idles(timing.frame_overhead));
  return Schedule().run(firings);
}

}  // namespace

MapDecoderStage::MapDecoderStage(const sc_core::sc_module_name& name, const EncodedMap& map, Bytes word,
                                 const StageTiming& timing, const StageContext& context)
    : Stage(name, context.clock, context.dataflow, timing.latency),
      kernel_(map.range, map.width, map.height),
      row_(map.width) {
  set_schedule(map_schedule(map, word, context.pixels_per_token, timing));
  in_words.on_row(0, [this](const std::uint8_t* bytes, std::size_t size) {
    kernel_.push(bytes, size, row_.data());
    out_map.send_row(row_.data(), row_.size());
  });
}

}  // namespace parallax
