// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace parallax {

struct CommandContext;

/// What a user should know of how the input is taken: a line on standard error for each, said once.
class Notes {
 public:
  /// `held`: until begin(), so that an error before that is one line.
  explicit Notes(CommandContext& context, bool held = false) : context_(context), held_(held) {}

  void operator()(const std::string& line);
  void begin();
  /// The same for who knows no notes; this object outlives it.
  std::function<void(const std::string&)> sink() {
    return [this](const std::string& line) { (*this)(line); };
  }

 private:
  CommandContext& context_;
  bool held_;
  std::vector<std::string> waiting_;
  std::set<std::string> said_;
};

}  // namespace parallax
