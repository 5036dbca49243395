// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace parallax {

/// The command line as typed.
class CommandLine {
 public:
  CommandLine(int argc, const char* const* argv);

  /// Quoted for a shell; the program is "parallax".
  std::string text() const;
  /// Without these options, each of which takes a value, and with more words at its end.
  CommandLine with(const std::vector<std::string>& removed, const std::vector<std::string>& added) const;
  /// Without these words, wherever they stand, and with others at its beginning.
  CommandLine beginning(const std::vector<std::string>& first, const std::vector<std::string>& dropped) const;

 private:
  std::vector<std::string> words_;  // after the program
};

}  // namespace parallax
