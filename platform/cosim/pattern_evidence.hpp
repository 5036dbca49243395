// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace parallax {

/// So many tokens a rule must explain: one alone follows any.
inline constexpr std::size_t kLeastExplained = 2;

/// So many tokens that differ must be found elsewhere in the model's image before it is said that it is moved
/// or turned: a few bright pixels may lie anywhere.
inline constexpr std::size_t kLeastMoved = 8;

/// So many of the tokens that differ a guess must explain before all tokens are looked at.
inline constexpr std::size_t kSamples = 200;

/// That all differences lie in a part of the image is no chance where, spread evenly, they would do so once
/// in e^8 images.
inline constexpr double kMissedByChance = 8;

}  // namespace parallax
