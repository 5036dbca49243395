// SPDX-License-Identifier: Apache-2.0
#include "modules/matching_stage.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "modules/area.hpp"

namespace parallax {
namespace {

// Cycles from the start of a pixel's last iteration until the next pixel's first one may start, as far as the
// recurrence decides.
std::uint32_t last_interval(const MatchingConfig& config, std::uint32_t interval) {
  const std::int64_t latency = config.recurrence_latency;
  if (config.recurrence_order == RecurrenceOrder::kPlain) return static_cast<std::uint32_t>(latency);
  const std::int64_t before = std::int64_t{interval} * (config.iterations - 1);  // those before the last one
  return static_cast<std::uint32_t>(std::max<std::int64_t>(latency - before, 1));
}

}  // namespace

MatchingStage::MatchingStage(const sc_core::sc_module_name& name, const MatchingConfig& config, int code_bits,
                             const StageTiming& timing, const StageContext& context)
    : Stage(name, context.clock, context.dataflow, timing.latency),
      kernel_(std::in_place, config, context.width, context.height, code_bits),
      changes_(context.height),
      codes_(context.width, context.width,
             [this, context, code_bits, length = area(context.width, config.range().count)](
                 const CensusCode* left, const CensusCode* right) {
               if (const auto change = changes_.at_row()) {
                 kernel_.emplace(*change, context.width, context.height, code_bits);
                 if (taps_ != nullptr) kernel_->open(*taps_);
               }
               kernel_->push(
                   left, right, [this, length](const Cost* costs) { out_costs.send_row(costs, length); },
                   keeper_);
             }),
      look_ahead_(look_ahead_tokens(context, kernel_->look_ahead_rows(), kernel_->look_ahead_pixels())),
      storage_(kernel_->storage_bits()),
      store_(kernel_->store()),
      frame_kept_(context.height) {
  const std::size_t width = context.width;
  RasterSchedule raster;
  raster.groups = config.groups(context.pixels_per_token).of_token;
  raster.step = static_cast<std::uint32_t>(config.iterations);
  raster.last_interval = last_interval(config, timing.interval);
  raster.reads.first = 0b11;
  raster.writes.every = 0b1;
  PortMask in = 0b100;  // the next ones to be declared
  PortMask out = 0b10;
  if (context.height > 1 && store_.first_pass_row + store_.second_pass_row > 0) {
    in_rows = std::make_unique<StreamIn<std::uint8_t>>("in_rows");
    out_rows = std::make_unique<StreamOut<std::uint8_t>>("out_rows");
    const RasterSchedule::RowStore rows{{0, in, 0}, {0, 0, out}};
    if (store_.first_pass_row > 0) raster.first_pass = rows;
    if (store_.second_pass_row > 0) raster.second_pass = rows;
    in = static_cast<PortMask>(in << 1);
    out = static_cast<PortMask>(out << 1);
    keep_rows();
  }
  if (store_.frame > 0) {
    in_frame = std::make_unique<StreamIn<std::uint8_t>>("in_frame");
    out_frame = std::make_unique<StreamOut<std::uint8_t>>("out_frame");
    raster.reads_late.first = in;
    raster.writes_early.last = out;
    keep_frame();
  }
  raster.look_ahead = look_ahead_;
  raster.timing = timing;
  set_schedule(make_schedule(context, raster));
  in_left.on_row(width, [this](const CensusCode* row, std::size_t) { codes_.push_a(row); });
  in_right.on_row(width, [this](const CensusCode* row, std::size_t) { codes_.push_b(row); });
}

void MatchingStage::keep_rows() {
  keeper_.row = [this](const std::uint8_t* records, std::size_t bytes) {
    rows_kept_.leave(records, bytes);
    out_rows->send_row(records, bytes);
  };
  in_rows->on_row(0, [this](const std::uint8_t* records, std::size_t bytes) {
    if (!rows_kept_.come_back(records, bytes)) SC_REPORT_ERROR("/parallax/matching/kept", in_rows->name());
  });
}

void MatchingStage::keep_frame() {
  keeper_.frame = [this](const std::uint8_t* records, std::size_t bytes) {
    frame_kept_.leave(records, bytes);
    out_frame->send_row(records, bytes);
  };
  in_frame->on_row(0, [this](const std::uint8_t* records, std::size_t bytes) {
    if (!frame_kept_.come_back(records, bytes)) SC_REPORT_ERROR("/parallax/matching/kept", in_frame->name());
  });
}

}  // namespace parallax
