// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "platform/results/ground_truth.hpp"

namespace parallax {

/// The files that hold a ground truth.
struct TruthFiles {
  std::string truth;
  std::string mask;             ///< 8 bit, 255 = score; empty for none
  std::optional<double> scale;  ///< disparity = value / scale; none: 256 for 16-bit integers, 1 for others
};

/// Reads true disparities of width * height px: a portable float map (Pf), a NumPy array (.npy), or an image
/// of 8 or 16 bits or floating point, which is grey or has three equal channels. Integers: 0 = unknown;
/// floating point and integers with a sign: infinite, no number, or not above 0 = unknown.
///
/// `notice` hears of a scale that was assumed. Throws UserError, one line, if a file is unreadable, of
/// another pixel format or size, or if there is no pixel to score.
GroundTruth read_ground_truth(const TruthFiles& files, int width, int height,
                              const std::function<void(const std::string&)>& notice);

}  // namespace parallax
