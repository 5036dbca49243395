// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "platform/evaluation/evaluation_pool.hpp"

namespace parallax {

/// A run of which the time alone is wanted: `parallax run` with the words of its input, then of its machine.
struct TimedPoint {
  std::vector<std::string> input;    ///< "--timing-only", "--size", "640x480", ...
  std::vector<std::string> machine;  ///< "--preset", "--set", ...

  std::vector<std::string> words() const;
};

/// Points, and processes that evaluate them.
class EvaluatedPoints {
 public:
  /// `processes`: at most so many; 0: as many as this computer has processors, eight at most.
  EvaluatedPoints(std::vector<TimedPoint> points, unsigned processes);
  ~EvaluatedPoints();
  EvaluatedPoints(const EvaluatedPoints&) = delete;
  EvaluatedPoints& operator=(const EvaluatedPoints&) = delete;

  /// Hands the results to `take` in the order of the points, with the configuration; what is wrong with a
  /// point is its status. Says whether that were all; not when `interrupted` said yes.
  bool evaluate(const std::function<bool()>& interrupted, const EvaluationPool::Taker& take);

 private:
  class Inputs;

  EvaluationCase prepare(const TimedPoint& point, const NoticeSink& notice);

  const std::vector<TimedPoint> points_;
  const std::unique_ptr<Inputs> inputs_;  // in each of the processes
  EvaluationPool pool_;
};

}  // namespace parallax
