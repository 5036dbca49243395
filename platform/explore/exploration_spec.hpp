// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "platform/explore/axis.hpp"

namespace parallax {

/// An option of `parallax run` with its values; none: a flag.
struct RunWord {
  std::string option;  ///< "size", without its dashes
  std::vector<std::string> values;
};

/// A key that follows from what varies.
struct LinkedKey {
  std::string key;
  std::string expression;
  std::string origin;  ///< "spec.toml:12", for messages
  bool truth = false;  ///< the key is true or false, which 1 and 0 of a comparison become
};

/// What a point must fulfil to be evaluated.
struct Condition {
  std::string expression;
  std::string origin;
};

enum class SamplingMethod {
  kGrid,            ///< every combination, the last axis changing fastest
  kOneAtATime,      ///< the first value of each axis; then each other value of one axis, the others at their
                    ///< first
  kRandom,          ///< each value by itself
  kLatinHypercube,  ///< each axis cut into as many parts as there are points, each of which occurs once
  kSobol,           ///< a sequence that fills the space evenly, whatever its length
  kSearch,          ///< where the best are (search()), each step from the results of those before
};

/// Whether a method takes as many points as it is told; of the others the axes say how many there are.
constexpr bool draws(SamplingMethod method) {
  return method != SamplingMethod::kGrid && method != SamplingMethod::kOneAtATime;
}

struct SamplingPlan {
  SamplingMethod method = SamplingMethod::kGrid;
  std::size_t points = 0;  ///< of methods that draw; of a search, at most
  std::uint64_t seed = 1;
};

/// A number of a run, or a key that varies, that has to lie within bounds.
struct Constraint {
  std::string metric;  ///< path, "performance/frame_rate"; or "clocks.core_hz"
  std::optional<double> at_least;
  std::optional<double> at_most;
  std::string origin;
};

/// A number of a run, or a key that varies, that is to be as small, or as large, as possible.
struct Objective {
  std::string metric;
  bool most = false;
  std::string origin;
};

/// What `parallax explore` was asked for.
struct ExplorationSpec {
  std::string text;  ///< of the file
  std::string description;
  std::string device;                    ///< whose resources are estimated; empty: of the usual family
  std::vector<RunWord> run;              ///< of every point
  std::vector<std::string> assignments;  ///< "key=value", of every point
  std::vector<Axis> axes;
  std::vector<LinkedKey> links;
  std::vector<Condition> conditions;
  SamplingPlan sampling;
  std::vector<Constraint> constraints;
  std::vector<Objective> objectives;
  std::vector<std::string> metrics;  ///< further ones to be kept

  /// What differs from point to point: axes, then linked keys.
  std::vector<std::string> varied_names() const;
  /// Metrics that constraints, objectives and the list above name, each once.
  std::vector<std::string> named_metrics() const;
};

/// Reads a TOML file: [run], [set], [vary], [link], [sampling], [constraints], [objectives], `conditions`,
/// `metrics`, `device` and `description`. Throws UserError with file and line: unreadable, malformed, unknown
/// or wrong parts, names of keys and options that do not exist. Whether values are in range shows at their
/// points.
ExplorationSpec read_exploration_spec(const std::filesystem::path& file,
                                      const std::vector<std::string>& run_options);

}  // namespace parallax
