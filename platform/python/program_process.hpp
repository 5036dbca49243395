// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "platform/evaluation/worker_process.hpp"

namespace parallax {

/// What a command of the program came to.
struct ProgramOutcome {
  int code = 0;     ///< exit_codes.hpp
  std::string out;  ///< what it printed
  std::string err;  ///< what it said on standard error
};

/// A command of the program, in a copy of this process, which ends with this object.
class ProgramProcess {
 public:
  /// `words`: behind `parallax`. Throws std::system_error when there can be no process.
  explicit ProgramProcess(std::vector<std::string> words);

  /// Waits for a tenth of a second, or until a signal arrives; says whether the command is over.
  bool wait();
  /// Once, when it is. Throws std::runtime_error when the process died.
  ProgramOutcome outcome();

 private:
  const std::vector<std::string> words_;
  WorkerProcess process_;
};

}  // namespace parallax
