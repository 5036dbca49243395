// SPDX-License-Identifier: Apache-2.0
#include "modules/output_packing_stage.hpp"

namespace parallax {
namespace {

// Byte of the frame that is complete after `pixels` pixels.
std::uint64_t packed_bytes(std::uint64_t pixels, int width) {
  const auto row = static_cast<std::uint64_t>(width);
  const std::uint64_t x = pixels % row;
  return pixels / row * OutputPacking::row_bytes(width) + x / 2 * 5;
}

Schedule packing_schedule(Bytes burst, const StageContext& context) {
  const auto size = static_cast<std::uint64_t>(burst.count());
  const std::uint64_t pixels = context.pixels();
  Schedule schedule;
  std::uint64_t bursts = 0;
  std::uint32_t run = 0;  // pixels since the last one that completed a burst
  for (std::uint64_t pixel = 1; pixel <= pixels; ++pixel) {
    const std::uint64_t bytes = packed_bytes(pixel, context.width);
    const std::uint64_t complete = pixel == pixels ? (bytes + size - 1) / size : bytes / size;
    if (complete == bursts) {
      ++run;
      continue;
    }
    schedule.repeat(1, {{run, 1, 0b11, 0}, {1, 1, 0b11, 0b1}});
    run = 0;
    // A burst smaller than a pixel pair leaves in a cycle of its own.
    if (complete - bursts > 1) schedule.run({static_cast<std::uint32_t>(complete - bursts - 1), 1, 0, 0b1});
    bursts = complete;
  }
  return schedule;
}

}  // namespace

OutputPackingStage::OutputPackingStage(const sc_core::sc_module_name& name, Bytes burst,
                                       const StageContext& context)
    : Stage(name, context.clock, context.dataflow, 1),
      kernel_(context.width),
      burst_(burst.count() * 8),
      rows_(static_cast<std::size_t>(context.width), static_cast<std::size_t>(context.width),
            [this, width = context.width](const Gray* left, const Disparity* disparities) {
              if (tap_) tap_(disparities);
              kernel_.push(left, disparities, [this, width](const std::uint8_t* row) {
                out_bursts.send_row(row, OutputPacking::row_bytes(width));
              });
            }) {
  const auto width = static_cast<std::size_t>(context.width);
  set_schedule(packing_schedule(burst, context));
  in_left.on_row(width, [this](const Gray* row, std::size_t) { rows_.push_a(row); });
  in_disparity.on_row(width, [this](const Disparity* row, std::size_t) { rows_.push_b(row); });
}

}  // namespace parallax
