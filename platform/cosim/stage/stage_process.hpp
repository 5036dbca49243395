// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace parallax {

/// The program `parallax stage`, with lines to and from it.
class StageProcess {
 public:
  StageProcess() = default;
  StageProcess(const StageProcess&) = delete;
  StageProcess& operator=(const StageProcess&) = delete;
  /// Ends it.
  ~StageProcess();

  /// std::runtime_error when it cannot be started.
  void start(const std::vector<std::string>& arguments);
  /// std::runtime_error, here and below, when it has ended, with what it said.
  void send(const std::string& lines);
  /// The next line of an answer, without what is no answer: its notes.
  std::string answer();
  /// The next line, whatever it is.
  std::string line();

 private:
  [[noreturn]] void has_ended();

  int socket_ = -1;
  pid_t process_ = -1;
  std::string received_;  // not read yet
  std::string said_;      // why it ends
};

}  // namespace parallax
