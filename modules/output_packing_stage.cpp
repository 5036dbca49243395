// SPDX-License-Identifier: Apache-2.0
#include "modules/output_packing_stage.hpp"

#include <algorithm>

namespace parallax {
namespace {

// The firings of tokens, one after the other.
class TokenFirings {
 public:
  explicit TokenFirings(Bytes burst) : burst_(burst.count()) {}

  void drop() { ++quiet_; }
  // A token after which the piece has `bytes` bytes; `last`: it ends there.
  void pack(std::uint64_t bytes, bool last) {
    const std::uint64_t complete = last ? (bytes + burst_ - 1) / burst_ : bytes / burst_;
    if (complete == bursts_) {
      ++quiet_;
    } else {
      add_quiet();
      firings_.add(fires().reads(0b11).writes(0b1));
      // A token that completes several bursts takes a cycle more for each further one.
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
  std::uint64_t quiet_ = 0;   // tokens since the last one that completed a burst
  Firings firings_;
};

bool whole(const OutputPackingConfig& config, const StageContext& context) {
  return config.passes.size() == 1 && config.passes[0].begin == 0 && config.passes[0].end == context.width;
}

Schedule packing_schedule(const OutputPackingConfig& config, const StageContext& context) {
  const bool one_piece = whole(config, context);
  TokenFirings firings(config.burst);
  for (const PackedColumns& columns : config.passes) {
    const int width = columns.end - columns.begin;
    const std::uint64_t row_bytes = OutputPacking::row_bytes(width, config.left);
    for (int y = 0; y < context.height; ++y) {
      const std::uint64_t before = one_piece ? y * row_bytes : 0;
      for (int end = context.pixels_per_token; end <= context.width; end += context.pixels_per_token) {
        // Columns that go out, up to the end of this token.
        const int packed = std::clamp(end - columns.begin, 0, width);
        if (packed == 0 || end - columns.end >= context.pixels_per_token) {
          firings.drop();
          continue;
        }
        const bool last = packed == width && (!one_piece || y + 1 == context.height);
        const std::uint64_t bytes =
            packed == width ? row_bytes : packed / 2 * OutputPacking::pair_bytes(config.left);
        firings.pack(before + bytes, last);
      }
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
