// SPDX-License-Identifier: Apache-2.0
#include "modules/noise_reduction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "modules/require_range.hpp"
#include "modules/similar.hpp"
#include "tlm/error.hpp"

namespace parallax {

namespace {

constexpr int kLargestWindow = 7;

}  // namespace

int NoiseReductionConfig::side() const {
  if (of_similar()) return window;
  return kind == NoiseReductionKind::kMedian3x3 ? 3 : 5;
}

void NoiseReductionConfig::validate() const {
  require_odd_range("noise_reduction.window", window, 3, kLargestWindow);
  require_range("noise_reduction.max_difference", max_difference, 0, kMaxDisparityDifference);
  const auto refuse = [this](const char* key, int value, int unchanged) {
    if (of_similar() || value == unchanged) return;
    throw UserError(
        fmt::format("noise_reduction.{} = {}: has no effect with noise_reduction.kind = \"median_{}x{}\"",
                    key, value, side(), side()));
  };
  const NoiseReductionConfig defaults;
  refuse("window", window, defaults.window);
  refuse("max_difference", max_difference, defaults.max_difference);
}

NoiseReduction::NoiseReduction(const NoiseReductionConfig& config, int width, int height)
    : config_((config.validate(), config)),
      width_(width),
      height_(height),
      half_(config.side() / 2),
      rows_(half_ + 1, width, 0, {}),
      values_(2 * half_ + 1, width, half_, kSimilarToNone),
      sums_(width),
      counts_(width) {
  reciprocals_.push_back(0);
  for (int n = 1; n <= config.window * config.window; ++n) {
    reciprocals_.push_back((std::uint64_t{1} << 32) / (2 * n) + 1);
  }
}

void NoiseReduction::push(const Disparity* row, const RowSink<Disparity>& emit) {
  if (!config_.enabled) return emit(row);
  std::copy(row, row + width_, rows_.row(in_row_));
  comparable_values(row, width_, values_.row(in_row_));
  ++in_row_;
  while (out_row_ < height_ && (in_row_ > out_row_ + half_ || in_row_ == height_)) {
    // In place: the rows below read values_, which keeps the input.
    Disparity* out = rows_.row(out_row_);
    if (!config_.of_similar()) {
      plain_median_row(out_row_, out);
    } else if (config_.kind == NoiseReductionKind::kMean) {
      mean_row(out_row_, out);
    } else {
      median_row(out_row_, out);
    }
    emit(out);
    ++out_row_;
  }
  if (in_row_ == height_) in_row_ = out_row_ = 0;
}

void NoiseReduction::mean_row(int y, Disparity* out) {
  std::fill(sums_.begin(), sums_.end(), 0);
  std::fill(counts_.begin(), counts_.end(), 0);
  const int width = width_;  // a copy that the stores below cannot change: without it, no vector code
  const std::uint16_t* centre = values_.row(y);
  const auto max_difference = static_cast<std::uint16_t>(config_.max_difference);
  std::uint32_t* sums = sums_.data();
  std::uint16_t* counts = counts_.data();
  for (int v = std::max(y - half_, 0); v <= std::min(y + half_, height_ - 1); ++v) {
    for (int dx = -half_; dx <= half_; ++dx) {
      const std::uint16_t* other = values_.row(v) + dx;
      for (int x = 0; x < width; ++x) {
        const bool counted = similar(centre[x], other[x], max_difference);
        sums[x] += counted ? other[x] : 0U;
        counts[x] += counted;
      }
    }
  }
  for (int x = 0; x < width; ++x) {
    if (!out[x].valid()) continue;
    const std::uint64_t dividend = std::uint64_t{2} * sums[x] + counts[x];
    out[x].value = static_cast<std::uint16_t>((dividend * reciprocals_[counts[x]]) >> 32);
  }
}

void NoiseReduction::median_row(int y, Disparity* out) {
  std::array<std::uint16_t, kLargestWindow * kLargestWindow> members;
  const std::uint16_t* centre = values_.row(y);
  const auto max_difference = static_cast<std::uint16_t>(config_.max_difference);
  for (int x = 0; x < width_; ++x) {
    if (!out[x].valid()) continue;
    auto end = members.begin();
    for (int v = std::max(y - half_, 0); v <= std::min(y + half_, height_ - 1); ++v) {
      const std::uint16_t* row = values_.row(v);
      for (int u = x - half_; u <= x + half_; ++u) {
        if (similar(centre[x], row[u], max_difference)) *end++ = row[u];
      }
    }
    const auto middle = members.begin() + (end - members.begin() - 1) / 2;
    std::nth_element(members.begin(), middle, end);
    out[x].value = *middle;
  }
}

void NoiseReduction::plain_median_row(int y, Disparity* out) {
  if (y < half_ || y + half_ >= height_) return;
  const int side = config_.side();
  std::array<std::uint16_t, kLargestWindow * kLargestWindow> members;
  const auto middle = members.begin() + (side * side - 1) / 2;
  for (int x = half_; x + half_ < width_; ++x) {
    auto end = members.begin();
    for (int v = y - half_; v <= y + half_; ++v) end = std::copy_n(values_.row(v) + x - half_, side, end);
    std::nth_element(members.begin(), middle, end);
    const bool was_valid = out[x].valid();
    out[x].value = *middle == kSimilarToNone ? kInvalidDisparity : *middle;
    if (out[x].valid() != was_valid) out[x].cause = was_valid ? Cause::kNoise : Cause::kMatched;
  }
}

int NoiseReduction::look_ahead_rows() const { return config_.enabled ? half_ : 0; }

int NoiseReduction::look_ahead_pixels() const { return config_.enabled ? half_ : 0; }

std::int64_t NoiseReduction::storage_bits(int at_once) const {
  if (!config_.enabled) return 0;
  const std::int64_t line_buffers = std::int64_t{2} * half_ * width_ * kDisparityBits;
  const std::int64_t window = std::int64_t{config_.side()} * (config_.side() + at_once - 1) * kDisparityBits;
  return line_buffers + window;
}

}  // namespace parallax
