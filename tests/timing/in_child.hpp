// SPDX-License-Identifier: Apache-2.0
// A process holds one SystemC simulation, so each of many gets a process of its own.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <exception>
#include <string>

namespace parallax::test {

/// What `action` returns, run in a child process; an exception's text instead, if it throws one.
template <class Action>
std::string in_child(const Action& action) {
  int channel[2];
  if (pipe(channel) != 0) return "no pipe";
  const pid_t child = fork();
  if (child == 0) {
    close(channel[0]);
    std::string text;
    try {
      text = action();
    } catch (const std::exception& e) {
      text = e.what();
    }
    std::size_t sent = 0;
    while (sent < text.size()) {
      const ssize_t n = write(channel[1], text.data() + sent, text.size() - sent);
      if (n <= 0) _exit(1);
      sent += static_cast<std::size_t>(n);
    }
    _exit(0);
  }
  close(channel[1]);
  std::string text;
  char buffer[4096];
  for (ssize_t n; (n = read(channel[0], buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(n));
  close(channel[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) text += "the simulation ended abnormally\n";
  return text;
}

}  // namespace parallax::test
