// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace parallax {

/// How a function ended that ran in a process of its own.
struct ForkedCall {
  std::string output;        ///< what it returned; a part of it, if a signal ended it
  int signal = 0;            ///< that ended the process; 0: none
  bool interrupted = false;  ///< the caller gave up on it
};

/// Runs `function` in a copy of this process and returns when that has ended: for what a process can do once
/// only, as a SystemC simulation. The copy has this thread alone, writes nothing of what this process has
/// buffered, leaves SIGINT and SIGTERM to their default unless they are ignored, and does not outlive this
/// process. `function` must not throw. `interrupted` is asked some ten times a second; when it says yes, the
/// copy is killed. Throws std::system_error when no process or pipe can be made.
ForkedCall call_in_fork(const std::function<std::string()>& function,
                        const std::function<bool()>& interrupted);

}  // namespace parallax
