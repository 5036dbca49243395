// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

namespace parallax::bench {

/// Prints one line a benchmark, the median of its repetitions, and at the end what the benchmarks say about
/// each other.
class Report final : public benchmark::ConsoleReporter {
 public:
  Report() : ConsoleReporter(OO_None) {}

  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

  /// Whether a benchmark could not be measured, or ended at a date that is not the right one.
  bool failed() const { return failed_; }

 private:
  double counter(const std::string& benchmark, const char* name) const;
  void print_chains();
  void print_machines();
  void print_traces();

  std::map<std::string, benchmark::UserCounters> medians_;  // by name of the benchmark
  bool failed_ = false;
};

}  // namespace parallax::bench
