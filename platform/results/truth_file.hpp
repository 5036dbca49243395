// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "platform/results/ground_truth.hpp"
#include "platform/results/truth_encoding.hpp"

namespace parallax {

/// The files that hold a ground truth.
struct TruthFiles {
  std::string truth;            ///< a file, or an array of an archive (truth_array.hpp)
  std::string mask;             ///< 8 bit, 255 = score; empty for none
  std::optional<double> scale;  ///< disparity = value / scale; none: 256 for 16-bit integers, 1 for others
  TruthEncoding encoding = TruthEncoding::kValues;
};

/// Reads true disparities of width * height px: a portable float map (Pf), a NumPy array (.npy, or of an
/// .npz), or an image of 8 or 16 bits or floating point, which is grey or has three equal channels, or holds
/// values in an encoding that is stated. Integers: 0 = unknown; floating point and integers with a sign:
/// infinite, no number, or not above 0 = unknown.
///
/// `notice` hears of what was assumed. Throws UserError, one line, if a file is unreadable, of
/// another pixel format or size, or if there is no pixel to score.
GroundTruth read_ground_truth(const TruthFiles& files, int width, int height,
                              const std::function<void(const std::string&)>& notice);

}  // namespace parallax
