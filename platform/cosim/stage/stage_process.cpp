// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/stage/stage_process.hpp"

#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

extern char** environ;

namespace parallax {
namespace {

constexpr const char* kMessage = "parallax: error: ";  // how the program begins its last line

}  // namespace

StageProcess::~StageProcess() {
  if (socket_ >= 0) ::close(socket_);  // the end of what it reads
  if (process_ > 0) ::waitpid(process_, nullptr, 0);
}

// A pair of sockets, and not pipes: what is sent to a program that has ended must not end the simulator
// (SIGPIPE).
void StageProcess::start(const std::vector<std::string>& arguments) {
  const char* const named = std::getenv("PARALLAX");
  const std::string program = named != nullptr && *named != '\0' ? named : "parallax";
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw std::runtime_error(std::string("no socket: ") + std::strerror(errno));
  socket_ = ends[0];
  std::vector<char*> words{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    ::posix_spawn_file_actions_adddup2(&actions, ends[1], descriptor);
  const int failed = ::posix_spawnp(&process_, program.c_str(), &actions, nullptr, words.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  if (failed == 0) return;
  process_ = -1;
  throw std::runtime_error("the program " + program + " cannot be started (" + std::strerror(failed) +
                           "); PARALLAX in the environment says where it is, else PATH");
}

void StageProcess::send(const std::string& lines) {
  for (std::size_t sent = 0; sent < lines.size();) {
    const ssize_t size = ::send(socket_, lines.data() + sent, lines.size() - sent, MSG_NOSIGNAL);
    if (size >= 0) {
      sent += static_cast<std::size_t>(size);
    } else if (errno != EINTR) {
      has_ended();
    }
  }
}

std::string StageProcess::answer() {
  for (;;) {
    const std::string next = line();
    if (next.find_first_not_of("0123456789abcdef ") == std::string::npos) return next;
  }
}

std::string StageProcess::line() {
  for (std::size_t from = 0;;) {
    const std::size_t end = received_.find('\n', from);
    if (end != std::string::npos) {
      std::string next = received_.substr(0, end);
      received_.erase(0, end + 1);
      if (next.rfind(kMessage, 0) == 0) said_ = next.substr(std::strlen(kMessage));
      return next;
    }
    from = received_.size();
    char piece[1 << 16];
    const ssize_t size = ::recv(socket_, piece, sizeof piece, 0);
    if (size > 0) {
      received_.append(piece, static_cast<std::size_t>(size));
    } else if (size == 0 || errno != EINTR) {
      throw std::runtime_error(said_.empty() ? "the program parallax has ended" : said_);
    }
  }
}

// What it said last is the reason.
void StageProcess::has_ended() {
  for (;;) line();
}

}  // namespace parallax
