// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/notes.hpp"

#include "platform/commands/command_context.hpp"

namespace parallax {

void Notes::operator()(const std::string& line) {
  if (context_.verbosity == Verbosity::kQuiet || !said_.insert(line).second) return;
  if (held_) {
    waiting_.push_back(line);
  } else {
    context_.err << "parallax: note: " << line << '\n';
  }
}

void Notes::begin() {
  held_ = false;
  for (const std::string& line : waiting_) context_.err << "parallax: note: " << line << '\n';
  waiting_.clear();
}

}  // namespace parallax
