// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "platform/explore/axis.hpp"

namespace parallax {

/// A machine of a space: of each axis the index of its value.
using Place = std::vector<std::size_t>;

/// What a search chooses from: the values of each axis in their order. Of a span these are all whole numbers,
/// if they are few, or else kSteps numbers, evenly apart, both ends included.
class SearchSpace {
 public:
  static constexpr std::size_t kSteps = 101;

  explicit SearchSpace(const std::vector<Axis>& axes);

  /// How many values each axis has.
  std::vector<std::size_t> sizes() const;
  /// How many machines there are, conditions aside.
  double machines() const;
  std::vector<std::string> values(const Place& place) const;

 private:
  std::vector<std::vector<std::string>> axes_;
};

}  // namespace parallax
