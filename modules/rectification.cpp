// SPDX-License-Identifier: Apache-2.0
#include "modules/rectification.hpp"
#include "modules/area.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace parallax {

namespace {

const RectificationConfig& validated(const RectificationConfig& config) {
  config.validate();
  return config;
}

}  // namespace

Rectification::Ring::Ring(int rows, int width, int margin)
    : rows_(rows), width_(width), margin_(margin), pixels_(area(rows, width + 2 * margin)) {}

std::size_t Rectification::Ring::begin(int y) const { return area(y % rows_, width_ + 2 * margin_); }

const Gray* Rectification::Ring::row(int y) const { return pixels_.data() + begin(y) + margin_; }

void Rectification::Ring::store(int y, const Gray* row) {
  Gray* line = pixels_.data() + begin(y);
  line = std::fill_n(line, margin_, row[0]);
  line = std::copy_n(row, width_, line);
  std::fill_n(line, margin_, row[width_ - 1]);
}

Rectification::Rectification(const RectificationConfig& config, int width, int height)
    : config_(validated(config)),
      width_(width),
      height_(height),
      left_(config.range.window, width, config.range.reach() + 1),
      right_(config.range.window, width, config.range.reach() + 1),
      lines_(config.range.window + 1),
      out_{std::vector<Gray>(width), std::vector<Gray>(width)} {}

std::int64_t Rectification::storage_bits() const {
  constexpr std::int64_t kImages = 2;
  constexpr std::int64_t kBitsPerPixel = 8;
  return kImages * kBitsPerPixel * config_.range.window * width_;
}

bool Rectification::can_push_images() const {
  return rows_in_ < height_ && rows_in_ <= rows_out_ + config_.range.reach();
}

void Rectification::push_images(const Gray* left, const Gray* right, const Emit& emit) {
  if (!can_push_images()) {
    throw std::logic_error(
        fmt::format("rectification: image row {} before output row {} is done", rows_in_, rows_out_));
  }
  left_.store(rows_in_, left);
  right_.store(rows_in_, right);
  ++rows_in_;
  emit_ready(emit);
}

void Rectification::push_map(const OffsetPair* row, const Emit& emit) {
  check(row);
  maps_.emplace_back(row, row + width_);
  emit_ready(emit);
}

void Rectification::emit_ready(const Emit& emit) {
  while (!maps_.empty() && rows_in_ > std::min(rows_out_ + config_.range.reach(), height_ - 1)) {
    rectify(left_, maps_.front().data(), &OffsetPair::left, out_[0].data());
    rectify(right_, maps_.front().data(), &OffsetPair::right, out_[1].data());
    maps_.pop_front();
    if (++rows_out_ == height_) {
      rows_in_ = 0;
      rows_out_ = 0;
    }
    emit(out_[0].data(), out_[1].data());
  }
}

void Rectification::rectify(const Ring& image, const OffsetPair* map, Offset OffsetPair::*side, Gray* out) {
  const int reach = config_.range.reach();
  for (int i = 0; i <= config_.range.window; ++i) {
    lines_[i] = image.row(std::clamp(rows_out_ - reach + i, 0, rows_in_ - 1));
  }
  const int shift = config_.range.fraction_bits;
  const int scale = 1 << shift;
  const int half = config_.rounding == RectificationConfig::Rounding::kNearest ? scale * scale / 2 : 0;
  const Gray* const* lines = lines_.data() + reach;
  for (int x = 0; x < width_; ++x) {
    const Offset offset = map[x].*side;
    const int ix = x + (offset.dx >> shift);
    const int iy = offset.dy >> shift;
    const int fx = offset.dx & (scale - 1);
    const int fy = offset.dy & (scale - 1);
    const Gray* upper = lines[iy] + ix;
    const Gray* lower = lines[iy + 1] + ix;
    const int above = upper[0] * (scale - fx) + upper[1] * fx;
    const int below = lower[0] * (scale - fx) + lower[1] * fx;
    out[x] = static_cast<Gray>((above * (scale - fy) + below * fy + half) >> (2 * shift));
  }
}

// The kernel's reads are not clamped, so an offset beyond the window must not get in.
void Rectification::check(const OffsetPair* row) const {
  const int limit = config_.range.limit();
  const auto beyond = [limit](const Offset& o) { return std::abs(o.dx) > limit || std::abs(o.dy) > limit; };
  bool any = false;
  for (int x = 0; x < width_; ++x) {
    any |= beyond(row[x].left);
    any |= beyond(row[x].right);
  }
  if (any) {
    throw std::invalid_argument(fmt::format(
        "rectification: a map row holds an offset beyond the window of {} px", config_.range.window));
  }
}

}  // namespace parallax
