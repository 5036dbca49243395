// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <exception>
#include <memory>

#include "tests/bench/benchmarks.hpp"
#include "tests/bench/child_value.hpp"
#include "tests/bench/dated_fifo_chain.hpp"
#include "tests/bench/max_plus_chain.hpp"
#include "tests/bench/sc_fifo_chain.hpp"
#include "tests/bench/stage_chain.hpp"
#ifdef PARALLAX_VERILATED
#include "tests/bench/verilated_chain.hpp"
#endif

namespace parallax::bench {
namespace {

struct Mechanism {
  const char* name;
  ChainRun (*run)(const ChainLoad& load);
  bool exact;  ///< ends at the recurrence's date, which tests/bench/chain_dates_test.cpp holds against the
               ///< reference
};

constexpr Mechanism kMechanisms[] = {
    {"stages", run_stages, true},       {"dated_fifo", run_dated_fifo, true},
    {"max_plus", run_max_plus, true},   {"sc_fifo", run_sc_fifo, false},
#ifdef PARALLAX_VERILATED
    {"verilated", run_verilated, true},
#endif
};

void measure(benchmark::State& state, const Mechanism& mechanism, const ChainLoad& load,
             std::int64_t exact_date) {
  const auto tokens = static_cast<double>(load.tokens());
  for (auto _ : state) {
    ChainRun run;
    try {
      run = child_value([&] { return mechanism.run(load); });
    } catch (const std::exception& e) {
      return state.SkipWithError(e.what());
    }
    if (mechanism.exact && run.last_read != exact_date) {
      return state.SkipWithError(
          fmt::format("the last token is read in cycle {}, not {}", run.last_read, exact_date).c_str());
    }
    state.SetIterationTime(run.seconds);
    state.counters["ns_per_token_and_stage"] = 1e9 * run.seconds / tokens / kStages;
    if (!mechanism.exact) {
      state.counters["date_error_percent"] =
          100.0 * static_cast<double>(run.last_read - exact_date) / static_cast<double>(exact_date);
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(load.tokens()));
}

void register_load(const char* flow, const ChainLoad& load) {
  const std::int64_t exact_date = run_max_plus(load).last_read;
  for (const Mechanism& mechanism : kMechanisms) {
    benchmark::RegisterBenchmark(fmt::format("chain/{}/{}/{}", mechanism.name, flow, load.depth).c_str(),
                                 [&mechanism, load, exact_date](benchmark::State& state) {
                                   measure(state, mechanism, load, exact_date);
                                 })
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1);
  }
}

}  // namespace

void register_chain_benchmarks(const Workload& workload) {
  for (const std::uint32_t depth : {2u, 16u, 64u}) {
    const std::size_t frame = regular_load(depth, 1).source_gaps.size();
    const std::uint64_t frames = (workload.tokens + frame - 1) / frame;
    register_load("regular", regular_load(depth, frames));
    register_load("stalling", stalling_load(depth, frames));
  }
}

}  // namespace parallax::bench
