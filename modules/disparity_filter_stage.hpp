// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <systemc>
#include <type_traits>
#include <utility>

#include "modules/frame_changes.hpp"
#include "modules/pixel.hpp"
#include "modules/raster_schedule.hpp"
#include "tlm/stage.hpp"

namespace parallax {

/// A filter of the disparity map, whatever it does: one disparity in, one out.
class FilterStage : public Stage {
 public:
  StreamIn<Disparity> in_disparity{"in_disparity"};
  StreamOut<Disparity> out_disparity{"out_disparity"};

  /// Tokens read beyond the one written.
  virtual std::uint64_t look_ahead() const = 0;
  virtual Bits storage() const = 0;

 protected:
  using Stage::Stage;
};

namespace detail {

template <class Kernel, class = void>
struct TellsPixelsAtOnce : std::false_type {};
template <class Kernel>
struct TellsPixelsAtOnce<Kernel, std::void_t<decltype(std::declval<const Kernel&>().storage_bits(1))>>
    : std::true_type {};

}  // namespace detail

/// What a kernel stores in a circuit that works on `at_once` pixels of a row at once; a kernel whose
/// storage_bits() takes no such number stores the same for any.
template <class Kernel>
Bits storage_of(const Kernel& kernel, int at_once) {
  if constexpr (detail::TellsPixelsAtOnce<Kernel>::value) {
    return Bits(kernel.storage_bits(at_once));
  } else {
    return Bits(kernel.storage_bits());
  }
}

/// A filter by its kernel: each disparity comes out as much later as the kernel looks ahead. Interval and
/// latency are configured; storage is the kernel's.
template <class Kernel, class Config>
class DisparityFilterStage final : public FilterStage {
 public:
  DisparityFilterStage(const sc_core::sc_module_name& name, const Config& config, const StageTiming& timing,
                       const StageContext& context)
      : FilterStage(name, context.clock, context.dataflow, timing.latency),
        kernel_(std::in_place, config, context.width, context.height),
        changes_(context.height),
        look_ahead_(look_ahead_tokens(context, kernel_->look_ahead_rows(), kernel_->look_ahead_pixels())),
        storage_(storage_of(*kernel_, context.pixels_per_token)) {
    const std::size_t width = context.width;
    RasterSchedule raster;
    raster.reads.every = 0b1;
    raster.writes.every = 0b1;
    raster.look_ahead = look_ahead_;
    raster.timing = timing;
    set_schedule(make_schedule(context, raster));
    in_disparity.on_row(width, [this, width, context](const Disparity* row, std::size_t) {
      if (const auto change = changes_.at_row()) kernel_.emplace(*change, context.width, context.height);
      kernel_->push(row, [this, width](const Disparity* out) { out_disparity.send_row(out, width); });
    });
  }

  /// The configuration for the next frame that has none yet, or none: as before. What fixes the schedule
  /// must not change.
  void configure(const std::optional<Config>& config) { changes_.push(config); }
  std::uint64_t look_ahead() const override { return look_ahead_; }
  Bits storage() const override { return storage_; }

 private:
  std::optional<Kernel> kernel_;
  FrameChanges<Config> changes_;
  std::uint64_t look_ahead_;
  Bits storage_;
};

}  // namespace parallax
