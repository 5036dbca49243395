// SPDX-License-Identifier: Apache-2.0
#include "modules/texture.hpp"

#include <algorithm>
#include <cstdlib>

#include "modules/require_range.hpp"

namespace parallax {

namespace {

constexpr std::uint32_t kStepsPerGreyLevel = 32;  ///< unit of the score

}  // namespace

void TextureConfig::validate() const {
  require_range("texture.threshold", threshold, 0, 63);
  require_odd_range("texture.window", window, 3, 15);
}

Texture::Texture(const TextureConfig& config, int width, int height)
    : config_((config.validate(), config)),
      width_(width),
      height_(height),
      half_(config.window / 2),
      contrast_(2 * half_ + 1, width, half_, 0),
      column_sums_(width + 2 * half_, 0) {}

void Texture::push_image(const Gray* row, const RowSink<Disparity>& emit) {
  if (!config_.enabled) return;
  const int width = width_;  // a copy that the stores below cannot change: without it, no vector code
  std::uint8_t* contrast = contrast_.row(image_row_);
  for (int x = 1; x < width; ++x) contrast[x] = static_cast<std::uint8_t>(std::abs(row[x] - row[x - 1]));
  ++image_row_;
  while (score_row_ < height_ && (image_row_ > score_row_ + half_ || image_row_ == height_)) {
    plain_rows_.push_back(score_row(score_row_++));
  }
  if (image_row_ == height_) image_row_ = score_row_ = 0;
  emit_ready(emit);
}

void Texture::push_disparity(const Disparity* row, const RowSink<Disparity>& emit) {
  if (!config_.enabled) return emit(row);
  disparity_rows_.emplace_back(row, row + width_);
  emit_ready(emit);
}

Texture::Plain Texture::score_row(int y) {
  std::fill(column_sums_.begin(), column_sums_.end(), 0);
  const int width = width_;
  std::uint32_t* columns = column_sums_.data() + half_;
  for (int v = y - half_; v <= y + half_; ++v) {
    const std::uint8_t* contrast = contrast_.row(std::clamp(v, 0, height_ - 1));
    for (int x = 0; x < width; ++x) columns[x] += contrast[x];
  }
  const std::uint32_t limit = config_.threshold * config_.window * (config_.window - 1);
  // The replicated columns outside of the image have no contrast: the zeros on both sides of column_sums_.
  std::uint32_t sum = 0;
  for (int x = 1 - half_; x < half_; ++x) sum += columns[x];
  Plain plain(width);
  for (int x = 0; x < width; ++x) {
    sum += columns[x + half_];
    plain[x] = kStepsPerGreyLevel * sum < limit;
    sum -= columns[x - half_ + 1];
  }
  return plain;
}

void Texture::emit_ready(const RowSink<Disparity>& emit) {
  while (!plain_rows_.empty() && !disparity_rows_.empty()) {
    const Plain& plain = plain_rows_.front();
    std::vector<Disparity>& row = disparity_rows_.front();
    for (std::size_t x = 0; x < row.size(); ++x) {
      if (plain[x] && row[x].valid()) row[x] = {kInvalidDisparity, Cause::kTexture};
    }
    emit(row.data());
    plain_rows_.pop_front();
    disparity_rows_.pop_front();
  }
}

int Texture::look_ahead_rows() const { return config_.enabled ? half_ : 0; }

int Texture::look_ahead_pixels() const { return config_.enabled ? half_ : 0; }

std::int64_t Texture::storage_bits(int at_once) const {
  if (!config_.enabled) return 0;
  const std::int64_t line_buffers = std::int64_t{2} * half_ * width_ * 8;
  // The columns of pixels that come in, the previous pixel of each row, and the column sums (15 * 255 < 2^12)
  // of the sliding window.
  const std::int64_t registers =
      std::int64_t{1 + at_once} * config_.window * 8 + std::int64_t{config_.window + at_once - 1} * 12;
  return line_buffers + registers;
}

}  // namespace parallax
