// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include "modules/pixel.hpp"
#include "modules/rectification_map.hpp"

namespace parallax {

struct RectificationConfig {
  enum class Rounding {
    kNearest,   ///< to the nearest grey level, half up (as OpenCV's remap)
    kTruncate,  ///< toward zero
  };

  /// Window and fraction bits; must equal the map's. Source: window S, fraction bits own choice.
  OffsetRange range;
  /// Of the interpolated intensity. Source: own choice, so that the images equal OpenCV's.
  Rounding rounding = Rounding::kNearest;

  void validate() const { range.validate(); }
};

/// Rectification of both images. Definition, with F = range.fraction_bits, S = 2^F, for output pixel (x, y)
/// and offset (dx, dy) in 1/S px:
///   ix = x + floor(dx / S), fx = dx mod S (0..S-1); iy and fy likewise
///   p(i, j) = input at (clamp(i, 0, W-1), clamp(j, 0, H-1))
///   upper = (S-fx) * p(ix, iy) + fx * p(ix+1, iy)
///   lower = (S-fx) * p(ix, iy+1) + fx * p(ix+1, iy+1)
///   out = ((S-fy) * upper + fy * lower + half) >> 2F
///   half = S*S/2 (rounded down) for kNearest, 0 for kTruncate
/// An offset of exactly +limit has fraction 0, so the neighbour beyond the window has weight 0 and the ring
/// of `window` rows is all that is needed.
///
/// Images and map arrive independently: an output row appears as soon as its map row and the image row
/// look_ahead_rows() below (or the last one) are there. The caller bounds how many map rows wait.
class Rectification {
 public:
  using Emit = std::function<void(const Gray* left, const Gray* right)>;

  Rectification(const RectificationConfig& config, int width, int height);

  /// The next row of both images. Only when can_push_images(): a row may not overwrite one that is still
  /// needed.
  void push_images(const Gray* left, const Gray* right, const Emit& emit);
  /// The map's next row; after the last one, the next frame's first.
  void push_map(const OffsetPair* row, const Emit& emit);

  /// False while the rows held are all needed for the next output row, or the frame's rows are all in.
  bool can_push_images() const;
  int map_rows_waiting() const { return static_cast<int>(maps_.size()); }

  int look_ahead_rows() const { return config_.range.reach(); }
  int look_ahead_pixels() const { return config_.range.reach(); }
  /// `window` rows of both images, 8 bit a pixel.
  std::int64_t storage_bits() const;

 private:
  // A ring of rows; each is extended on both sides by its first and last pixel, so that no read has to clamp.
  class Ring {
   public:
    Ring(int rows, int width, int margin);
    void store(int y, const Gray* row);
    const Gray* row(int y) const;

   private:
    std::size_t begin(int y) const;

    int rows_;
    int width_;
    int margin_;
    std::vector<Gray> pixels_;
  };

  void emit_ready(const Emit& emit);
  void rectify(const Ring& image, const OffsetPair* map, Offset OffsetPair::*side, Gray* out);
  void check(const OffsetPair* row) const;

  RectificationConfig config_;
  int width_;
  int height_;
  Ring left_;
  Ring right_;
  int rows_in_ = 0;   // image rows of this frame received
  int rows_out_ = 0;  // rows of this frame emitted
  std::deque<std::vector<OffsetPair>> maps_;
  std::vector<const Gray*> lines_;  // input row y - reach + i at index i, clamped at the image's edge
  std::array<std::vector<Gray>, 2> out_;
};

}  // namespace parallax
