// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <stdexcept>

#include "platform/machine/steady_state.hpp"
#include "platform/results/peak_memory.hpp"
#include "tests/bench/benchmarks.hpp"
#include "tests/bench/child_value.hpp"
#include "tests/bench/cpu_seconds.hpp"
#include "tests/timing/machine_bench.hpp"

namespace parallax::bench {
namespace {

struct Size {
  const char* name;
  int width, height;
  int iterations;  ///< of 32 disparities
};

constexpr Size kSizes[] = {{"640x480_128", 640, 480, 4}, {"1728x1856_256", 1728, 1856, 8}};
constexpr double kMilli = 1e3;

MachineConfig configuration(const Size& size) {
  return test::preset({fmt::format("matching.iterations={}", size.iterations)});
}

struct MachineRun {
  double encode = 0;           ///< s of processor time: the rectification map
  double construct = 0;        ///< s: the machine, until time starts
  double simulate = 0;         ///< s: all frames
  double start_megabytes = 0;  ///< resident at most until time starts
  double peak_megabytes = 0;   ///< resident at most in the whole run
  std::uint64_t dates = 0;     ///< tokens written and read, on all streams
  double modelled = 0;         ///< s of the machine's own time, until the host has the last frame
};

// A run of the machine without images; with no frames, only what precedes the first.
MachineRun run_machine(const Size& size, std::int64_t frames) {
  MachineRun run;
  const MachineConfig config = configuration(size);
  const EncodedMap map = [&] {
    const RectificationMap lens = test::lens_map(size.width, size.height, config.rectification.range);
    const double began = cpu_seconds();
    EncodedMap encoded = encode(lens);
    run.encode = cpu_seconds() - began;
    return encoded;
  }();
  MachineInput input;
  input.width = size.width;
  input.height = size.height;
  input.map = &map;
  input.frames = std::max<std::int64_t>(frames, 1);
  input.expose = [](std::int64_t) { return StereoFrame{}; };
  const double began = cpu_seconds();
  const Machine machine("machine", config, input);
  const double constructed = cpu_seconds();
  run.construct = constructed - began;
  run.start_megabytes = peak_memory_megabytes();
  if (frames == 0) return run;
  sc_core::sc_start();
  run.simulate = cpu_seconds() - constructed;
  run.peak_megabytes = peak_memory_megabytes();
  if (!machine.finished()) throw std::runtime_error("the machine got stuck");
  for (const StreamBase* stream : machine.dataflow().streams()) {
    run.dates += stream->statistics().written + stream->statistics().read;
  }
  run.modelled = machine.snapshots().back().time.to_seconds();
  return run;
}

void measure_start_up(benchmark::State& state, const Size& size) {
  for (auto _ : state) {
    try {
      const MachineRun run = child_value([&] { return run_machine(size, 0); });
      state.SetIterationTime(run.encode + run.construct);
      state.counters["encode_ms"] = run.encode * kMilli;
      state.counters["construct_ms"] = run.construct * kMilli;
      state.counters["peak_MB"] = run.start_megabytes;
    } catch (const std::exception& e) {
      return state.SkipWithError(e.what());
    }
  }
}

// The frames after the warm-up: what a run with them takes more than one without.
void measure_steady(benchmark::State& state, const Size& size, std::int64_t frames) {
  const std::int64_t warm_up = warm_up_frames(configuration(size));
  for (auto _ : state) {
    try {
      const MachineRun shorter = child_value([&] { return run_machine(size, warm_up); });
      const MachineRun longer = child_value([&] { return run_machine(size, warm_up + frames); });
      const double seconds = longer.simulate - shorter.simulate;
      const auto count = static_cast<double>(frames);
      state.SetIterationTime(seconds / count);
      state.counters["modelled_ms"] = (longer.modelled - shorter.modelled) / count * kMilli;
      state.counters["dates_per_second"] = static_cast<double>(longer.dates - shorter.dates) / seconds;
      state.counters["start_MB"] = longer.start_megabytes;
      state.counters["peak_MB"] = longer.peak_megabytes;
    } catch (const std::exception& e) {
      return state.SkipWithError(e.what());
    }
  }
}

template <class Measure>
void add(const char* what, const Size& size, const Measure& measure) {
  benchmark::RegisterBenchmark(fmt::format("machine/{}/{}", what, size.name).c_str(), measure)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond)
      ->Iterations(1);
}

}  // namespace

void register_machine_benchmarks(const Workload& workload) {
  for (const Size& size : kSizes) {
    add("start_up", size, [&size](benchmark::State& state) { measure_start_up(state, size); });
    add("steady", size,
        [&size, frames = workload.frames](benchmark::State& state) { measure_steady(state, size, frames); });
  }
}

}  // namespace parallax::bench
