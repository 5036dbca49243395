// SPDX-License-Identifier: Apache-2.0
// A trace of a run that leaps over periodic motion is that of one that goes firing by firing; and so is each
// part of it.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/timing/in_child.hpp"
#include "tests/timing/pipeline_simulation.hpp"
#include "tests/timing/random_pipeline.hpp"
#include "traces/csv_trace.hpp"
#include "traces/date_order.hpp"
#include "traces/recorder.hpp"

namespace parallax::test {
namespace trace_leap_test {

// Rows of all stages, and with `tokens` firings and tokens, a table after the other. What the rows of a
// stream are is made up.
std::string trace(const PipelineCase& c, std::uint64_t leap_interval, const TraceWindow& window,
                  bool tokens) {
  return in_child([&] {
    PipelineSimulation simulation(c, leap_interval);
    auto& dataflow = const_cast<Dataflow&>(simulation.dataflow());
    const auto rows = std::make_shared<const RowEnds>(equal_rows(7, 5, 2));
    RecorderConfig config;
    config.window = window;
    config.tokens = tokens;
    config.period = sc_core::sc_time(777, sc_core::SC_NS);
    SamplingTimer timer("sampling_timer");
    std::unique_ptr<Recorder> recorder;
    recorder = std::make_unique<Recorder>("recorder", config, dataflow, timer, [&] {
      for (StreamBase* stream : dataflow.streams()) recorder->add(*stream, rows);
      for (Stage* stage : dataflow.stages()) {
        StagePorts ports;
        if (!tokens && !stage->input_streams(0).empty()) ports.read = {0, rows};
        recorder->add(*stage, ports);
      }
    });
    std::map<std::string, std::string> tables;
    DateOrder order(std::make_unique<CsvTrace>([&](const std::string& table) -> ByteSink {
      return [&text = tables[table]](std::string_view bytes) { text += bytes; };
    }));
    recorder->add(order);
    simulation.run();
    recorder->finish();
    return tables.at("rows") + (tokens ? tables.at("firings") + tables.at("tokens") : "");
  });
}

std::string first_difference(const std::string& expected, const std::string& actual) {
  std::istringstream a(expected), b(actual);
  std::string x, y;
  while (std::getline(a, x)) {
    if (!std::getline(b, y) || x != y) return "expected " + x + "\nhave     " + y + "\n";
  }
  return std::getline(b, y) ? "have more: " + y + "\n" : "";
}

RC_GTEST_PROP(TraceLeap, ChangesNothing, ()) {
  const PipelineCase c = random_pipeline(Depths::kAutomatic, 2, 2);
  TraceWindow window;
  if (*rc::gen::arbitrary<bool>()) {
    const auto bound = [](std::int64_t from, std::int64_t to) {
      TraceBound at;
      if (*rc::gen::arbitrary<bool>()) {
        at.time = Picoseconds(1000 * *rc::gen::inRange(20 * from, 20 * to));
      } else {
        at.frame = *rc::gen::inRange(from, to);
      }
      return at;
    };
    window.from = bound(0, 300);
    window.to = bound(300, 1000);
  }
  const bool tokens = *rc::gen::arbitrary<bool>();
  const std::string expected = trace(c, 0, window, tokens);
  RC_TAG(expected.size() > 1000 ? "large" : "small");
  RC_ASSERT(expected.rfind("stage,", 0) == 0u);
  const std::string difference =
      first_difference(expected, trace(c, *rc::gen::element<std::uint64_t>(50, 200), window, tokens));
  if (!difference.empty()) RC_FAIL(difference);
}

}  // namespace trace_leap_test
}  // namespace parallax::test
