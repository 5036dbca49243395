// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/circuit_watch.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <utility>

namespace parallax {
namespace {

constexpr int kGivenUp = 1;  // exit code

}  // namespace

CircuitWatch::CircuitWatch(const Circuit& circuit, std::string where, std::uint64_t seconds)
    : circuit_(circuit), where_(std::move(where)), seconds_(seconds) {
  // Signals are the other thread's.
  sigset_t all, before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this] { look(); });
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

CircuitWatch::~CircuitWatch() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_over_ = true;
  }
  over_.notify_one();
  thread_.join();
}

// Looks are counted, not the time between them: a process that is stopped does not look either.
void CircuitWatch::look() {
  std::unique_lock<std::mutex> lock(mutex_);
  std::uint64_t before = 0, looks = 0;
  while (!over_.wait_for(lock, std::chrono::seconds(1), [this] { return is_over_; })) {
    const std::uint64_t now = circuit_.calls();
    const bool is_within = now % 2 == 1;
    looks = is_within && now == before ? looks + 1 : 0;
    before = now;
    if (looks >= seconds_) end();
  }
}

void CircuitWatch::end() const {
  const std::int64_t cycle = cycle_.load(std::memory_order_relaxed);
  const std::string line = fmt::format(
      "parallax: error: {} has not come back from {} for {} s, as with an endless loop in an always block; "
      "--circuit-seconds says how long it may take\n",
      where_, cycle < 0 ? "its reset" : fmt::format("cycle {}", cycle), seconds_);
  if (::write(STDERR_FILENO, line.data(), line.size()) < 0) ::_exit(kGivenUp);  // there is nobody to tell
  ::_exit(kGivenUp);
}

}  // namespace parallax
