// SPDX-License-Identifier: Apache-2.0
// Semi-global matching as matching.hpp defines it, on whole images and whole volumes.
#pragma once

#include <algorithm>
#include <cstdlib>

#include "modules/matching.hpp"
#include "tests/modules/images.hpp"

namespace parallax::test {

inline int naive_distance(CensusCode a, CensusCode b) {
  int bits = 0;
  for (int i = 0; i < 64; ++i) bits += static_cast<int>(((a >> i) ^ (b >> i)) & 1U);
  return bits;
}

inline int naive_cost(const MatchingConfig& config, CensusCode a, CensusCode b) {
  if (config.cost == MatchingCost::kHamming) return config.cost_weight * naive_distance(a, b);
  return std::abs(static_cast<int>(a) - static_cast<int>(b));
}

inline Grid<int> naive_costs(const MatchingConfig& config, int code_bits, const Grid<CensusCode>& left,
                             const Grid<CensusCode>& right) {
  Grid<int> costs(left.width, left.height, config.range().count);
  for (int y = 0; y < left.height; ++y) {
    for (int x = 0; x < left.width; ++x) {
      for (int k = 0; k < costs.depth; ++k) {
        const int u = x - (config.disparity_offset + k);
        int& cost = costs.at(x, y, k);
        if (u >= 0) {
          cost = naive_cost(config, left.at(x, y), right.at(u, y));
        } else if (config.outside_cost == OutsideCost::kMaximum) {
          cost = config.cost == MatchingCost::kHamming ? config.cost_weight * code_bits : 255;
        } else if (config.outside_cost == OutsideCost::kReplicate) {
          cost = naive_cost(config, left.at(x, y), right.at(0, y));
        } else if (config.outside_cost == OutsideCost::kValue) {
          cost = config.outside_value;
        } else if (config.outside_cost == OutsideCost::kDelayLine) {
          const int position = y * left.width + u;  // in raster order, wherever that lies
          const CensusCode code = position < 0 ? 0 : right.at(position % left.width, position / left.width);
          cost = naive_cost(config, left.at(x, y), code);
        } else {
          cost = naive_cost(config, left.at(x, y), 0);
        }
      }
    }
  }
  return costs;
}

struct NaivePath {
  unsigned bit;
  int dx;  ///< predecessor, relative
  int dy;
};

struct NaivePredecessor {
  bool exists;
  int x;
  int y;
};

inline NaivePredecessor naive_predecessor(const MatchingConfig& config, NaivePath path, int x, int y, int w,
                                          int h) {
  const bool backwards = path.dy > 0 || (path.dy == 0 && path.dx > 0);
  if (config.path_start == PathStart::kFirstColumn && x == (backwards ? w - 1 : 0)) return {false, 0, 0};
  const auto inside = [&](int u, int v) { return u >= 0 && v >= 0 && u < w && v < h; };
  const int u = x + path.dx;
  const int v = y + path.dy;
  if (inside(u, v)) return {true, u, v};
  const bool diagonal = path.dx != 0 && path.dy != 0;
  if (config.path_start == PathStart::kClamp && diagonal) return {inside(x, v), x, v};
  if (config.path_start == PathStart::kCarry && path.bit == kPathW) return {y > 0, w - 1, y - 1};
  const bool delay_line =
      config.path_start == PathStart::kDelayLine || config.path_start == PathStart::kFirstColumn;
  if (delay_line && path.bit != kPathE) {
    // Raster order from the end the path comes from; turned by 180 degrees for the southern paths.
    const bool turned = path.dy > 0;
    const int here = turned ? (h - 1 - y) * w + (w - 1 - x) : y * w + x;
    const int dx = turned ? -path.dx : path.dx;
    const int rows = path.dy == 0 ? 0 : 1;
    const int distance = rows * w - dx;
    if (distance == 0 || distance > here) return {false, 0, 0};
    const int there = here - distance;
    const int px = there % w;
    const int py = there / w;
    return turned ? NaivePredecessor{true, w - 1 - px, h - 1 - py} : NaivePredecessor{true, px, py};
  }
  return {false, 0, 0};
}

/// In the order of their bits.
inline constexpr NaivePath kNaivePaths[] = {{kPathW, -1, 0},  {kPathNW, -1, -1}, {kPathN, 0, -1},
                                            {kPathNE, 1, -1}, {kPathE, 1, 0},    {kPathSW, -1, 1},
                                            {kPathS, 0, 1},   {kPathSE, 1, 1}};

inline Grid<int> naive_path_costs(const MatchingConfig& config, NaivePath path, const Grid<int>& costs) {
  const int w = costs.width;
  const int h = costs.height;
  Grid<int> along(w, h, costs.depth);
  const bool forward = path.dy < 0 || (path.dy == 0 && path.dx < 0);  // scan in the order of the path
  for (int i = 0; i < w * h; ++i) {
    const int position = forward ? i : w * h - 1 - i;
    const int x = position % w;
    const int y = position / w;
    const NaivePredecessor q = naive_predecessor(config, path, x, y, w, h);
    int lowest = 0;
    if (q.exists) {
      lowest = along.at(q.x, q.y, 0);
      for (int k = 1; k < costs.depth; ++k) lowest = std::min(lowest, along.at(q.x, q.y, k));
    }
    for (int k = 0; k < costs.depth; ++k) {
      int value = costs.at(x, y, k);
      if (q.exists) {
        int best = std::min(along.at(q.x, q.y, k), lowest + config.p2);
        if (k > 0) best = std::min(best, along.at(q.x, q.y, k - 1) + config.p1);
        if (k + 1 < costs.depth) best = std::min(best, along.at(q.x, q.y, k + 1) + config.p1);
        value += best - lowest;
      }
      if (config.path_bits > 0) {
        const int values = 1 << config.path_bits;
        value = config.path_overflow == PathOverflow::kWrap ? value % values : std::min(value, values - 1);
      }
      along.at(x, y, k) = value;
    }
  }
  return along;
}

inline Grid<Cost> naive_matching(const MatchingConfig& config, int code_bits, const Grid<CensusCode>& left,
                                 const Grid<CensusCode>& right) {
  const Grid<int> costs = naive_costs(config, code_bits, left, right);
  Grid<Cost> sums(left.width, left.height, costs.depth);
  for (const NaivePath& path : kNaivePaths) {
    if ((config.paths & path.bit) == 0) continue;
    const Grid<int> along = naive_path_costs(config, path, costs);
    for (std::size_t i = 0; i < sums.data.size(); ++i)
      sums.data[i] = static_cast<Cost>(sums.data[i] + along.data[i]);
  }
  for (Cost& sum : sums.data) sum = static_cast<Cost>(sum / (1 << config.sum_shift));
  return sums;
}

}  // namespace parallax::test
