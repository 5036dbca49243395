// SPDX-License-Identifier: Apache-2.0
#include "platform/results/replay_metrics.hpp"

namespace parallax {

const MetricTable& replay_table() {
  constexpr const char* kTrace = "the whole trace";
  static const MetricTable table{
      {"frac_peak", "",
       "Bytes on the data bus by the time of the last data beat, as a part of the peak bandwidth.", kTrace},
      {"bandwidth", "MB/s", "Bytes on the data bus by the time of the last data beat.", kTrace},
      {"peak_bandwidth", "MB/s", "Bandwidth of the data bus without a pause.", kTrace},
      {"rd_lat_avg", "ns",
       "Mean latency of a read of 64 bytes, to its last data beat: from its acceptance when all times in the "
       "trace are 0, "
       "else from its time.",
       kTrace},
      {"rd_lat_max", "ns", "The longest latency of a read.", kTrace},
      {"row_hit_burst", "", "Bursts that opened no row: 1 less activates by bursts.", kTrace},
      {"reads", "requests", "Reads of 64 bytes or the part of one.", kTrace},
      {"writes", "requests", "Writes of 64 bytes or the part of one.", kTrace},
      {"bursts", "bursts", "Read and write commands.", kTrace},
      {"activates", "commands", "Rows opened.", kTrace},
      {"precharges", "commands", "Precharges of one bank or of all.", kTrace},
      {"refreshes", "commands", "Refreshes of all banks.", kTrace},
      {"turn_arounds", "", "Changes between reading and writing on the data bus.", kTrace},
      {"time", "us", "Time until the last data beat is over.", kTrace},
  };
  return table;
}

MetricGroup measure(const ReplayResult& result, const DramTiming& timing) {
  const double seconds =
      static_cast<double>(result.clocks) * static_cast<double>(timing.clock_period_ps) * 1e-12;
  const double rate = static_cast<double>(result.bytes) / seconds;
  const DramStatistics& commands = result.commands;
  const auto count = [](std::uint64_t value) { return static_cast<std::int64_t>(value); };
  MetricGroup group;
  const MetricWriter out(group, replay_table());
  out.add("frac_peak", rate / timing.peak_bandwidth());
  out.add("bandwidth", rate / 1e6);
  out.add("peak_bandwidth", timing.peak_bandwidth() / 1e6);
  out.add("rd_lat_avg", result.reads == 0 ? 0.0 : result.latency_sum / static_cast<double>(result.reads));
  out.add("rd_lat_max", result.latency_largest);
  out.add("row_hit_burst", 1.0 - static_cast<double>(commands.activates) /
                                     static_cast<double>(commands.reads + commands.writes));
  out.add("reads", count(result.reads));
  out.add("writes", count(result.writes));
  out.add("bursts", count(commands.reads + commands.writes));
  out.add("activates", count(commands.activates));
  out.add("precharges", count(commands.precharges));
  out.add("refreshes", count(commands.refreshes));
  out.add("turn_arounds", count(commands.turn_arounds));
  out.add("time", seconds * 1e6);
  return group;
}

}  // namespace parallax
