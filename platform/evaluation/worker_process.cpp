// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/worker_process.hpp"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <system_error>
#include <utility>

namespace parallax {
namespace {

// A message is its length and its bytes.
using Length = std::uint64_t;

// Whether all bytes were handled. `once`: sends or receives a piece, as send() and recv() do.
template <class Byte, class Once>
bool transfer(Byte* bytes, std::size_t size, const Once& once) {
  while (size > 0) {
    const ssize_t count = once(bytes, size);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes += count;
    size -= count;
  }
  return true;
}

bool send_message(int descriptor, const std::string& text) {
  const Length length = text.size();
  const auto once = [descriptor](const char* bytes, std::size_t size) {
    return ::send(descriptor, bytes, size, MSG_NOSIGNAL);
  };
  return transfer(reinterpret_cast<const char*>(&length), sizeof length, once) &&
         transfer(text.data(), text.size(), once);
}

bool receive_message(int descriptor, std::string& text) {
  Length length = 0;
  const auto once = [descriptor](char* bytes, std::size_t size) {
    return ::recv(descriptor, bytes, size, 0);
  };
  if (!transfer(reinterpret_cast<char*>(&length), sizeof length, once)) return false;
  text.resize(length);
  return transfer(text.data(), text.size(), once);
}

// Signals end a copy as they would a program of its own, and it ends with its parent.
void become_child_of(pid_t parent) {
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction action {};
    ::sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_IGN) std::signal(signal, SIG_DFL);
  }
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it died before that was set
}

[[noreturn]] void run_worker(const WorkerProcess::Work& work, int descriptor, pid_t parent) noexcept {
  become_child_of(parent);
  for (std::string request; receive_message(descriptor, request);) {
    if (!send_message(descriptor, work(request))) break;
  }
  // _exit(), that is: no destructors, no buffers, they are the parent's. By its number, because the address
  // sanitizer looks at the stack before what never returns, and finds those that a simulation has switched.
  for (;;) ::syscall(SYS_exit_group, 0);
}

}  // namespace

WorkerProcess::WorkerProcess(const Work& work) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw std::system_error(errno, std::generic_category(), "no connection to a process");
  const pid_t parent = ::getpid();
  process_ = ::fork();
  const int fault = errno;
  if (process_ == 0) {
    ::close(ends[0]);
    run_worker(work, ends[1], parent);
  }
  ::close(ends[1]);
  descriptor_ = ends[0];
  if (process_ > 0) return;
  ::close(descriptor_);
  throw std::system_error(fault, std::generic_category(), "no process");
}

WorkerProcess::~WorkerProcess() { kill(); }

void WorkerProcess::kill() {
  if (process_ <= 0) return;
  ::kill(process_, SIGKILL);
  die();
}

void WorkerProcess::die() {
  ::close(std::exchange(descriptor_, -1));
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  if (WIFSIGNALED(status)) signal_ = WTERMSIG(status);
  if (WIFEXITED(status)) exit_code_ = WEXITSTATUS(status);
  state_ = State::kDied;
}

void WorkerProcess::ask(const std::string& request) {
  if (state_ == State::kDied) return;
  state_ = State::kWorking;
  if (!send_message(descriptor_, request)) die();
}

WorkerProcess::State WorkerProcess::receive(int milliseconds) {
  pollfd readable{descriptor_, POLLIN, 0};
  if (state_ != State::kWorking || ::poll(&readable, 1, milliseconds) <= 0) return state_;
  std::array<char, 65536> buffer;
  const ssize_t count = ::recv(descriptor_, buffer.data(), buffer.size(), 0);
  if (count < 0 && errno == EINTR) return state_;
  if (count <= 0) {
    die();
    return state_;
  }
  received_.append(buffer.data(), count);
  Length length = 0;
  if (received_.size() < sizeof length) return state_;
  std::memcpy(&length, received_.data(), sizeof length);
  received_.reserve(sizeof length + length);
  if (received_.size() == sizeof length + length) state_ = State::kAnswered;
  return state_;
}

std::string WorkerProcess::take_answer() {
  state_ = State::kIdle;
  std::string answer = std::exchange(received_, {});
  answer.erase(0, sizeof(Length));
  return answer;
}

}  // namespace parallax
