// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "platform/input/run_options.hpp"

namespace parallax {

/// What --vary may name beside configuration keys: an option of `parallax run`.
struct VariedOption {
  const char* name;                                            ///< "size", without its dashes
  bool (*given)(const RunOptions& options);                    ///< whether the command line has it, too
  void (*set)(RunOptions& options, const std::string& value);  ///< throws UserError
};

/// A key or an option and the values that it takes in turn, as they were written.
struct VaryAxis {
  std::string name;
  std::vector<std::string> values;
  const VariedOption* option = nullptr;  ///< none: a configuration key
};

/// Every combination of the values of --vary, numbered from 0; the last axis changes fastest.
class VaryGrid {
 public:
  /// Throws UserError when --vary is malformed, names what cannot be varied, or is given beside what it
  /// varies. Values are not looked at, but ranges are.
  explicit VaryGrid(const RunOptions& options);

  const std::vector<VaryAxis>& axes() const { return axes_; }
  std::size_t size() const { return size_; }
  /// The value of an axis, by its index, at a point.
  const std::string& value(std::size_t point, std::size_t axis) const;

  /// "key=value" for each axis that is a key.
  std::vector<std::string> assignments(std::size_t point) const;
  /// Values of the axes that are options.
  std::vector<std::string> option_values(std::size_t point) const;
  /// The options with the point's values of axes that are options. Throws UserError where one is none.
  RunOptions options(const RunOptions& options, std::size_t point) const;
  /// What the command line of a single run has in the place of --vary.
  std::vector<std::string> words(std::size_t point) const;
  bool varies(const std::string& name) const;

  /// Of each combination of options, the first point.
  std::vector<std::size_t> firsts_of_options() const;

 private:
  std::vector<VaryAxis> axes_;
  std::size_t size_ = 1;
};

}  // namespace parallax
