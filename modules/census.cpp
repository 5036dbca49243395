// SPDX-License-Identifier: Apache-2.0
#include "modules/census.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "modules/area.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr int kMaxCodeBits = 63;

void check_side(const char* key, int value) {
  if (value < 1 || value > kMaxCodeBits || value % 2 == 0) {
    throw UserError(fmt::format("census.{} = {}: must be odd and within 1..{}", key, value, kMaxCodeBits));
  }
}

/// One neighbour of a whole row: sets `bit` where the comparison holds. A byte a pixel, so that it
/// vectorises.
template <class Compare>
void set_bits(const Gray* neighbour, const Gray* centre, int width, std::uint8_t bit, std::uint8_t* out,
              Compare compare) {
  for (int x = 0; x < width; ++x) {
    out[x] = out[x] | (compare(neighbour[x], centre[x]) ? bit : 0);
  }
}

void set_bits(CensusComparison comparison, const Gray* neighbour, const Gray* centre, int width,
              std::uint8_t bit, std::uint8_t* out) {
  switch (comparison) {
    case CensusComparison::kLess:
      return set_bits(neighbour, centre, width, bit, out, [](Gray n, Gray c) { return n < c; });
    case CensusComparison::kLessEqual:
      return set_bits(neighbour, centre, width, bit, out, [](Gray n, Gray c) { return n <= c; });
    case CensusComparison::kGreater:
      return set_bits(neighbour, centre, width, bit, out, [](Gray n, Gray c) { return n > c; });
    case CensusComparison::kGreaterEqual:
      return set_bits(neighbour, centre, width, bit, out, [](Gray n, Gray c) { return n >= c; });
  }
}

}  // namespace

void CensusConfig::validate() const {
  check_side("window_width", window_width);
  check_side("window_height", window_height);
  if (neighbours() < 1 || neighbours() > kMaxCodeBits) {
    throw UserError(
        fmt::format("census.window_width x census.window_height = {} x {}: {} neighbours, must be 1..{}",
                    window_width, window_height, neighbours(), kMaxCodeBits));
  }
}

Census::Census(const CensusConfig& config, int width, int height)
    : config_(config),
      width_(width),
      height_(height),
      raster_(width, look_ahead_rows() * width + look_ahead_pixels()),
      pad_(config.window_width / 2) {
  config_.validate();
  const int line = width_ + 2 * pad_;
  lines_.resize(area(config_.window_height, line));
  zero_line_.assign(line, 0);
  byte_.resize(width_);
  codes_.resize(width_);
}

std::int64_t Census::storage_bits(int at_once) const {
  if (!config_.enabled) return 0;
  const std::int64_t columns = config_.window_width + at_once - 1;
  return kGrayBits * ((config_.window_height - 1) * std::int64_t{width_} + config_.window_height * columns);
}

Gray* Census::padded(int y) {
  return lines_.data() + (y % config_.window_height) * (width_ + 2 * pad_) + pad_;
}

const Gray* Census::line_for(int y) {
  if (config_.border == CensusBorder::kZero && (y < 0 || y >= height_)) return zero_line_.data() + pad_;
  return padded(std::clamp(y, 0, height_ - 1));
}

void Census::push(const Gray* row, const RowSink<CensusCode>& emit) {
  if (!config_.enabled) {
    std::copy_n(row, width_, codes_.data());
    emit(codes_.data());
  } else if (config_.border == CensusBorder::kDelayLine) {
    push_raster(row, emit);
  } else {
    push_padded(row, emit);
  }
}

void Census::push_raster(const Gray* row, const RowSink<CensusCode>& emit) {
  if (next_row_ == 0) raster_.clear();
  raster_.push(row);
  if (++next_row_ == height_) {
    raster_.end();
    next_row_ = 0;
  }
  for (; raster_.complete(); raster_.pop()) transform(0, emit);
}

void Census::push_padded(const Gray* row, const RowSink<CensusCode>& emit) {
  Gray* line = padded(next_row_);
  const bool replicate = config_.border != CensusBorder::kZero;
  std::copy_n(row, width_, line);
  std::fill_n(line - pad_, pad_, replicate ? row[0] : Gray{0});
  std::fill_n(line + width_, pad_, replicate ? row[width_ - 1] : Gray{0});

  const int complete = next_row_ - look_ahead_rows();
  if (complete >= 0) transform(complete, emit);
  if (++next_row_ < height_) return;
  for (int y = std::max(complete + 1, 0); y < height_; ++y) transform(y, emit);
  next_row_ = 0;
}

void Census::transform(int y, const RowSink<CensusCode>& emit) {
  const int half_width = config_.window_width / 2;
  const int half_height = config_.window_height / 2;
  const int bits = config_.code_bits();
  const bool raster = config_.border == CensusBorder::kDelayLine;
  const Gray* centre = raster ? raster_.row() : padded(y);

  std::fill(codes_.begin(), codes_.end(), CensusCode{0});
  const auto flush = [this](int byte_index) {
    for (std::size_t x = 0; x < codes_.size(); ++x) codes_[x] |= CensusCode{byte_[x]} << (8 * byte_index);
    std::fill(byte_.begin(), byte_.end(), std::uint8_t{0});
  };
  std::fill(byte_.begin(), byte_.end(), std::uint8_t{0});
  // Bits are visited upwards from bit 0, that is backwards through the window for kMsbFirst.
  for (int bit = 0; bit < bits; ++bit) {
    const int i = config_.bit_order == CensusBitOrder::kLsbFirst ? bit : bits - 1 - bit;
    const int place = i < bits / 2 ? i : i + 1;  // the centre is no neighbour
    const int dx = place % config_.window_width - half_width;
    const int dy = place / config_.window_width - half_height;
    const Gray* neighbour = raster ? centre + dy * width_ : line_for(y + dy);
    set_bits(config_.comparison, neighbour + dx, centre, width_, static_cast<std::uint8_t>(1U << (bit % 8)),
             byte_.data());
    if (bit % 8 == 7 || bit == bits - 1) flush(bit / 8);
  }

  if (config_.border == CensusBorder::kMask) {
    const bool outside = y < half_height || y >= height_ - half_height;
    const int margin = outside ? width_ : std::min(half_width, width_);
    std::fill_n(codes_.begin(), margin, CensusCode{0});
    std::fill_n(codes_.rbegin(), margin, CensusCode{0});
  }
  emit(codes_.data());
}

}  // namespace parallax
