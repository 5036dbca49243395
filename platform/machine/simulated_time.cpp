// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/simulated_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "modules/output_packing.hpp"
#include "platform/machine/machine.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr double kSecondsPerDay = 86400;

double checked(const std::string& part, const std::string& keys, double seconds) {
  if (seconds <= kLongestFrame) return seconds;
  throw UserError(
      fmt::format("{} would take {:.6g} days for a frame, {:.1f} are the most that simulated time holds ({})",
                  part, seconds / kSecondsPerDay, kLongestFrame / kSecondsPerDay, keys));
}

}  // namespace

double shortest_frame_time(const Machine& machine) {
  const MachineConfig& config = machine.config();
  double longest = 0;
  for (const StageInfo& info : machine.pipeline().stages()) {
    const double cycles = static_cast<double>(info.cycles_per_frame());
    longest = std::max(longest, checked(info.stage->basename(), "clocks.core_hz",
                                        cycles / static_cast<double>(config.clocks.core_hz)));
  }
  longest = std::max(
      longest,
      checked("camera",
              "clocks.camera_hz, camera.row_blanking, camera.frame_blanking, camera.bytes_per_second",
              machine.sensor().frame_time().real() / static_cast<double>(config.clocks.camera_hz)));
  if (!config.link.enabled) return longest;
  const double bytes =
      static_cast<double>(OutputPacking::row_bytes(machine.input().width, config.link.output_left())) *
      machine.input().height;
  const double wire = bytes / static_cast<double>(config.link.packet_payload_bytes) *
                      static_cast<double>(config.link.packet_wire_bytes) * 8.0 /
                      static_cast<double>(config.link.line_rate);
  longest = std::max(longest, checked("link", "link.line_rate, link.packet_payload_bytes", wire));
  if (config.link.host_pixel_rate == 0) return longest;
  const double pixels = static_cast<double>(machine.input().width) * machine.input().height;
  return std::max(longest, checked("host", "link.host_pixel_rate",
                                   pixels / static_cast<double>(config.link.host_pixel_rate)));
}

void simulate_for(const sc_core::sc_time& piece) {
  // The kernel does not move to an event beyond the end of what it was asked for.
  const sc_core::sc_time next =
      sc_core::sc_pending_activity() ? sc_core::sc_time_to_pending_activity() : sc_core::SC_ZERO_TIME;
  if ((sc_core::sc_time_stamp() + next).to_seconds() > kLastSecond) {
    throw UserError(
        fmt::format("after {:.1f} days simulated time is over, {:.1f} is the most that it holds; simulate "
                    "fewer frames (--frames, --timing-frames), "
                    "or make the machine faster (clocks.*)",
                    sc_core::sc_time_stamp().to_seconds() / kSecondsPerDay, kLastSecond / kSecondsPerDay));
  }
  sc_core::sc_start(std::max(piece, next), sc_core::SC_EXIT_ON_STARVATION);
}

}  // namespace parallax
