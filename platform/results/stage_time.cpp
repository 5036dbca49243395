// SPDX-License-Identifier: Apache-2.0
#include "platform/results/stage_time.hpp"

#include <algorithm>
#include <numeric>

namespace parallax {

StageStatistics stage_time(const StageInfo& info, const SteadyWindow& window) {
  if (window.frames() == 0) return info.stage->statistics();
  StageStatistics time = info.first_pass(window.last).before;
  return time -= info.first_pass(window.first).before;
}

std::vector<std::int64_t> shares_of(const std::vector<std::int64_t>& parts, std::int64_t whole) {
  std::vector<std::int64_t> shares(parts.size());
  const std::int64_t sum = std::accumulate(parts.begin(), parts.end(), std::int64_t{0});
  if (sum == 0) return shares;
  std::vector<std::int64_t> remainders(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    shares[i] = parts[i] * whole / sum;  // within 64 bits up to 9 * 10^15 cycles
    remainders[i] = parts[i] * whole % sum;
  }
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return remainders[a] > remainders[b]; });
  const std::int64_t missing = whole - std::accumulate(shares.begin(), shares.end(), std::int64_t{0});
  for (std::int64_t i = 0; i < missing; ++i) ++shares[order[i]];
  return shares;
}

}  // namespace parallax
