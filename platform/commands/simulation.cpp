// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/simulation.hpp"

#include <chrono>
#include <systemc>
#include <utility>

#include "platform/machine/simulated_time.hpp"

namespace parallax {

void Simulation::stop() {
  if (!std::exchange(stopped_, true)) sc_core::sc_stop();
}

// In pieces of simulated time that take this computer some hundredths of a second.
void Simulation::run(const std::function<void(double seconds)>& reached) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kShort(10), kLong(100);
  const sc_core::sc_time most(1000, sc_core::SC_SEC), least(1, sc_core::SC_US);
  sc_core::sc_time piece(1, sc_core::SC_MS);
  // A short piece in which nothing happens is no news.
  sc_core::sc_report_handler::set_actions(sc_core::SC_ID_NO_SC_START_ACTIVITY_, sc_core::SC_DO_NOTHING);
  do {
    const Clock::time_point began = Clock::now();
    simulate_for(piece);
    const Clock::duration took = Clock::now() - began;
    if (took < kShort && piece < most) piece = piece * 2;
    if (took > kLong && piece > least) piece = piece / 2;
    if (sc_core::sc_get_status() == sc_core::SC_STOPPED) break;
    reached(sc_core::sc_time_stamp().to_seconds());
    if (interrupted_()) stop();
  } while (!stopped_ && sc_core::sc_pending_activity());
  if (failure_) std::rethrow_exception(failure_);
}

}  // namespace parallax
