// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/latency_trend.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace parallax {
namespace {

double slope_of(const std::vector<sc_core::sc_time>& latencies) {
  return (latencies.back().to_seconds() - latencies.front().to_seconds()) /
         static_cast<double>(latencies.size() - 1);
}

}  // namespace

bool LatencyTrend::add(std::size_t frame, const sc_core::sc_time& latency) {
  if (frame < first_) return false;
  block_.push_back(latency);
  known_ = known_ || block_.size() >= looks_.least;
  if (block_.size() < looks_.block) return false;
  rising_ = has_trend();
  last_slope_ = rising_ ? slope_of(block_) : 0;
  block_.clear();
  return rising_;
}

bool LatencyTrend::has_trend() const {
  const bool one_way = std::is_sorted(block_.begin(), block_.end()) ||
                       std::is_sorted(block_.begin(), block_.end(), std::greater<>());
  if (!one_way) return false;
  const double least = std::max(kShare * block_.back().to_seconds(), tolerance_.to_seconds());
  return std::abs(block_.back().to_seconds() - block_.front().to_seconds()) > least;
}

double LatencyTrend::slope() const {
  if (settled()) return 0;
  return block_.size() < looks_.least ? last_slope_ : slope_of(block_);
}

}  // namespace parallax
