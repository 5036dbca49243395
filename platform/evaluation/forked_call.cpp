// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/forked_call.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

#include "platform/evaluation/forked_child.hpp"

namespace parallax {
namespace {

constexpr int kPollMilliseconds = 100;

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int get() const { return descriptor_; }
  void close() {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
  }

 private:
  int descriptor_;
};

// The child, from the moment it exists.
[[noreturn]] void run_child(const std::function<std::string()>& function, int out, pid_t parent) noexcept {
  become_child_of(parent);
  const std::string text = function();
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t count = ::write(out, text.data() + sent, text.size() - sent);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) ::_exit(1);
    sent += static_cast<std::size_t>(count);
  }
  // _exit(), that is: no destructors, no buffers, they are the parent's. By its number, because the address
  // sanitizer looks at the stack before what never returns, and finds those that a simulation has switched.
  for (;;) ::syscall(SYS_exit_group, 0);
}

}  // namespace

ForkedCall call_in_fork(const std::function<std::string()>& function,
                        const std::function<bool()>& interrupted) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail("no pipe");
  Descriptor in(ends[0]);
  Descriptor out(ends[1]);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) fail("no process");
  if (child == 0) {
    in.close();
    run_child(function, out.get(), parent);
  }
  out.close();

  ForkedCall call;
  for (;;) {
    if (!call.interrupted && interrupted()) {
      call.interrupted = true;
      ::kill(child, SIGKILL);
    }
    pollfd readable{in.get(), POLLIN, 0};
    if (::poll(&readable, 1, kPollMilliseconds) <= 0) continue;
    std::array<char, 65536> buffer;
    const ssize_t count = ::read(in.get(), buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    call.output.append(buffer.data(), static_cast<std::size_t>(count));
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) call.signal = WTERMSIG(status);
  // A signal from the terminal reaches both: this process has noted it, the child has ended.
  if (call.signal != 0 && !call.interrupted) call.interrupted = interrupted();
  return call;
}

}  // namespace parallax
