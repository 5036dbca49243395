// SPDX-License-Identifier: Apache-2.0
// A circuit at pins between two streams, with threads at their other ends.
#pragma once

#include <cstdint>
#include <random>
#include <systemc>
#include <utility>
#include <vector>

#include "tests/timing/date_log.hpp"
#include "tests/tlm/thread.hpp"
#include "tlm/pin_sink.hpp"
#include "tlm/pin_source.hpp"

namespace parallax::test {

using Dates = std::vector<std::int64_t>;

/// When tokens 0, 1, ... are written into the stream before the circuit, and when those behind it are wanted.
struct PinTimes {
  Dates written;
  Dates wanted;
};

/// Gaps of up to `gap` cycles on both sides, now and then of more.
inline PinTimes drawn_times(std::size_t tokens, std::uint64_t seed, std::uint64_t gap = 3) {
  std::mt19937_64 random(seed);
  PinTimes times;
  for (Dates* dates : {&times.written, &times.wanted}) {
    std::int64_t cycle = 0;
    for (std::size_t i = 0; i < tokens; ++i) {
      cycle += static_cast<std::int64_t>(1 + random() % gap + (random() % 16 == 0 ? random() % 20 : 0));
      dates->push_back(cycle);
    }
  }
  return times;
}

/// Stream `in` has room for all tokens, so that the dates of writing are the given ones.
template <class In, class Out>
struct PinBench {
  PinBench(const std::vector<In>& tokens, PinTimes given, std::uint32_t out_depth = 2,
           std::uint32_t out_write_to_read = 1)
      : clock("clock", Hertz(100'000'000)),
        dataflow("dataflow"),
        in("in", dataflow, clock, clock, fifo(static_cast<std::uint32_t>(tokens.size()))),
        out("out", dataflow, clock, clock, {out_depth, Bits(8), out_write_to_read}),
        times(std::move(given)),
        in_log(in_dates),
        out_log(out_dates),
        writing("writing",
                [this] {
                  for (const std::int64_t cycle : times.written) {
                    clock.wait_until(Cycles(cycle));
                    in.wait_writable();
                    in.commit();
                  }
                }),
        reading("reading", [this] {
          for (const std::int64_t cycle : times.wanted) {
            clock.wait_until(Cycles(cycle));
            values.push_back(out.read());
          }
        }) {
    in.send_row(tokens.data(), tokens.size());
    in.add_listener(in_log);
    out.add_listener(out_log);
  }
  static FifoConfig fifo(std::uint32_t depth) { return {depth, Bits(8)}; }
  void run(std::int64_t cycles = 5000) { sc_core::sc_start(clock.time_of(Cycles(cycles))); }

  ClockDomain clock;
  Dataflow dataflow;
  Stream<In> in;
  Stream<Out> out;
  PinTimes times;
  EdgeDates in_dates, out_dates;
  DateLog in_log, out_log;
  std::vector<Out> values;  ///< that have been read behind the circuit
  Thread writing, reading;
};

}  // namespace parallax::test
