// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <csignal>
#include <string>

namespace parallax {

struct CommandContext;

/// While it lives, SIGINT (Ctrl-C) and SIGTERM are noted instead of ending the program, so that a run can
/// stop in an orderly way. Each is noted once: the second one ends the program at once, and so does the first
/// one after 10 s if the program has not stopped until then. A signal that was ignored before (nohup) stays
/// ignored. One at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  bool requested() const { return signal() != 0; }
  /// The signal noted, 0 for none.
  int signal() const;

 private:
  std::array<struct sigaction, 2> before_{};
};

/// Says how far a command came, "12 of 40 points", and returns the exit code of a program that a signal
/// ended.
int interrupted_after(const std::string& how_far, CommandContext& context, const Interruption& interruption);

}  // namespace parallax
