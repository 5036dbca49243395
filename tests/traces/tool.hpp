// SPDX-License-Identifier: Apache-2.0
// Programs of others, which read what the traces hold.
#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace parallax::test {

/// What a shell command says on standard output; throws when it fails.
inline std::string output_of(const std::string& command) {
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
  std::string text;
  char buffer[1 << 16];
  for (std::size_t got = 0; (got = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) text.append(buffer, got);
  if (::pclose(pipe) != 0) throw std::runtime_error("failed: " + command + "\n" + text);
  return text;
}

inline bool is_installed(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null").c_str()) == 0;
}

}  // namespace parallax::test

/// Skips the test where a program that it reads with is not installed.
#define SKIP_WITHOUT(program, package)                                           \
  if (!parallax::test::is_installed(program)) {                                  \
    GTEST_SKIP() << program << " is not installed (Debian package " package ")"; \
  }
