// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <systemc>
#include <vector>

#include "tests/bench/benchmarks.hpp"
#include "tests/bench/report.hpp"

namespace {

// Takes `option` (--name=) with its positive number out of the arguments; false if the number is none.
template <class Number>
bool take(std::vector<char*>& arguments, const char* option, Number& number) {
  for (auto argument = arguments.begin(); argument != arguments.end(); ++argument) {
    const std::size_t length = std::strlen(option);
    if (std::strncmp(*argument, option, length) != 0) continue;
    char* end = nullptr;
    const long long value = std::strtoll(*argument + length, &end, 10);
    if (value < 1 || *end != '\0') {
      std::fprintf(stderr, "bench: '%s' needs a number, 1 or larger\n", *argument);
      return false;
    }
    number = static_cast<Number>(value);
    arguments.erase(argument);
    return true;
  }
  return true;
}

}  // namespace

// libsystemc brings main().
int sc_main(int argc, char** argv) {
  std::vector<char*> arguments(argv, argv + argc);
  parallax::bench::Workload workload;
  if (!take(arguments, "--tokens=", workload.tokens) || !take(arguments, "--frames=", workload.frames))
    return 2;
  // What runs beside the benchmarks disturbs all alike when their repetitions alternate, and medians not at
  // all when it is short. What the user says comes later and wins.
  char repetitions[] = "--benchmark_repetitions=5";
  char interleaved[] = "--benchmark_enable_random_interleaving=true";
  arguments.insert(arguments.begin() + 1, {repetitions, interleaved});
  int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  parallax::bench::register_chain_benchmarks(workload);
  parallax::bench::register_machine_benchmarks(workload);
  parallax::bench::register_trace_benchmarks(workload);
  parallax::bench::Report report;
  const std::size_t found = benchmark::RunSpecifiedBenchmarks(&report);
  return found == 0 || report.failed() ? 1 : 0;
}
