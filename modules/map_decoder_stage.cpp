// SPDX-License-Identifier: Apache-2.0
#include "modules/map_decoder_stage.hpp"

#include <utility>

namespace parallax {
namespace {

// Collects firings, equal neighbours in one phase.
class Firings {
 public:
  explicit Firings(std::uint32_t interval) : interval_(interval) {}

  void add(PortMask consume, PortMask produce) {
    if (!phases_.empty() && phases_.back().consume == consume && phases_.back().produce == produce) {
      ++phases_.back().count;
    } else {
      phases_.push_back({1, interval_, consume, produce});
    }
  }
  /// The row is over; then so many cycles pass.
  void end_row(std::uint32_t cycles) {
    schedule_.repeat(1, phases_);
    if (cycles > 0) schedule_.run({1, cycles, 0, 0});
    phases_.clear();
  }
  Schedule take() { return std::move(schedule_); }

 private:
  std::uint32_t interval_;
  std::vector<Phase> phases_;  // of the row
  Schedule schedule_;
};

Schedule map_schedule(const EncodedMap& map, Bytes word, const StageTiming& timing) {
  MapDecoder decoder(map.range, map.width, map.height);
  std::vector<OffsetPair> row(static_cast<std::size_t>(map.width));
  std::vector<std::uint32_t> end_bit(row.size());
  const auto word_bits = static_cast<std::uint64_t>(word.count()) * 8;
  Firings firings(timing.interval);
  std::uint64_t read_bits = 0;  // of the frame's stream, in the words read so far
  std::uint64_t row_start = 0;  // byte of the frame's stream
  for (int y = 0; y < map.height; ++y) {
    decoder.push(map.bytes.data() + row_start, map.bytes.size() - row_start, row.data(), end_bit.data());
    for (const std::uint32_t end : end_bit) {
      const std::uint64_t needed = row_start * 8 + end;
      while (read_bits + word_bits < needed) {
        firings.add(0b1, 0);
        read_bits += word_bits;
      }
      if (read_bits < needed) {
        firings.add(0b1, 0b1);
        read_bits += word_bits;
      } else {
        firings.add(0, 0b1);
      }
    }
    row_start += map.row_bytes[static_cast<std::size_t>(y)];
    firings.end_row(timing.row_overhead);
  }
  // The padding of the last word belongs to nobody; a word that holds nothing else is read all the same.
  for (; read_bits < map.bytes.size() * 8; read_bits += word_bits) firings.add(0b1, 0);
  firings.end_row(timing.frame_overhead);
  return firings.take();
}

}  // namespace

MapDecoderStage::MapDecoderStage(const sc_core::sc_module_name& name, const EncodedMap& map, Bytes word,
                                 const StageTiming& timing, const StageContext& context)
    : Stage(name, context.clock, context.dataflow, timing.latency),
      kernel_(map.range, map.width, map.height),
      row_(static_cast<std::size_t>(map.width)) {
  set_schedule(map_schedule(map, word, timing));
  in_words.on_row(0, [this](const std::uint8_t* bytes, std::size_t size) {
    kernel_.push(bytes, size, row_.data());
    out_map.send_row(row_.data(), row_.size());
  });
}

}  // namespace parallax
