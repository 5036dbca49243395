// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "platform/evaluation/evaluation_result.hpp"

namespace parallax {

/// Time from frame to frame in the steady state, exact: so many picoseconds for so many frames.
struct FramePeriod {
  std::int64_t picoseconds = 0;
  std::int64_t frames = 1;

  double milliseconds() const;
  /// frames/s.
  double rate() const;
  /// Whether it is no longer than `other`, or by no more than this share of it; without one, to the
  /// picosecond.
  bool keeps(const FramePeriod& other, double tolerance) const;
};

/// Of a machine that was measured (EvaluationResult::done()) over more frames than one.
FramePeriod frame_period(const EvaluationResult& result);

}  // namespace parallax
