// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "platform/results/peak_memory.hpp"
#include "platform/tracing/tracing.hpp"
#include "tests/bench/benchmarks.hpp"
#include "tests/bench/child_value.hpp"
#include "tests/bench/cpu_seconds.hpp"
#include "tests/platform/temporary_folder.hpp"
#include "tests/timing/machine_bench.hpp"

namespace parallax::bench {
namespace {

// What is traced of a machine of 640 x 480 pixels and 128 disparities.
struct Trace {
  const char* level;
  std::int64_t frames;  ///< of the run, for each frame of the workload
  const char* from;
  const char* to;
};

constexpr Trace kTraces[] = {{"rows", 25, "", ""}, {"tokens", 1, "1:0", "1:199"}};
constexpr const char* kFormats[] = {"csv", "json", "vcd", "perfetto"};

struct TracedRun {
  double seconds = 0;        ///< until the trace is complete
  double cpu_seconds = 0;    ///< of all threads
  double megabytes = 0;      ///< resident at most
  std::uint64_t events = 0;  ///< lines of CSV tables
};

std::uint64_t lines_in(const std::filesystem::path& folder) {
  std::uint64_t lines = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream file(entry.path());
    lines += static_cast<std::uint64_t>(std::count(std::istreambuf_iterator<char>(file), {}, '\n')) - 1;
  }
  return lines;
}

// `format`: empty for no trace.
TracedRun run_traced(const Trace& trace, std::int64_t frames, const std::string& format) {
  const MachineConfig config = test::preset();
  const EncodedMap map = encode(test::lens_map(640, 480, config.rectification.range));
  const TemporaryFolder temporary;
  TracedRun run;
  {
    OutputFolder folder(temporary.path());
    std::unique_ptr<Tracing> tracing;
    MachineInput input;
    input.width = 640;
    input.height = 480;
    input.map = &map;
    input.frames = frames;
    input.timing_only = true;
    input.step = [&](std::int64_t frame, FrameStep step) {
      if (tracing) tracing->frame_step(frame, step);
    };
    input.deliver = [&](const FrameResult& result) {
      if (tracing) tracing->delivered(result.index);
    };
    const Machine machine("machine", config, input);
    SamplingTimer timer("sampling_timer");
    if (!format.empty()) {
      TraceOptions options;
      options.formats = format;
      options.level = trace.level;
      options.from = trace.from;
      options.to = trace.to;
      tracing = std::make_unique<Tracing>(read_trace_options(options), machine, timer, folder);
    }
    using Clock = std::chrono::steady_clock;
    const Clock::time_point began = Clock::now();
    const double cpu_began = cpu_seconds();
    sc_core::sc_start();
    if (tracing) tracing->finish();
    run.seconds = std::chrono::duration<double>(Clock::now() - began).count();
    run.cpu_seconds = cpu_seconds() - cpu_began;
    run.megabytes = peak_memory_megabytes();
    if (!machine.finished()) throw std::runtime_error("the machine got stuck");
    folder.publish();
  }
  if (format == "csv") run.events = lines_in(temporary.path());
  return run;
}

// The lines that a trace has, which are the same in every run.
std::uint64_t events_of(const Trace& trace, std::int64_t frames) {
  static std::map<std::pair<std::string, std::int64_t>, std::uint64_t> known;
  std::uint64_t& events = known[{trace.level, frames}];
  if (events == 0) events = child_value([&] { return run_traced(trace, frames, "csv"); }).events;
  return events;
}

// What is looked for is the small difference of two runs, and other work on the machine only ever adds to
// one: so the shorter of a few counts, of runs with and without a trace in turn.
void measure(benchmark::State& state, const Trace& trace, std::int64_t frames, const std::string& format) {
  constexpr int kPairs = 3;
  for (auto _ : state) {
    try {
      const std::uint64_t events = events_of(trace, frames);
      TracedRun without, with;
      for (int i = 0; i < kPairs; ++i) {
        const auto run = [&](TracedRun& best, const std::string& traced) {
          const TracedRun one = child_value([&] { return run_traced(trace, frames, traced); });
          if (i == 0 || one.seconds < best.seconds) best = one;
        };
        run(without, "");
        run(with, format);
      }
      const double seconds = with.seconds - without.seconds;
      state.SetIterationTime(std::max(seconds, 1e-9));
      state.counters["million_events"] = static_cast<double>(events) * 1e-6;
      state.counters["ns_per_event"] = seconds * 1e9 / static_cast<double>(events);
      state.counters["cpu_ns_per_event"] =
          (with.cpu_seconds - without.cpu_seconds) * 1e9 / static_cast<double>(events);
      state.counters["peak_MB"] = with.megabytes;
      state.counters["MB_without"] = without.megabytes;
    } catch (const std::exception& e) {
      return state.SkipWithError(e.what());
    }
  }
}

}  // namespace

void register_trace_benchmarks(const Workload& workload) {
  for (const Trace& trace : kTraces) {
    for (const char* format : kFormats) {
      benchmark::RegisterBenchmark(fmt::format("trace/{}/{}", trace.level, format).c_str(),
                                   [&trace, format, frames = trace.frames * workload.frames](
                                       benchmark::State& state) { measure(state, trace, frames, format); })
          ->UseManualTime()
          ->Unit(benchmark::kMillisecond)
          ->Iterations(1);
    }
  }
}

}  // namespace parallax::bench
