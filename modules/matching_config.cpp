// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "modules/matching.hpp"
#include "modules/require_range.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr int kMaxDisparities = 256;
constexpr int kMaxCost = 255;  // of two pixels
constexpr int kMostPathBits = 16;
constexpr int kMaxShift = 11;      // one bit is left of twelve
constexpr int kMaxCostWeight = 4;  // a weighted cost of 63 bits fits in a byte
constexpr int kMostParallelRows = 64;

}  // namespace

int MatchingConfig::largest_cost(int code_bits) const {
  const int inside = cost == MatchingCost::kHamming ? cost_weight * code_bits : (1 << code_bits) - 1;
  return outside_cost == OutsideCost::kValue ? std::max(inside, outside_value) : inside;
}

void MatchingConfig::validate() const {
  require_range("matching.parallelism", parallelism, 1, kMaxDisparities);
  require_range("matching.parallel_rows", parallel_rows, 1, kMostParallelRows);
  require_range("matching.iterations", iterations, 1, kMaxDisparities);
  require_range("matching.disparity_offset", disparity_offset, 0, kMaxDisparities - 1);
  if (disparity_offset + iterations * parallelism > kMaxDisparities) {
    throw UserError(
        fmt::format("matching.disparity_offset + matching.iterations x matching.parallelism = {} + {} x {} = "
                    "{}: must be at most {}",
                    disparity_offset, iterations, parallelism, disparity_offset + iterations * parallelism,
                    kMaxDisparities));
  }
  require_range("matching.recurrence_latency", recurrence_latency, 1, 1000);
  require_range("matching.cost_weight", cost_weight, 1, kMaxCostWeight);
  require_range("matching.outside_value", outside_value, 0, kMaxCost);
  if (outside_cost != OutsideCost::kValue && outside_value != kMaxCost) {
    throw UserError(
        fmt::format("matching.outside_value = {}: has no effect without matching.outside_cost = \"value\"",
                    outside_value));
  }
  require_range("matching.p1", p1, 0, kMaxPenalty);
  require_range("matching.p2", p2, 0, kMaxPenalty);
  if (p1 >= p2) throw UserError(fmt::format("matching.p1 = {}: must be below matching.p2 = {}", p1, p2));
  require_range("matching.path_bits", path_bits, 0, kMostPathBits);
  if (path_overflow == PathOverflow::kWrap && path_bits == 0) {
    throw UserError(
        "matching.path_overflow = \"wrap\": has no effect with matching.path_bits = 0, as many as needed");
  }
  require_range("matching.sum_shift", sum_shift, 0, kMaxShift);
  if (paths == 0 || paths > kEightPaths) {
    throw UserError(
        fmt::format("matching.paths = {:#x}: must name one to eight of w, nw, n, ne, e, sw, s, se", paths));
  }
}

void MatchingConfig::validate_tokens(int pixels) const {
  const bool whole = pixels % parallel_rows == 0 || parallel_rows % pixels == 0;
  if (!whole || pixels * iterations % parallel_rows != 0) {
    throw UserError(fmt::format(
        "matching.parallel_rows = {}: must be a multiple or a divisor of pipeline.pixels_per_token = {}, "
        "and divide pipeline.pixels_per_token * matching.iterations = {}",
        parallel_rows, pixels, pixels * iterations));
  }
  if (parallel_rows > 1 && path_start != PathStart::kCost && path_start != PathStart::kClamp) {
    throw UserError(
        fmt::format("matching.parallel_rows = {}: needs matching.path_start = \"cost\" or \"clamp\", "
                    "with others paths go on over the ends of rows",
                    parallel_rows));
  }
  if (parallel_rows > 1 && path_storage == PathStorage::kMemory) {
    throw UserError(fmt::format(
        "matching.parallel_rows = {}: needs matching.path_storage = \"on_chip\", costs of rows at once "
        "do not pass the memory",
        parallel_rows));
  }
}

void MatchingConfig::validate_census(bool census) const {
  if (cost == MatchingCost::kHamming && !census) {
    throw UserError(
        "matching.cost = \"hamming\": needs census.enabled = true; grey values have "
        "\"absolute_difference\"");
  }
  if (cost == MatchingCost::kAbsoluteDifference && census) {
    throw UserError(
        "matching.cost = \"absolute_difference\": needs census.enabled = false, it is of grey values");
  }
}

}  // namespace parallax
