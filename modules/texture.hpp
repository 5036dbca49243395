// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "modules/pixel.hpp"
#include "modules/row_ring.hpp"
#include "modules/row_sink.hpp"

namespace parallax {

struct TextureConfig {
  /// Off: disparities pass unchanged, no look-ahead. Default on (S, device software).
  bool enabled = true;
  /// t_t, a pixel whose score is below is invalidated. Range 0..63, default 10 (S, device's sensitivity). The
  /// unit, 1/32 grey level of mean horizontal contrast, is our own choice: the device's mapping is not
  /// published. With it the default spares surfaces of which the matcher still makes sense.
  int threshold = 10;
  /// Width and height of the neighbourhood in px, odd, 3..15. Own choice: the paper says "local
  /// neighborhood".
  int window = 5;

  void validate() const;
};

/// Texture filter: invalidates disparities in image regions that are too plain to be matched (paper, "Texture
/// Filtering").
///
/// Definition. h = (window - 1) / 2. I is the rectified left image; outside of it, the nearest border pixel
/// counts (replicate). The contrast sum of pixel (x, y) takes all horizontal neighbours that lie in its
/// window:
///   S(x, y) = sum over v = y-h..y+h, u = x-h+1..x+h of |I(u, v) - I(u-1, v)|
/// and the score is the mean contrast in 1/32 grey levels, s_t = 32 * S / (window * (window - 1)).
/// A valid disparity becomes invalid (Cause::kTexture) when s_t < threshold, compared exactly:
///   32 * S < threshold * window * (window - 1).
/// An invalid one keeps its cause. Only horizontal contrast counts because the search runs along rows: a
/// horizontal edge does not tell where on the row a pixel belongs.
///
/// The two inputs arrive independently and the faster one is held back; a frame of one may start while the
/// other is still in the frame before.
class Texture {
 public:
  Texture(const TextureConfig& config, int width, int height);

  /// For rows of the image from the next one on, which must be a frame's first; 0 judges nothing.
  void set_threshold(int threshold) { config_.threshold = threshold; }

  void push_image(const Gray* row, const RowSink<Disparity>& emit);
  void push_disparity(const Disparity* row, const RowSink<Disparity>& emit);

  /// Look-ahead into the image; output (x, y) needs disparities up to (x, y) alone.
  int look_ahead_rows() const;
  int look_ahead_pixels() const;
  /// Line buffers of the image, column sums and window registers; a waiting disparity is in its stream.
  /// `at_once`: pixels of a row that the circuit works on in one firing, in windows side by side.
  std::int64_t storage_bits(int at_once = 1) const;

 private:
  using Plain = std::vector<std::uint8_t>;  ///< one row: 1 where the texture is too weak

  Plain score_row(int y);
  void emit_ready(const RowSink<Disparity>& emit);

  TextureConfig config_;
  int width_;
  int height_;
  int half_;
  RowRing<std::uint8_t> contrast_;          ///< |I(x) - I(x-1)| of the last rows
  std::vector<std::uint32_t> column_sums_;  ///< of contrast_ over the window's rows
  int image_row_ = 0;
  int score_row_ = 0;
  std::deque<Plain> plain_rows_;                       ///< scored, disparities not there yet
  std::deque<std::vector<Disparity>> disparity_rows_;  ///< arrived, score not there yet
};

}  // namespace parallax
