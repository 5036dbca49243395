// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "platform/config/config_value.hpp"

namespace parallax {

/// An expression over named values, in the language of SQLite's expressions: arithmetic, comparisons, and,
/// or, not, between, in, case, and functions as min(), max(), abs(), round(), ceil(), log(). 7 / 2 is 3, as
/// both are whole. A name is a configuration key or an option, "matching.p1".
class Expression {
 public:
  /// `names`: what may occur. Throws UserError, beginning with `origin`: malformed, or another name.
  Expression(const std::string& text, const std::vector<std::string>& names, const std::string& origin);
  ~Expression();
  Expression(Expression&&) noexcept;
  Expression& operator=(Expression&&) noexcept;

  /// With values in the order of the names. Throws UserError where there is no value, as of a division by 0.
  ConfigValue value(const std::vector<ConfigValue>& values);
  /// Whether it is true: a number other than 0. Without a value it is not.
  bool holds(const std::vector<ConfigValue>& values);

 private:
  struct Compiled;
  std::unique_ptr<Compiled> compiled_;
};

}  // namespace parallax
