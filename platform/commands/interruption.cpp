// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/interruption.hpp"

#include <unistd.h>

#include <cstddef>

#include "platform/commands/command_context.hpp"
#include "platform/commands/exit_codes.hpp"

namespace parallax {
namespace {

constexpr std::array<int, 2> kSignals{SIGINT, SIGTERM};

// A signal handler reaches nothing but a variable of static storage.
volatile std::sig_atomic_t noted = 0;

// Between two looks at what was noted little time passes, but one of a thousand places may be slow, or wait
// for a disk.
constexpr unsigned kPatience = 10;  // s

void note(int signal) {
  noted = signal;
  ::alarm(kPatience);
}

void give_up(int) {
  constexpr char kLine[] = "parallax: interrupted, and ended where it was\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kLine, sizeof kLine - 1);
  ::_exit(128 + static_cast<int>(noted));
}

void handle(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  ::sigemptyset(&action.sa_mask);
  ::sigaction(signal, &action, nullptr);
}

}  // namespace

Interruption::Interruption() {
  noted = 0;
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler == SIG_IGN) continue;
    handle(kSignals[i], note);
  }
  handle(SIGALRM, give_up);
}

Interruption::~Interruption() {
  ::alarm(0);
  std::signal(SIGALRM, SIG_DFL);
  for (std::size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &before_[i], nullptr);
}

int Interruption::signal() const { return noted; }

int interrupted_after(const std::string& how_far, CommandContext& context, const Interruption& interruption) {
  context.err << "parallax: interrupted after " << how_far << '\n';
  return ended_by(interruption.signal());
}

}  // namespace parallax
