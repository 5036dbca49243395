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
  static constexpr int kStepsPerPixel = 256;

  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> disparity;  ///< 1/256 px, 0 = unknown (the KITTI convention)
  std::vector<std::uint8_t> mask;        ///< 255 = score this pixel; empty: score all known ones

  /// Whether the pixel (of width * height) counts: its disparity is known and the mask, if any, says 255.
  bool scored(std::size_t pixel) const;

  /// How far a valid disparity of a scored pixel is off, 1/256 px.
  int error(std::size_t pixel, const Disparity& found) const;
};

/// Reads a 16-bit PNG (disparity * 256, 0 = unknown) and, if mask_path is not empty, an 8-bit mask (255 =
/// score). Throws UserError, one line, if a file is unreadable, of another pixel format, of another size
/// than the image, or if there is no pixel to score.
GroundTruth read_ground_truth(const std::string& path, const std::string& mask_path, int width, int height);

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
  std::int64_t absolute_error = 0;             ///< sum over valid ones, 1/256 px

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
