// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/frame_period.hpp"

#include <cmath>

namespace parallax {
namespace {

constexpr double kPicoseconds = 1e12;  // of a second

}  // namespace

double FramePeriod::milliseconds() const { return 1e3 / rate(); }

double FramePeriod::rate() const {
  return kPicoseconds * static_cast<double>(frames) / static_cast<double>(picoseconds);
}

bool FramePeriod::keeps(const FramePeriod& other, double tolerance) const {
  // Of 64 bits: products of a day's picoseconds and a hundred frames are whole.
  const auto mine = static_cast<long double>(picoseconds) * static_cast<long double>(other.frames);
  const auto others = static_cast<long double>(other.picoseconds) * static_cast<long double>(frames);
  return mine <= others * (1 + static_cast<long double>(tolerance));
}

// The rate is the frames divided by whole picoseconds, with 53 bits: rounding gives these back.
FramePeriod frame_period(const EvaluationResult& result) {
  const std::int64_t frames = result.metrics.count("steady/frames") - 1;
  return {std::llround(kPicoseconds * static_cast<double>(frames) / result.rate), frames};
}

}  // namespace parallax
