// SPDX-License-Identifier: Apache-2.0
#include "platform/results/replay_metrics.hpp"

#include <algorithm>

#include "tlm/units.hpp"

namespace parallax {

const MetricTable& replay_table() {
  constexpr const char* kTrace = "the whole trace";
  static const MetricTable table{
      {"frac_peak", "",
       "Bytes on the data bus from the time of the first request to the last data beat, as a part of the "
       "peak "
       "bandwidth.",
       kTrace},
      {"bandwidth", "MB/s", "Bytes on the data bus from the time of the first request to the last data beat.",
       kTrace},
      {"peak_bandwidth", "MB/s", "Bandwidth of the data bus without a pause.", kTrace},
      {"rd_lat_avg", "ns",
       "Mean latency of a read of 64 bytes, to its last data beat: from its acceptance when all times in the "
       "trace are 0, "
       "else from its time.",
       kTrace},
      {"rd_lat_max", "ns", "The longest latency of a read.", kTrace},
      {"row_hit_burst", "",
       "Bursts that opened no row: 1 less activates by bursts; at least 0, since a refresh may close a row "
       "before its "
       "burst has come.",
       kTrace},
      {"reads", "requests", "Reads of 64 bytes or the part of one.", kTrace},
      {"writes", "requests", "Writes of 64 bytes or the part of one.", kTrace},
      {"bursts", "bursts", "Read and write commands.", kTrace},
      {"activates", "commands", "Rows opened.", kTrace},
      {"precharges", "commands", "Precharges of one bank or of all.", kTrace},
      {"refreshes", "commands", "Refreshes of all banks.", kTrace},
      {"turn_arounds", "", "Changes between reading and writing on the data bus.", kTrace},
      {"begin", "us", "Time of the first request.", kTrace},
      {"time", "us", "Time until the last data beat is over.", kTrace},
  };
  return table;
}

MetricGroup measure(const ReplayResult& result, const DramTiming& timing) {
  const auto seconds = [&](std::int64_t clocks) {
    return Picoseconds(timing.clock_period_ps).real() * static_cast<double>(clocks) * 1e-12;
  };
  const double rate = quotient(result.bytes, seconds(result.clocks - result.first_clock));
  const DramStatistics& commands = result.commands;
  MetricGroup group;
  const MetricWriter out(group, replay_table());
  out.add("frac_peak", rate / timing.peak_bandwidth());
  out.add("bandwidth", rate / 1e6);
  out.add("peak_bandwidth", timing.peak_bandwidth() / 1e6);
  out.add("rd_lat_avg", quotient(result.latency_sum, result.reads));
  out.add("rd_lat_max", result.latency_largest);
  out.add("row_hit_burst",
          std::max(0.0, 1.0 - quotient(commands.activates, commands.reads + commands.writes)));
  out.add("reads", result.reads);
  out.add("writes", result.writes);
  out.add("bursts", commands.reads + commands.writes);
  out.add("activates", commands.activates);
  out.add("precharges", commands.precharges);
  out.add("refreshes", commands.refreshes);
  out.add("turn_arounds", commands.turn_arounds);
  out.add("begin", seconds(result.first_clock) * 1e6);
  out.add("time", seconds(result.clocks) * 1e6);
  return group;
}

}  // namespace parallax
