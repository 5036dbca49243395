// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/latency_trend.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace parallax {
namespace {

constexpr std::size_t kMostMeans = 64;
constexpr double kDeviations = 2.5;  // of the difference of two halves, that noise explains

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
  const bool rising = has_trend();
  if (rising) last_slope_ = slope_of(block_);
  calm_ = rising ? 0 : calm_ + 1;
  // The first block without a trend may begin with the end of it.
  const bool anew = calm_ < kCalm;
  if (anew) {
    forget_means();
  } else {
    keep_mean();
  }
  block_.clear();
  return anew;
}

bool LatencyTrend::has_trend() const {
  const double change = block_.back().to_seconds() - block_.front().to_seconds();
  const double least = std::max(kShare * block_.back().to_seconds(), tolerance_.to_seconds());
  if (std::abs(change) <= least) return false;
  double back = 0;
  for (std::size_t i = 1; i < block_.size(); ++i) {
    const double step = block_[i].to_seconds() - block_[i - 1].to_seconds();
    if (step * change < 0) back += std::abs(step);
  }
  return back <= looks_.back * std::abs(change);
}

void LatencyTrend::forget_means() {
  means_.clear();
  blocks_a_mean_ = 1;
  sum_ = 0;
  summed_ = 0;
}

void LatencyTrend::keep_mean() {
  for (const sc_core::sc_time& latency : block_)
    sum_ += latency.to_seconds() / static_cast<double>(looks_.block);
  if (++summed_ < blocks_a_mean_) return;
  means_.push_back(sum_ / static_cast<double>(summed_));
  sum_ = 0;
  summed_ = 0;
  if (means_.size() < kMostMeans) return;
  for (std::size_t i = 0; i < kMostMeans / 2; ++i) means_[i] = (means_[2 * i] + means_[2 * i + 1]) / 2;
  means_.resize(kMostMeans / 2);
  blocks_a_mean_ *= 2;
}

double LatencyTrend::drift() const {
  const std::size_t half = means_.size() / 2;
  if (half < 2) return 0;
  const auto middle = means_.end() - static_cast<std::ptrdiff_t>(half);
  const double number = static_cast<double>(half);
  const double before =
      std::accumulate(means_.begin(), means_.begin() + static_cast<std::ptrdiff_t>(half), 0.0) / number;
  const double after = std::accumulate(middle, means_.end(), 0.0) / number;
  // A mean's variance from neighbours, which a slow change leaves alone.
  double squares = 0;
  for (std::size_t i = 1; i < means_.size(); ++i)
    squares += (means_[i] - means_[i - 1]) * (means_[i] - means_[i - 1]);
  const double variance = squares / 2 / static_cast<double>(means_.size() - 1);
  const double noise = kDeviations * std::sqrt(2 * variance / number);
  if (std::abs(after - before) <= std::max({kHalvesShare * after, noise, tolerance_.to_seconds()})) return 0;
  const double frames = static_cast<double>((means_.size() - half) * blocks_a_mean_ * looks_.block);
  return (after - before) / frames;
}

double LatencyTrend::slope() const {
  if (last_settled()) return drift();
  return block_.size() < looks_.least || !has_trend() ? last_slope_ : slope_of(block_);
}

}  // namespace parallax
