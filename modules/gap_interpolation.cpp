// SPDX-License-Identifier: Apache-2.0
#include "modules/gap_interpolation.hpp"

#include <algorithm>
#include <cstdlib>

#include "modules/require_range.hpp"
#include "modules/similar.hpp"

namespace parallax {

namespace {

bool is_gap(const Disparity& pixel) { return !pixel.valid() && pixel.cause != Cause::kBorder; }

}  // namespace

void GapInterpolationConfig::validate() const {
  require_range("gap_interpolation.l_max", l_max, 0, 64);
  require_range("gap_interpolation.max_difference", max_difference, 0, kMaxDisparityDifference);
}

GapInterpolation::GapInterpolation(const GapInterpolationConfig& config, int width, int height)
    : config_((config.validate(), config)),
      width_(width),
      height_(height),
      rows_(config.l_max + 2, width, 0, {}),
      vertical_runs_(width),
      output_(width) {}

void GapInterpolation::push(const Disparity* row, const RowSink<Disparity>& emit) {
  if (!config_.enabled) return emit(row);
  std::copy(row, row + width_, rows_.row(in_row_));
  ++in_row_;
  while (out_row_ < height_ && (in_row_ > out_row_ + config_.l_max || in_row_ == height_)) {
    update_vertical_runs(out_row_);
    fill_row(out_row_);
    emit(output_.data());
    ++out_row_;
  }
  if (in_row_ == height_) in_row_ = out_row_ = 0;
}

GapInterpolation::Run GapInterpolation::bridge(const Disparity& first, const Disparity& last,
                                               int length) const {
  const bool bridged = first.valid() && last.valid() && length <= config_.l_max &&
                       std::abs(first.value - last.value) <= config_.max_difference;
  return bridged ? Run{first.value, last.value, length} : Run{};
}

/// The run that begins at (x, y), if its end is near enough.
GapInterpolation::Run GapInterpolation::vertical_run(int x, int y) const {
  if (y == 0) return {};
  for (int end = y + 1; end < height_ && end <= y + config_.l_max; ++end) {
    const Disparity& last = rows_.row(end)[x];
    if (!is_gap(last)) return bridge(rows_.row(y - 1)[x], last, end - y);
  }
  return {};
}

void GapInterpolation::update_vertical_runs(int y) {
  const Disparity* row = rows_.row(y);
  const Disparity* above = y > 0 ? rows_.row(y - 1) : nullptr;
  for (int x = 0; x < width_; ++x) {
    if (!is_gap(row[x])) continue;
    VerticalRun& vertical = vertical_runs_[x];
    if (above == nullptr || !is_gap(above[x])) vertical = {vertical_run(x, y), y};
  }
}

void GapInterpolation::fill_row(int y) {
  const Disparity* row = rows_.row(y);
  std::copy(row, row + width_, output_.data());
  for (int x = 0; x < width_;) {
    if (!is_gap(row[x])) {
      ++x;
      continue;
    }
    const int begin = x;
    while (x < width_ && is_gap(row[x])) ++x;
    const Run horizontal = begin > 0 && x < width_ ? bridge(row[begin - 1], row[x], x - begin) : Run{};
    for (int u = begin; u < x; ++u) {
      const auto& [vertical, top] = vertical_runs_[u];
      const bool across =
          horizontal.length > 0 && (vertical.length == 0 || horizontal.length <= vertical.length);
      if (across) {
        output_[u] = fill(horizontal, u - begin + 1);
      } else if (vertical.length > 0) {
        output_[u] = fill(vertical, y - top + 1);
      }
    }
  }
}

Disparity GapInterpolation::fill(const Run& run, int position) const {
  const int steps = run.length + 1;
  const int weighted = run.first * (steps - position) + run.last * position;
  const int value = config_.rounding == InterpolationRounding::kNearest ? (2 * weighted + steps) / (2 * steps)
                                                                        : weighted / steps;
  return {static_cast<std::uint16_t>(value), Cause::kInterpolated};
}

int GapInterpolation::look_ahead_rows() const { return config_.enabled ? config_.l_max : 0; }

int GapInterpolation::look_ahead_pixels() const { return 0; }

std::int64_t GapInterpolation::storage_bits(int at_once) const {
  if (!config_.enabled) return 0;
  // A row is held until l_max more have come, with a bit per pixel for a masked border; each column also
  // keeps the edge above its run and its place in the run.
  std::int64_t position_bits = 1;
  while ((1 << position_bits) <= config_.l_max + 1) ++position_bits;
  const std::int64_t line_buffers = std::int64_t{config_.l_max} * width_ * (kDisparityBits + 1);
  const std::int64_t columns = std::int64_t{width_} * (kDisparityBits + position_bits);
  const std::int64_t window = std::int64_t{config_.l_max + at_once} * (kDisparityBits + 1);
  return line_buffers + columns + window;
}

}  // namespace parallax
