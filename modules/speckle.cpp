// SPDX-License-Identifier: Apache-2.0
#include "modules/speckle.hpp"

#include <algorithm>

#include "modules/require_range.hpp"
#include "modules/similar.hpp"

namespace parallax {

void SpeckleConfig::validate() const {
  require_range("speckle.iterations", iterations, 0, 4);
  require_odd_range("speckle.window", window, 3, 31);
  require_range("speckle.min_similar_percent", min_similar_percent, 0, 100);
  require_range("speckle.max_difference", max_difference, 0, kMaxDisparityDifference);
}

Speckle::Pass::Pass(const SpeckleConfig& config, int width, int height)
    : width_(width),
      height_(height),
      half_(config.window / 2),
      max_difference_(static_cast<std::uint16_t>(config.max_difference)),
      min_count_((config.min_similar_percent * config.window * config.window + 99) / 100),
      rows_(half_ + 1, width, 0, {}),
      values_(config.window, width, half_, kSimilarToNone),
      counts_(width) {}

void Speckle::Pass::push(const Disparity* row, const RowSink<Disparity>& emit) {
  std::copy(row, row + width_, rows_.row(in_row_));
  comparable_values(row, width_, values_.row(in_row_));
  ++in_row_;
  while (out_row_ < height_ && (in_row_ > out_row_ + half_ || in_row_ == height_)) {
    filter_row(out_row_);
    emit(rows_.row(out_row_));
    ++out_row_;
  }
  if (in_row_ == height_) in_row_ = out_row_ = 0;
}

/// Decides on row y, in place: the decisions of the rows below read values_, which keeps the input.
void Speckle::Pass::filter_row(int y) {
  std::fill(counts_.begin(), counts_.end(), 0);
  const std::uint16_t* centre = values_.row(y);
  std::uint16_t* counts = counts_.data();
  for (int v = std::max(y - half_, 0); v <= std::min(y + half_, height_ - 1); ++v) {
    for (int dx = -half_; dx <= half_; ++dx) {
      const std::uint16_t* other = values_.row(v) + dx;
      for (int x = 0; x < width_; ++x) {
        counts[x] += similar(centre[x], other[x], max_difference_);
      }
    }
  }
  Disparity* row = rows_.row(y);
  for (int x = 0; x < width_; ++x) {
    if (row[x].valid() && counts[x] < min_count_) row[x] = {kInvalidDisparity, Cause::kSpeckle};
  }
}

Speckle::Speckle(const SpeckleConfig& config, int width, int height)
    : config_((config.validate(), config)), width_(width) {
  passes_.assign(config.iterations, Pass(config, width, height));
}

void Speckle::push(const Disparity* row, const RowSink<Disparity>& emit) { push_pass(0, row, emit); }

void Speckle::push_pass(std::size_t index, const Disparity* row, const RowSink<Disparity>& emit) {
  if (index == passes_.size()) return emit(row);
  passes_[index].push(row, [&](const Disparity* filtered) { push_pass(index + 1, filtered, emit); });
}

int Speckle::look_ahead_rows() const { return config_.iterations * (config_.window / 2); }

int Speckle::look_ahead_pixels() const { return config_.iterations * (config_.window / 2); }

std::int64_t Speckle::storage_bits(int at_once) const {
  const std::int64_t line_buffers = std::int64_t{config_.window - 1} * width_ * kDisparityBits;
  const std::int64_t window = std::int64_t{config_.window} * (config_.window + at_once - 1) * kDisparityBits;
  return config_.iterations * (line_buffers + window);
}

}  // namespace parallax
