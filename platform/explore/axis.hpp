// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace parallax {

/// Numbers between two, of which a sample takes any.
struct Span {
  double least = 0;
  double most = 0;           ///< above least
  bool logarithmic = false;  ///< each ratio as often as the next; least > 0
  bool whole = false;        ///< integers, both ends included
};

/// What takes several values in an exploration: a configuration key, or an option of `parallax run`.
struct Axis {
  std::string name;                 ///< "clocks.core_hz", "size"
  bool option = false;              ///< of `parallax run`
  std::vector<std::string> values;  ///< as an assignment has them; none where there is a span
  std::optional<Span> span;
};

/// The value at this place of an axis, 0 <= place < 1: of a list each as often as the next. Numbers of a span
/// have seven significant digits, so that they are the same wherever they are printed.
std::string value_at(const Axis& axis, double place);

/// Numbers from `least` to `most`, each `factor` times the one before; the last at most `most`. Whole ones
/// are rounded, and none comes twice. Needs 0 < least <= most and factor > 1.
std::vector<std::string> logarithmic_values(double least, double most, double factor, bool whole);

}  // namespace parallax
