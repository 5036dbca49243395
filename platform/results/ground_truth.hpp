// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "modules/pixel.hpp"

namespace parallax {

/// True disparities of the left image, for comparison.
struct GroundTruth {
  int width = 0;
  int height = 0;
  std::vector<float> disparity;    ///< px, 0 = unknown
  std::vector<std::uint8_t> mask;  ///< 255 = score this pixel; empty: score all known ones
  double scale = 1;                ///< by which the values of the file were divided

  /// Whether the pixel (of width * height) counts: its disparity is known and the mask, if any, says 255.
  bool scored(std::size_t pixel) const;

  /// How far a valid disparity of a scored pixel is off, px.
  double error(std::size_t pixel, const Disparity& found) const;
};

/// A number of the score, by its name in timing.json ("quality/bad_1").
struct Quality {
  std::string name;
  double value = 0;
};

/// How a disparity image compares with the ground truth.
struct GroundTruthScore {
  static constexpr int kLimits = 3;  ///< bad-1, bad-2, bad-3

  std::int64_t pixels = 0;                     ///< of the image
  std::int64_t scored = 0;                     ///< pixels
  std::int64_t valid = 0;                      ///< scored pixels that have a disparity
  std::array<std::int64_t, kLimits> bad = {};  ///< valid ones that are off by more than 1, 2, 3 px
  double absolute_error = 0;                   ///< sum over valid ones, px

  /// Adds another image's counts.
  GroundTruthScore& operator+=(const GroundTruthScore& other);

  /// Shares in 0..1; 0 if there is nothing to share.
  double coverage() const;
  double bad_share(int limit) const;      ///< of the valid pixels
  double bad_share_all(int limit) const;  ///< of the scored pixels, one without a disparity being bad
  double mean_error() const;              ///< px, over the valid pixels

  std::vector<Quality> qualities() const;
};

/// Throws UserError if the sizes differ.
GroundTruthScore score(const std::vector<Disparity>& disparity, int width, const GroundTruth& truth);

}  // namespace parallax
