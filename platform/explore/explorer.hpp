// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "platform/evaluation/evaluation_pool.hpp"
#include "platform/explore/exploration_spec.hpp"
#include "platform/explore/point_share.hpp"
#include "platform/explore/point_source.hpp"
#include "platform/explore/result_store.hpp"

namespace parallax {

/// What a point is, without its evaluation.
struct PointIdentity {
  std::string configuration;  ///< hash of it (configuration_hash)
  std::string input;          ///< as options of `parallax run`; with what files hold, for the identity
  std::string command;        ///< that runs it alone
  std::uint64_t seed = 0;     ///< of the built-in scene
};

/// The same for the same machine on the same input, of the same build of the program.
std::string result_identity(const PointIdentity& what);

/// A point with its result, of which these metrics are kept.
StoredPoint stored_point(const ExplorationPoint& point, const PointIdentity& what,
                         const EvaluationResult& result, const std::vector<std::string>& metrics);

/// Points and what became of them.
struct ExplorationCounts {
  std::size_t points = 0;     ///< those that are there
  std::size_t evaluated = 0;  ///< now
  std::size_t not_done = 0;   ///< invalid, stuck or failed
  bool whole = false;         ///< none is missing
};

/// Metrics that are kept of every point: what the specification names, then some that most ask for, each
/// once.
std::vector<std::string> kept_metrics(const ExplorationSpec& spec);

/// Evaluates the points of an exploration that its store does not know, as many at a time as the pool does.
class Explorer {
 public:
  /// Says what a point is; throws UserError where it is no possible machine or has no possible input.
  using Identify = std::function<PointIdentity(const ExplorationPoint&)>;
  /// What has become of so many further points.
  using Advance = std::function<void(std::size_t)>;

  /// All must outlive this object. The pool's preparation is given a point's values as assignments; without a
  /// pool, what is not known is left out.
  Explorer(const ExplorationSpec& spec, ResultStore& store, EvaluationPool* pool, Identify identify,
           PointShare share);

  /// Until all points are there, or interrupted (asked some ten times a second).
  ExplorationCounts run(const std::function<bool()>& interrupted, const Advance& advance);

 private:
  bool look_at_all();
  bool search_for_best();
  void look_at(const ExplorationPoint& point);
  void evaluate();
  void take(StoredPoint& point, const EvaluationResult& result);
  bool stands(const StoredPoint& point);
  void keep(const StoredPoint& point);

  const ExplorationSpec& spec_;
  ResultStore& store_;
  EvaluationPool* pool_;
  Identify identify_;
  const PointShare share_;
  std::function<bool()> interrupted_;
  Advance advance_;
  std::vector<std::string> metrics_;
  std::vector<StoredPoint> waiting_;  // to be evaluated, each with another identity
  std::vector<StoredPoint> twins_;    // with the identity of one of these
  ExplorationCounts counts_;
};

}  // namespace parallax
