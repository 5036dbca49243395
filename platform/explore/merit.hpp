// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "platform/explore/exploration_spec.hpp"
#include "platform/explore/result_store.hpp"

namespace parallax {

/// The numbers of a point by their names: metrics, and keys that vary.
class PointNumbers {
 public:
  explicit PointNumbers(const ExplorationSpec& spec) : varied_(spec.varied_names()) {}
  /// None where it is no number, or there is none.
  std::optional<double> of(const StoredPoint& point, const std::string& name) const;

 private:
  std::vector<std::string> varied_;
};

/// How good a machine is.
struct Merit {
  enum class Kind {
    kAllowed,   ///< measured; it may miss constraints
    kFailed,    ///< no possible machine, stuck, or without one of the numbers
    kExcluded,  ///< a condition leaves it out
  } kind = Kind::kExcluded;
  double missed = 0;          ///< sum of the misses of all constraints (miss())
  std::vector<double> costs;  ///< by objective, the less the better

  bool satisfies() const { return kind == Kind::kAllowed && missed == 0; }
};

/// Of a point that is there.
Merit merit_of(const ExplorationSpec& spec, const StoredPoint& point);

/// Deb's constrained domination (2002): who satisfies all constraints beats who does not, of two that do not
/// the one that misses by less wins, of two that do the one that is at least as good in all objectives and
/// better in one. What could not be measured loses against what was, and what is excluded against all.
bool beats(const Merit& a, const Merit& b);

}  // namespace parallax
