// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "platform/config/config_value.hpp"
#include "platform/explore/exploration_spec.hpp"
#include "platform/explore/expression.hpp"

namespace parallax {

/// What follows from the values of an exploration's axes: linked keys, and whether the conditions hold. Both
/// may use the keys that are the same at every point.
class PointRules {
 public:
  /// `spec` must outlive this object. Throws UserError: an expression is malformed.
  explicit PointRules(const ExplorationSpec& spec);

  /// Adds the linked keys' values to those of the axes; false where a condition does not hold. Throws
  /// UserError where a linked key has no value.
  bool complete(std::vector<std::string>& values);

 private:
  ConfigValue linked_value(std::size_t link, const std::vector<ConfigValue>& known,
                           const std::vector<std::string>& values);

  const ExplorationSpec& spec_;
  std::vector<ConfigValue> constants_;
  std::vector<Expression> links_;
  std::vector<Expression> conditions_;
};

}  // namespace parallax
