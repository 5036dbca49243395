// SPDX-License-Identifier: Apache-2.0
// What a window and a choice of parts leave, and what is said of those that cannot be.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/traces/database.hpp"

namespace parallax::test {
namespace trace_windows_test {

constexpr const char* kRun = "run --size 96x64 --disparities 32 --timing-only --timing-frames 3 -q ";

class TraceWindows : public testing::Test {
 protected:
  void SetUp() override { SKIP_WITHOUT("sqlite3", "sqlite3"); }

  Database run(const std::string& folder, const std::string& options) const {
    const Outcome outcome = program_(kRun + std::string("--trace csv --out ") + folder + " " + options);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return Database(program_ / folder);
  }
  /// Of a table, the events for which `condition` holds, as one text each.
  static std::vector<std::string> events(const Database& trace, const char* table,
                                         const std::string& condition = "1") {
    return trace.query(fmt::format("select * from {} where {}", table, condition));
  }
  Program program_;
};

TEST_F(TraceWindows, OfFramesAndRowsHoldTheEventsOfTheseAlone) {
  const Database all = run("all", "--trace-level tokens --trace-from 0ps");
  const Database frame = run("frame", "--trace-level tokens --trace-from 2 --trace-to 2");
  const Database rows = run("rows", "--trace-level tokens --trace-from 2:10 --trace-to 2:12");
  for (const char* table : {"rows", "firings", "tokens", "bursts", "ports"}) {
    EXPECT_EQ(events(frame, table), events(all, table, "frame='2'")) << table;
    EXPECT_EQ(events(rows, table), events(all, table, "frame='2' and row+0 between 10 and 12")) << table;
    EXPECT_FALSE(events(rows, table).empty()) << table;
  }
  EXPECT_EQ(events(frame, "frames"), events(all, "frames", "frame='2'"));
}

TEST_F(TraceWindows, OfTimeHoldTheEventsThatTouchIt) {
  const Database all = run("all", "--trace-level tokens --trace-from 0ps");
  const std::int64_t middle =
      all.number("select (begin_ps+end_ps)/2 from rows where stage='census' and frame='2' and row='20'");
  const std::int64_t end = middle + 1'000'000;
  const Database part =
      run("part", fmt::format("--trace-level tokens --trace-from {}ns --trace-to {}ps", middle / 1000, end));
  const std::int64_t begin = middle / 1000 * 1000;
  EXPECT_EQ(events(part, "tokens"),
            events(all, "tokens", fmt::format("end_ps>{} and begin_ps<{}", begin, end)));
  EXPECT_EQ(events(part, "firings"),
            events(all, "firings", fmt::format("end_ps>{} and start_ps<{}", begin, end)));
  EXPECT_EQ(events(part, "bursts"),
            events(all, "bursts", fmt::format("answered_ps>{} and requested_ps<{}", begin, end)));
  EXPECT_FALSE(events(part, "tokens").empty());
  EXPECT_GT(part.number("select max(level+0) from tokens where stream='left_output'"), 100)
      << "written long before";
}

TEST_F(TraceWindows, OfOneLevelHaveTheRowsOfTheOther) {
  const Database rows = run("rows", "");
  const Database tokens = run("tokens", "--trace-level tokens --trace-from 0ps");
  for (const char* table : {"rows", "ports", "frames"})
    EXPECT_EQ(events(rows, table), events(tokens, table)) << table;
  // How full a FIFO is may be known at other dates.
  const char* const sums =
      "select "
      "stream,sum(cycles+0),sum(token_cycles+0),sum(full_cycles+0),sum(empty_cycles+0),sum(written+0),sum("
      "freed+0) "
      "from fifos group by stream";
  EXPECT_EQ(rows.query(sums), tokens.query(sums));
}

TEST_F(TraceWindows, FiringsMakeTheRows) {
  const Database trace = run("out", "--trace-level tokens --trace-from 0ps");
  const auto rows = trace.query(
      "select stage,frame,row,begin_ps,busy_until_ps,firings from rows where draining='0' order by 1,2,3");
  const auto merged = trace.query(
      "create index by_row on firings(stage,frame,row);"
      "select r.stage,r.frame,r.row,min(f.start_ps+0),max(f.end_ps+0),count(*) from rows r, firings f where "
      "r.draining='0' "
      "and f.stage=r.stage and f.frame=r.frame and f.row=r.row and f.start_ps+0>=r.begin_ps+0 and "
      "f.start_ps+0<r.end_ps+0 group by 1,2,3 order by 1,2,3");
  EXPECT_GT(rows.size(), 1000u);
  EXPECT_EQ(merged, rows);
}

TEST_F(TraceWindows, PartsAreTracedAsInTheWholeTrace) {
  const Database all = run("all", "");
  const Database some = run("some", "--trace-parts census,left");
  EXPECT_EQ(events(some, "rows"), events(all, "rows", "stage='census'"));
  EXPECT_EQ(events(some, "ports"), events(all, "ports", "port='left'"));
  EXPECT_EQ(some.query("select distinct stream from fifos order by 1"),
            (std::vector<std::string>{"left_codes", "left_rectified", "right_codes", "right_rectified"}));
  EXPECT_EQ(events(some, "fifos", "stream='left_codes'"), events(all, "fifos", "stream='left_codes'"));
  EXPECT_EQ(events(some, "frames"), events(all, "frames"));
}

TEST(TraceOptions, ThatCannotBeAreOneLine) {
  const struct {
    const char* options;
    const char* error;
  } cases[] = {
      {"--trace wav --out out",
       "--trace wav: there is no format 'wav'; there are perfetto, vcd, csv and json"},
      {"--trace csv", "--trace needs --out: the folder that the trace is written to"},
      {"--trace-from 2 --out out", "--trace-from says what of a trace is wanted: it needs --trace"},
      {"--trace csv --out out --trace-level bits", "--trace-level bits: must be rows or tokens"},
      {"--trace csv --out out --trace-level tokens",
       "--trace-level tokens wants a window, as each frame has some ten million events: --trace-from, "
       "--trace-to"},
      {"--trace csv --out out --trace-parts matchin",
       "--trace-parts: there is no stage or memory port 'matchin'; the nearest is matching"},
      {"--trace csv --out out --trace-from 4",
       "--trace-from: frame 4 is outside the run, which simulates frames 1 to 3 (--timing-frames)"},
      {"--trace csv --out out --trace-to 3:64",
       "--trace-to: row 64 is outside the image, whose rows are 0 to 63"},
      {"--trace csv --out out --trace-from 3 --trace-to 2", "--trace-to is before --trace-from"},
      {"--trace csv --out out --trace-from 2:9 --trace-to 2:8", "--trace-to is before --trace-from"},
      {"--trace csv --out out --trace-from 2us --trace-to 2us", "--trace-to is before --trace-from"},
      {"--trace csv --out out --trace-from 900s", "--trace-from: 900000000 us is after the run's end, "},
      {"--trace csv --out out --vary matching.latency=1,2",
       "--trace is of one run: it cannot go with --vary"},
  };
  for (const auto& c : cases) {
    const Program program;
    const Outcome outcome = program(kRun + std::string(c.options));
    EXPECT_EQ(outcome.code, 2) << c.options;
    EXPECT_EQ(outcome.out, "") << c.options;
    EXPECT_EQ(outcome.err.rfind(std::string("parallax: error: ") + c.error, 0), 0u) << outcome.err;
    EXPECT_EQ(lines(outcome.err).size(), 1u) << outcome.err;
    EXPECT_EQ(program.files(), std::vector<std::string>{}) << c.options;
  }
}

TEST(TraceOptions, AMomentMustBeAFrameARowOrATime) {
  for (const char* when :
       {"0", "-1", "x", "2:", "2:-1", "2:x", "1.5", "5min", "-3ms", "nan", "1e99s", "2:3:4"}) {
    const Program program;
    const Outcome outcome = program(kRun + fmt::format("--trace csv --out out --trace-to {}", when));
    EXPECT_EQ(outcome.code, 2) << when;
    EXPECT_EQ(lines(outcome.err).size(), 1u) << outcome.err;
    EXPECT_NE(
        outcome.err.find(
            "must be a frame (8, counted from 1), a row of a frame (8:120, rows counted from 0) or a time"),
        std::string::npos)
        << when << ": " << outcome.err;
    EXPECT_EQ(program.files(), std::vector<std::string>{}) << when;
  }
}

}  // namespace trace_windows_test
}  // namespace parallax::test
