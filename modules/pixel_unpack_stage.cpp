// SPDX-License-Identifier: Apache-2.0
#include "modules/pixel_unpack_stage.hpp"

#include <numeric>
#include <vector>

namespace parallax {
namespace {

// The firings for `bytes` bytes, beginning with a burst and a token of so many bits.
std::vector<Phase> cut(std::uint64_t bytes, std::uint64_t burst, std::uint64_t bits) {
  Firings firings;
  std::uint64_t bursts = 0;
  for (std::uint64_t token = 0; token < bytes * 8 / bits; ++token) {
    const std::uint64_t last_byte = ((token + 1) * bits + 7) / 8 - 1;
    const std::uint64_t needed = last_byte / burst + 1;
    for (; bursts + 1 < needed; ++bursts) firings.add(fires().reads(0b1));
    firings.add(fires().reads(bursts < needed ? 0b1 : 0).writes(0b1));
    bursts = needed;
  }
  return firings.phases();
}

}  // namespace

PixelUnpackStage::PixelUnpackStage(const sc_core::sc_module_name& name, const PixelUnpackConfig& config,
                                   const ClockDomain& clock, Dataflow& dataflow)
    : Stage(name, clock, dataflow, 0) {
  const std::uint64_t burst = config.burst.count();
  const std::uint64_t bits = config.pixels * bits_per_pixel(config.format);
  const std::uint64_t period =
      std::lcm(burst * 8, bits) / 8;  // bytes until bursts and tokens begin together again
  Schedule schedule;
  for (std::uint64_t piece = 0; piece < config.pieces; ++piece) {
    schedule.repeat(config.piece_bytes / period, cut(period, burst, bits));
    schedule.repeat(config.piece_bytes % period == 0 ? 0 : 1, cut(config.piece_bytes % period, burst, bits));
  }
  set_schedule(schedule);
  in_bursts.on_row(
      bytes_of(config.format, config.width),
      [this, config, row = std::vector<Gray>(config.width)](const std::uint8_t* bytes, std::size_t) mutable {
        unpack_pixels(config.format, bytes, config.width, row.data());
        out_tokens.send_row(row.data(), row.size());
      });
}

}  // namespace parallax
