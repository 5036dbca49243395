// SPDX-License-Identifier: Apache-2.0
// When a machine hangs.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "platform/machine/machine.hpp"
#include "platform/machine/simulated_time.hpp"
#include "platform/machine/stuck.hpp"

namespace parallax {
namespace {

constexpr std::uint64_t kPatience = 1'000'000;  // cycles of the core's clock
constexpr double kFrames = 4;                   // of the slowest part

}  // namespace

Watchdog::Watched Machine::watched() {
  Watchdog::Watched all;
  all.over = [this] { return finished(); };
  // Cameras bring the next frame, or an initiator has switched the core off, and software tries again.
  all.waits = [this] {
    const bool retries = std::exchange(rejected_starts_, rejected_starts()) != rejected_starts();
    return acquisition_.frame_due() || retries;
  };
  all.moved = [this] {
    dataflow_.bring_up_to_date();
    sc_core::sc_time latest;
    for (const StreamBase* stream : dataflow_.streams()) {
      const Cycles written = std::max(stream->last_written(), Cycles(0));
      const Cycles read = std::max(stream->last_read(), Cycles(0));
      latest =
          std::max({latest, stream->writer_clock().time_of(written), stream->reader_clock().time_of(read)});
    }
    return latest;
  };
  all.report = [this](const sc_core::sc_time& since) {
    const std::string circle = describe(dataflow_.deadlock());
    const Cycles stood = core_clock_.cycle_at_or_after(sc_core::sc_time_stamp() - since) - Cycles(1);
    return fmt::format(
        "{}: the machine hangs: nothing has moved since cycle {} of the core's clock, for more "
        "than {} cycles (MachineInput::hang_cycles)\n{}",
        name(), core_clock_.cycle_at_or_after(since).count(), stood.count(),
        circle.empty() ? describe_ends(*this) : "  nobody in this circle can go on:\n" + circle);
  };
  return all;
}

void Machine::start_watchdog() {
  const bool others = memory_ == nullptr || pipeline().has_kernel_time_blocks();
  if (!input_.hang_cycles && !others) return;
  if (input_.hang_cycles == 0u) return;
  if (input_.hang_cycles) {
    watchdog_.start(core_clock_.time_of(Cycles(static_cast<std::int64_t>(*input_.hang_cycles))));
    return;
  }
  const double frame = shortest_frame_time(*this) + static_cast<double>(config_.software.response_ns) * 1e-9;
  watchdog_.start(std::max(core_clock_.time_of(Cycles(static_cast<std::int64_t>(kPatience))),
                           sc_core::sc_time(std::min(kFrames * frame, kLongestFrame), sc_core::SC_SEC)));
}

}  // namespace parallax
