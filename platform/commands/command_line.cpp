// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/command_line.hpp"

#include <algorithm>

#include "platform/input/quoted_text.hpp"

namespace parallax {

CommandLine::CommandLine(int argc, const char* const* argv) : words_(argv + std::min(1, argc), argv + argc) {}

std::string CommandLine::text() const {
  std::string line = "parallax";
  for (const std::string& word : words_) line += ' ' + shell_word(word);
  return line;
}

CommandLine CommandLine::with(const std::vector<std::string>& removed,
                              const std::vector<std::string>& added) const {
  CommandLine line = *this;
  line.words_.clear();
  for (std::size_t i = 0; i < words_.size(); ++i) {
    const std::string option = words_[i].substr(0, words_[i].find('='));
    if (std::find(removed.begin(), removed.end(), option) == removed.end()) {
      line.words_.push_back(words_[i]);
    } else if (option == words_[i]) {
      ++i;  // its value
    }
  }
  line.words_.insert(line.words_.end(), added.begin(), added.end());
  return line;
}

CommandLine CommandLine::beginning(const std::vector<std::string>& first,
                                   const std::vector<std::string>& dropped) const {
  CommandLine line = *this;
  line.words_ = first;
  for (const std::string& word : words_) {
    if (std::find(dropped.begin(), dropped.end(), word) == dropped.end()) line.words_.push_back(word);
  }
  return line;
}

}  // namespace parallax
