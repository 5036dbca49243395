// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/interruption.hpp"

#include <cstddef>

#include "platform/commands/command_context.hpp"
#include "platform/commands/exit_codes.hpp"

namespace parallax {
namespace {

constexpr std::array<int, 2> kSignals{SIGINT, SIGTERM};

// A signal handler reaches nothing but a variable of static storage.
volatile std::sig_atomic_t noted = 0;

void note(int signal) { noted = signal; }

}  // namespace

Interruption::Interruption() {
  noted = 0;
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler == SIG_IGN) continue;
    struct sigaction action {};
    action.sa_handler = note;
    action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
    ::sigemptyset(&action.sa_mask);
    ::sigaction(kSignals[i], &action, nullptr);
  }
}

Interruption::~Interruption() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &before_[i], nullptr);
}

int Interruption::signal() const { return noted; }

int interrupted_after(const std::string& how_far, CommandContext& context, const Interruption& interruption) {
  context.err << "parallax: interrupted after " << how_far << '\n';
  return ended_by(interruption.signal());
}

}  // namespace parallax
