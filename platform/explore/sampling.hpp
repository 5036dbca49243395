// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "platform/explore/exploration_spec.hpp"

namespace parallax {

/// Places in the unit cube, one after the other; the same ones for the same seed, on every computer.
class PlaceSource {
 public:
  virtual ~PlaceSource() = default;
  /// One number from 0 to below 1 for each dimension; nothing when there are no more.
  virtual std::optional<std::vector<double>> next() = 0;
};

/// Any, without end. Sobol's are Joe and Kuo's, each dimension shifted by bits of its own, which the seed
/// gives (a digital shift: it keeps how evenly they lie). Of a Latin hypercube there are as many as points.
std::unique_ptr<PlaceSource> make_place_source(const SamplingPlan& plan, std::size_t dimensions);

/// Which value each axis has at the points of a plan.
class Sampling {
 public:
  /// Both must outlive this object.
  Sampling(const std::vector<Axis>& axes, const SamplingPlan& plan);

  /// The values of the next point, by axis; nothing after the last, unless they are drawn at random.
  std::optional<std::vector<std::string>> next();

 private:
  std::optional<std::vector<std::string>> next_of_grid();
  std::optional<std::vector<std::string>> next_at_a_time();

  const std::vector<Axis>& axes_;
  const SamplingMethod method_;
  std::unique_ptr<PlaceSource> places_;
  std::vector<std::size_t> at_;  // of a grid: index of each axis' next value; none after the last
  // One at a time: which axis is next, with which value; before the first axis the base.
  std::size_t axis_ = 0;
  std::size_t value_ = 0;
};

}  // namespace parallax
