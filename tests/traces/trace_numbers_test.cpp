// SPDX-License-Identifier: Apache-2.0
// The numbers of timing.json are those that SQL finds in the trace: to the cycle, the byte and the
// picosecond.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <ostream>

#include "tests/traces/database.hpp"

namespace parallax::test {
namespace trace_numbers_test {

struct Case {
  const char* name;
  const char* options;

  friend void PrintTo(const Case& run, std::ostream* out) { *out << run.options; }
};

// A run with a trace, its tables, and what timing.json says.
class TraceNumbers : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override { SKIP_WITHOUT("sqlite3", "sqlite3"); }

  Database run(const std::string& level) {
    const Outcome outcome =
        program_(std::string("run --timing-only --disparities 32 --out out -q --trace csv ") +
                 GetParam().options + level);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    timing_ = nlohmann::json::parse(program_.read("out/timing.json"));
    const std::string window = timing_.at("performance").at("frame_rate").at("window");
    EXPECT_EQ(std::sscanf(window.c_str(), "frames %d to %d", &first_, &last_), 2) << window;
    return Database(program_ / "out");
  }
  template <class Value = std::int64_t>
  Value metric(const nlohmann::json& group, const std::string& name) const {
    return group.at(name).at("value").get<Value>();
  }
  /// A stage's cycles for the window's frames are those from its first firing for the one before on.
  void expect_stages(const Database& trace) const {
    const char* const kParts[] = {"busy", "starved", "blocked", "memory", "synchroniser", "blanking"};
    std::string sums;
    for (const char* part : kParts) sums += fmt::format(",sum({}+0)", part);
    const auto rows =
        trace.query(fmt::format("select stage{} from rows where frame+0 between {} and {} group by stage",
                                sums, first_ - 1, last_ - 1));
    EXPECT_EQ(rows.size(), timing_.at("stages").size());
    for (const auto& [stage, group] : timing_.at("stages").items()) {
      std::string expected = stage;
      for (const char* part : kParts) expected += fmt::format("|{}", metric(group, part));
      EXPECT_NE(std::find(rows.begin(), rows.end(), expected), rows.end()) << expected;
    }
  }
  void expect_frames(const Database& trace) const {
    EXPECT_EQ(trace.number("select count(*) from frames"), metric(timing_.at("input"), "frames"));
    const double period =
        static_cast<double>(trace.number(fmt::format("select max(at_host_ps+0)-min(at_host_ps+0) from frames "
                                                     "where frame+0 between {} and {}",
                                                     first_ - 1, last_))) /
        (last_ - first_ + 1);
    EXPECT_NEAR(metric<double>(timing_.at("performance"), "frame_rate") * period, 1e12, 1e-3);
    for (const auto& [span, from, to] : {std::tuple{"first_pixel", "startable", "first_disparity"},
                                         {"last_pixel", "startable", "last_disparity"},
                                         {"first_byte_to_host", "first_byte", "at_host"},
                                         {"exposure_to_host", "exposed", "at_host"},
                                         {"exposure_to_last_pixel", "exposed", "last_disparity"}}) {
      const nlohmann::json& latency = timing_.at("latency");
      const auto ps = [&](const std::string& of) {
        return std::llround(metric<double>(latency, fmt::format("{}_{}", span, of)) * 1e9);
      };
      int first = 0, last = 0;
      const std::string frames = latency.at(fmt::format("{}_mean", span)).at("window");
      EXPECT_EQ(std::sscanf(frames.c_str(), "frames %d to %d", &first, &last), 2) << frames;
      const std::string steady = fmt::format("from frames where frame+0 between {} and {}", first, last);
      EXPECT_EQ(ps("first_frame"),
                trace.number(fmt::format("select {}_ps-{}_ps from frames where frame='1'", to, from)));
      EXPECT_EQ(ps("largest"), trace.number(fmt::format("select max({}_ps-{}_ps) {}", to, from, steady)));
      EXPECT_NEAR(static_cast<double>(ps("mean")),
                  static_cast<double>(
                      trace.number(fmt::format("select sum({}_ps-{}_ps)/count(*) {}", to, from, steady))),
                  1);
    }
  }
  /// Rows' bytes and what a frame moves, of each port.
  void expect_port_rows(const Database& trace) const {
    for (const std::string& line : trace.query(
             "select port,count(distinct total),max(total) from (select port,sum(bytes+0) total from ports "
             "where frame+0<=(select max(frame+0) from frames) group by port,frame) group by port")) {
      const std::string port = line.substr(0, line.find('|'));
      const double bytes = metric<double>(timing_.at("memory").at(port), "bytes_per_frame");
      EXPECT_EQ(line, fmt::format("{}|1|{}", port, std::llround(bytes))) << "when a frame is like the other";
    }
  }
  /// How full FIFOs were, over the whole run.
  void expect_occupancies(const Database& trace) const {
    const auto rows = trace.query(
        "select "
        "stream,sum(written+0),sum(cycles+0),sum(token_cycles+0),sum(full_cycles+0),sum(empty_cycles+0),"
        "max(level+0) from fifos group by stream");
    EXPECT_EQ(rows.size(), timing_.at("streams").size());
    for (const std::string& row : rows) {
      char name[64];
      long long written = 0, cycles = 0, held = 0, full = 0, empty = 0, level = 0;
      ASSERT_EQ(std::sscanf(row.c_str(), "%63[^|]|%lld|%lld|%lld|%lld|%lld|%lld", name, &written, &cycles,
                            &held, &full, &empty, &level),
                7);
      const nlohmann::json& group = timing_.at("streams").at(name);
      EXPECT_EQ(written, metric(group, "tokens")) << name;
      EXPECT_LE(level, metric(group, "high_water")) << name;
      std::int64_t counted = 0;
      for (const std::int64_t bin : metric<std::vector<std::int64_t>>(group, "occupancy")) counted += bin;
      EXPECT_EQ(cycles, counted) << name;
      const auto all = static_cast<double>(cycles);
      EXPECT_NEAR(static_cast<double>(held) / all, metric<double>(group, "mean_occupancy"), 1e-9) << name;
      EXPECT_NEAR(100.0 * static_cast<double>(full) / all, metric<double>(group, "full"), 1e-9) << name;
      EXPECT_NEAR(100.0 * static_cast<double>(empty) / all, metric<double>(group, "empty"), 1e-9) << name;
    }
  }

  Program program_;
  nlohmann::json timing_;
  int first_ = 0, last_ = 0;  // frames of the window, counted from 1
};

TEST_P(TraceNumbers, OfTimingJsonAreThoseOfTheRows) {
  const Database trace = run(" --timing-frames 5");
  expect_stages(trace);
  expect_frames(trace);
  expect_port_rows(trace);
  expect_occupancies(trace);
}

TEST_P(TraceNumbers, OfTimingJsonAreThoseOfTheTokens) {
  const Database trace = run(" --timing-frames 3 --trace-level tokens --trace-from 0ps");
  expect_stages(trace);
  expect_occupancies(trace);
  // A place is taken in the cycle in which its token is read, too.
  const auto levels = trace.query(
      "create index reads on tokens(stream,begin_ps) where side='read';"
      "select w.stream,count(*),max(w.level+(r.level is not null)) from tokens w left join tokens r on "
      "r.side='read' and "
      "r.stream=w.stream and r.begin_ps=w.begin_ps where w.side='write' group by w.stream");
  EXPECT_EQ(levels.size(), timing_.at("streams").size());
  for (const auto& [stream, group] : timing_.at("streams").items()) {
    const std::string expected =
        fmt::format("{}|{}|{}", stream, metric(group, "tokens"), metric(group, "high_water"));
    EXPECT_NE(std::find(levels.begin(), levels.end(), expected), levels.end()) << expected;
  }
  // Bursts are counted when they are answered, between two arrivals at the host.
  const double seconds =
      1e-12 * static_cast<double>(trace.number(fmt::format(
                  "select max(at_host_ps+0)-min(at_host_ps+0) from frames where frame+0 between {} and {}",
                  first_ - 1, last_)));
  const auto bytes = trace.query(
      fmt::format("select b.port,sum(b.bytes+0) from bursts b, frames f, frames l where f.frame='{}' and "
                  "l.frame='{}' and "
                  "b.answered_ps+0>f.at_host_ps+0 and b.answered_ps+0<=l.at_host_ps+0 group by b.port",
                  first_ - 1, last_));
  EXPECT_FALSE(bytes.empty());
  for (const std::string& line : bytes) {
    const std::string port = line.substr(0, line.find('|'));
    const double count = std::stod(line.substr(port.size() + 1));
    const nlohmann::json& group = timing_.at("memory").at(port);
    EXPECT_DOUBLE_EQ(metric<double>(group, "bytes_per_frame"), count / (last_ - first_ + 1)) << port;
    EXPECT_NEAR(metric<double>(group, "bandwidth"), 1e-6 * count / seconds, 1e-6) << port;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, TraceNumbers,
    testing::Values(Case{"Preset", "--size 96x64"}, Case{"Tiles", "--size 256x32 --set tiles.limit=192"},
                    Case{"SlowMemory", "--size 96x64 --set memory.model=bus --set clocks.memory_hz=5000000"},
                    Case{"SaturatedLink", "--size 96x64 --set link.line_rate=20000000"},
                    Case{"SeveralPasses", "--size 96x64 --set matching.iterations=2"}),
    [](const auto& of) { return std::string(of.param.name); });

}  // namespace trace_numbers_test
}  // namespace parallax::test
