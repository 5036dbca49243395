// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <ostream>

namespace parallax::bench {
namespace {

constexpr char kMilliseconds[] = "ms";
constexpr double kMillion = 1e6;

// A cell of a table; a dash where nothing was measured.
std::string cell(double value, const char* format) {
  return std::isnan(value) ? " - |" : fmt::format(fmt::runtime(format), value);
}

}  // namespace

void Report::ReportRuns(const std::vector<Run>& runs) {
  std::vector<Run> shown;
  for (const Run& run : runs) {
    failed_ = failed_ || run.error_occurred;
    // Without repetitions there is no median, only the run itself.
    const bool alone = run.run_type == Run::RT_Iteration && run.repetitions == 1;
    if (!alone && !run.error_occurred && run.aggregate_name != "median") continue;
    shown.push_back(run);
    if (run.error_occurred) continue;
    benchmark::UserCounters& counters = medians_[run.run_name.function_name];
    counters = run.counters;
    counters[kMilliseconds] = run.GetAdjustedRealTime();
  }
  if (!shown.empty()) ConsoleReporter::ReportRuns(shown);
}

double Report::counter(const std::string& benchmark, const char* name) const {
  const auto found = medians_.find(benchmark);
  if (found == medians_.end()) return std::numeric_limits<double>::quiet_NaN();
  const auto value = found->second.find(name);
  return value == found->second.end() ? std::numeric_limits<double>::quiet_NaN() : value->second.value;
}

void Report::Finalize() {
  ConsoleReporter::Finalize();
  print_chains();
  print_machines();
  print_traces();
}

void Report::print_chains() {
  std::string rows;
  for (const char* flow : {"regular", "stalling"}) {
    for (const int depth : {2, 16, 64}) {
      const auto value = [&](const char* mechanism, const char* name) {
        return counter(fmt::format("chain/{}/{}/{}", mechanism, flow, depth), name);
      };
      std::string rates;
      bool measured = false;
      for (const char* mechanism : {"stages", "dated_fifo", "max_plus", "verilated", "sc_fifo"}) {
        const double rate = value(mechanism, "items_per_second") / kMillion;
        measured = measured || !std::isnan(rate);
        rates += cell(rate, " {:.2f} |");
      }
      if (!measured) continue;
      const auto ratio = [&](const char* other) {
        return value("stages", "items_per_second") / value(other, "items_per_second");
      };
      rows += fmt::format("| {} | {} |{}{}{}{}{}\n", flow, depth, rates,
                          cell(value("stages", "ns_per_token_and_stage"), " {:.2f} |"),
                          cell(ratio("verilated"), " {:.1f} |"), cell(ratio("sc_fifo"), " {:.1f} |"),
                          cell(value("sc_fifo", "date_error_percent"), " {:+.3f} % |"));
    }
  }
  if (rows.empty()) return;
  GetOutputStream() << "\nMillion tokens a second through 8 stages\n\n"
                       "| flow | depth | stages | dated FIFO cells | recurrence | Verilated RTL | sc_fifo "
                       "| stages: ns per token and stage | stages : Verilated | stages : sc_fifo "
                       "| date error of sc_fifo |\n"
                       "|---|---|---|---|---|---|---|---|---|---|---|\n"
                    << rows;
}

void Report::print_machines() {
  std::string rows;
  for (const char* size : {"640x480_128", "1728x1856_256"}) {
    const std::string steady = fmt::format("machine/steady/{}", size);
    const std::string start_up = fmt::format("machine/start_up/{}", size);
    const double ms = counter(steady, kMilliseconds);
    if (std::isnan(ms)) continue;
    rows += fmt::format("| {} |{}{}{}{}{}{}\n", size, cell(ms, " {:.2f} |"),
                        cell(counter(steady, "modelled_ms"), " {:.2f} |"),
                        cell(counter(steady, "dates_per_second") / kMillion, " {:.1f} |"),
                        cell(counter(start_up, "encode_ms"), " {:.1f} |"),
                        cell(counter(start_up, "construct_ms"), " {:.2f} |"),
                        cell(counter(steady, "peak_MB"), " {:.0f} |"));
  }
  if (rows.empty()) return;
  GetOutputStream() << "\nThe whole machine, timing only\n\n"
                       "| size, disparities | ms per frame | machine's own ms | million dates a second "
                       "| start-up: encode the map, ms | construct, ms | peak memory, MB |\n"
                       "|---|---|---|---|---|---|---|\n"
                    << rows;
}

void Report::print_traces() {
  std::string rows;
  for (const char* level : {"rows", "tokens"}) {
    for (const char* format : {"csv", "json", "vcd", "perfetto"}) {
      const auto value = [&](const char* name) {
        return counter(fmt::format("trace/{}/{}", level, format), name);
      };
      if (std::isnan(value("ns_per_event"))) continue;
      rows += fmt::format("| {} | {} |{}{}{}{}\n", level, format, cell(value("million_events"), " {:.2f} |"),
                          cell(value("ns_per_event"), " {:.0f} |"), cell(value("peak_MB"), " {:.0f} |"),
                          cell(value("MB_without"), " {:.0f} |"));
    }
  }
  if (rows.empty()) return;
  GetOutputStream()
      << "\nTraces of a run with 640x480 pixels and 128 disparities\n\n"
         "| level | format | million events | ns per event | peak memory, MB | without a trace, MB |\n"
         "|---|---|---|---|---|---|\n"
      << rows;
}

}  // namespace parallax::bench
