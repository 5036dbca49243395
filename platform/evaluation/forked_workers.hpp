// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

namespace parallax {

/// Processes that stand by to do one kind of work: copies of this process as it was when they were made, for
/// what it cannot do any more later, as a SystemC simulation. They end with this object, or with the process.
class ForkedWorkers {
 public:
  /// `work` answers a request, in a worker; it must not throw. Throws std::system_error when no process can
  /// be made.
  ForkedWorkers(unsigned count, std::function<std::string(const std::string& request)> work);
  ~ForkedWorkers();
  ForkedWorkers(const ForkedWorkers&) = delete;
  ForkedWorkers& operator=(const ForkedWorkers&) = delete;

  /// The answers to all requests, in their order, each from the worker that was free first; an empty one from
  /// a worker that died. `interrupted` is asked some ten times a second; when it says yes, what has not been
  /// answered stays empty. `done` is called for each answer.
  std::vector<std::string> answer(const std::vector<std::string>& requests,
                                  const std::function<bool()>& interrupted,
                                  const std::function<void()>& done);

 private:
  struct Worker {
    pid_t process = -1;
    int requests = -1;  // descriptors; -1: closed
    int answers = -1;
    std::ptrdiff_t working_on = -1;  // number of the request; -1: none
    std::string received;
  };

  void start(Worker& worker, const std::function<std::string(const std::string&)>& work);
  void end(Worker& worker);
  bool ask(Worker& worker, const std::string& request);
  bool receive(Worker& worker, std::string& answer);

  std::vector<Worker> workers_;
};

}  // namespace parallax
