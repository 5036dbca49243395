// SPDX-License-Identifier: Apache-2.0
#include "modules/output_packing_stage.hpp"

namespace parallax {
namespace {

// The firings of pixels, one after the other.
class PixelFirings {
 public:
  explicit PixelFirings(Bytes burst) : burst_(burst.count()) {}

  void drop(int pixels) { quiet_ += pixels; }
  // A pixel after which the piece has `bytes` bytes; `last`: it ends there.
  void pack(std::uint64_t bytes, bool last) {
    const std::uint64_t complete = last ? (bytes + burst_ - 1) / burst_ : bytes / burst_;
    if (complete == bursts_) {
      ++quiet_;
    } else {
      add_quiet();
      firings_.add(fires().reads(0b11).writes(0b1));
      // A burst smaller than a pixel pair leaves in a cycle of its own.
      if (complete > bursts_ + 1) firings_.add(fires(complete - bursts_ - 1).writes(0b1));
    }
    bursts_ = last ? 0 : complete;
  }
  Schedule schedule() {
    add_quiet();
    return Schedule().run(firings_);
  }

 private:
  void add_quiet() {
    firings_.add(fires(quiet_).reads(0b11));
    quiet_ = 0;
  }

  const std::uint64_t burst_;
  std::uint64_t bursts_ = 0;  // complete, of the piece
  std::uint64_t quiet_ = 0;   // pixels since the last one that completed a burst
  Firings firings_;
};

bool whole(const OutputPackingConfig& config, const StageContext& context) {
  return config.passes.size() == 1 && config.passes[0].begin == 0 && config.passes[0].end == context.width;
}

Schedule packing_schedule(const OutputPackingConfig& config, const StageContext& context) {
  const bool one_piece = whole(config, context);
  PixelFirings firings(config.burst);
  for (const PackedColumns& columns : config.passes) {
    const int width = columns.end - columns.begin;
    for (int y = 0; y < context.height; ++y) {
      firings.drop(columns.begin);
      const std::uint64_t before = one_piece ? y * OutputPacking::row_bytes(width, config.left) : 0;
      for (int x = 1; x <= width; ++x) {
        const bool last = x == width && (!one_piece || y + 1 == context.height);
        const std::uint64_t bytes = x == width ? OutputPacking::row_bytes(width, config.left)
                                               : x / 2 * OutputPacking::pair_bytes(config.left);
        firings.pack(before + bytes, last);
      }
      firings.drop(context.width - columns.end);
    }
  }
  return firings.schedule();
}

std::vector<OutputPacking> kernels(const OutputPackingConfig& config) {
  std::vector<OutputPacking> kernels;
  for (const PackedColumns& columns : config.passes) {
    kernels.emplace_back(columns.end - columns.begin, config.left);
  }
  return kernels;
}

}  // namespace

OutputPackingStage::OutputPackingStage(const sc_core::sc_module_name& name, const OutputPackingConfig& config,
                                       const StageContext& context)
    : Stage(name, context.clock, context.dataflow, 1),
      left_(config.left),
      passes_(config.passes),
      height_(context.height),
      kernels_(kernels(config)),
      burst_(config.burst.count() * 8),
      rows_(context.width, context.width,
            [this](const Gray* left, const Disparity* disparities) { pack(left, disparities); }) {
  const std::size_t width = context.width;
  set_schedule(packing_schedule(config, context));
  in_left.on_row(width, [this](const Gray* row, std::size_t) { rows_.push_a(row); });
  in_disparity.on_row(width, [this](const Disparity* row, std::size_t) { rows_.push_b(row); });
}

void OutputPackingStage::pack(const Gray* left, const Disparity* disparities) {
  const PackedColumns& columns = passes_[pass_];
  kernels_[pass_].push(left + columns.begin, disparities + columns.begin, [&](const std::uint8_t* row) {
    out_bursts.send_row(row, OutputPacking::row_bytes(columns.end - columns.begin, left_));
  });
  if (++y_ == height_) {
    y_ = 0;
    pass_ = (pass_ + 1) % passes_.size();
  }
}

}  // namespace parallax
