// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>

namespace parallax {

/// A process that answers requests, one after the other: a copy of this one as it was when it was made, for
/// what a process can do once only, or this one cannot do any more, as a SystemC simulation. The copy has the
/// calling thread alone, writes nothing of what this process has buffered, leaves SIGINT and SIGTERM to their
/// default unless they are ignored, and is killed when this object goes or this process ends.
class WorkerProcess {
 public:
  using Work = std::function<std::string(const std::string& request)>;
  enum class State {
    kIdle,
    kWorking,
    kAnswered,  ///< take_answer() has the answer
    kDied,      ///< by signal(), or by itself
  };

  /// How long a caller waits for an answer before it asks whether it was interrupted.
  static constexpr int kPollMilliseconds = 100;

  /// `work` answers a request, in the copy; it must not throw. Throws std::system_error when no process can
  /// be made.
  explicit WorkerProcess(const Work& work);
  ~WorkerProcess();
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  /// Hands over a request, while idle; a worker that does not take it has died.
  void ask(const std::string& request);
  /// What to poll for reading while it works; -1 when it has died.
  int descriptor() const { return descriptor_; }
  /// Waits for at most so many milliseconds for a piece of the answer.
  State receive(int milliseconds);
  State state() const { return state_; }
  /// Once, after which it is idle.
  std::string take_answer();
  /// The signal that ended a process that died; 0: none.
  int signal() const { return signal_; }
  int exit_code() const { return exit_code_; }  ///< of one that has ended itself
  /// Ends it now, whatever it does.
  void kill();

 private:
  void die();

  pid_t process_ = -1;
  int descriptor_ = -1;  ///< requests there, answers back
  State state_ = State::kIdle;
  std::string received_;
  int signal_ = 0;
  int exit_code_ = 0;
};

}  // namespace parallax
