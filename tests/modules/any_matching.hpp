// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <rapidcheck.h>

#include "modules/matching.hpp"

namespace parallax::test {

/// Of a property: a matcher as it may be configured, but for its time.
inline MatchingConfig any_matching_config() {
  MatchingConfig config;
  config.parallelism = *rc::gen::element(1, 2, 7, 16, 32);
  config.iterations = *rc::gen::inRange(1, 4);
  config.disparity_offset = *rc::gen::element(0, 1, 5, 160);
  config.cost = *rc::gen::element(MatchingCost::kHamming, MatchingCost::kAbsoluteDifference);
  config.cost_weight = *rc::gen::inRange(1, 5);
  config.p1 = *rc::gen::element(0, 1, 8, 254);
  config.p2 = *rc::gen::inRange(config.p1 + 1, 256);
  config.paths = *rc::gen::inRange(1U, kEightPaths + 1);
  config.outside_cost =
      *rc::gen::element(OutsideCost::kMaximum, OutsideCost::kReplicate, OutsideCost::kZeroCode,
                        OutsideCost::kDelayLine, OutsideCost::kValue);
  if (config.outside_cost == OutsideCost::kValue) config.outside_value = *rc::gen::element(0, 7, 255);
  config.path_start = *rc::gen::element(PathStart::kCost, PathStart::kClamp, PathStart::kCarry,
                                        PathStart::kDelayLine, PathStart::kFirstColumn);
  config.path_bits = *rc::gen::element(0, 1, 5, 7, 8, 9, 16);
  if (config.path_bits > 0) {
    config.path_overflow = *rc::gen::element(PathOverflow::kSaturate, PathOverflow::kWrap);
  }
  config.sum_shift = *rc::gen::element(0, 0, 1, 3, 11);
  return config;
}

}  // namespace parallax::test
