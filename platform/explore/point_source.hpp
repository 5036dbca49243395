// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "platform/explore/exploration_spec.hpp"
#include "platform/explore/point_rules.hpp"
#include "platform/explore/sampling.hpp"

namespace parallax {

/// A point of an exploration.
struct ExplorationPoint {
  std::size_t number = 0;           ///< from 0
  std::vector<std::string> values;  ///< in the order of ExplorationSpec::varied_names()
};

/// The points of an exploration, one after the other: sampled values, the keys that follow from them, and
/// only those that fulfil the conditions.
class PointSource {
 public:
  /// `spec` must outlive this object. Throws UserError: an expression is malformed.
  explicit PointSource(const ExplorationSpec& spec);

  /// Nothing after the last one. Throws UserError when conditions leave (nearly) nothing of a random sample,
  /// or a linked key has no value.
  std::optional<ExplorationPoint> next();

 private:
  const ExplorationSpec& spec_;
  Sampling sampling_;
  PointRules rules_;
  std::size_t found_ = 0;
  std::size_t drawn_ = 0;
};

/// How many points a source has, at most `most`, without keeping them. Throws UserError, too, when it is
/// more.
std::size_t count_points(const ExplorationSpec& spec, std::size_t most);

/// "key=value" of what is a key at a point.
std::vector<std::string> assignments_of(const ExplorationSpec& spec, const ExplorationPoint& point);
/// What are options of `parallax run` at a point.
std::vector<RunWord> run_words_of(const ExplorationSpec& spec, const ExplorationPoint& point);

}  // namespace parallax
