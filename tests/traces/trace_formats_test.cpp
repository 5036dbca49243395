// SPDX-License-Identifier: Apache-2.0
// Every format, read by a program that is not ours, says the same.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/paths.hpp"
#include "tests/traces/database.hpp"
#include "tests/traces/tracks.hpp"
#include "tests/traces/wave.hpp"

namespace parallax::test {
namespace trace_formats_test {

constexpr const char* kRun =
    "run --size 96x64 --disparities 32 --timing-only --timing-frames 2 -q --out out ";
constexpr const char* kTokens = "--trace-level tokens --trace-from 2:4 --trace-to 2:9 ";

constexpr const char* kWaits[] = {"",       "starved",      "blocked",
                                  "memory", "synchroniser", "blanking"};  // as VCD counts them

class TraceFormats : public testing::Test {
 protected:
  void run(const std::string& options) {
    const Outcome outcome = program_(kRun + options);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  Program program_;
};

TEST_F(TraceFormats, JsonHasTheColumnsOfCsv) {
  SKIP_WITHOUT("sqlite3", "sqlite3");
  run(std::string("--trace csv,json ") + kTokens);
  const Database csv(program_ / "out");
  const auto json = nlohmann::ordered_json::parse(program_.read("out/trace.json"));
  EXPECT_EQ(json.at("rows"), 64);
  EXPECT_EQ(json.at("frames"), 2);
  EXPECT_TRUE(json.at("waits").empty());
  std::map<std::string, std::vector<std::string>> tables;
  for (const auto& event : json.at("events")) {
    const std::string table = event.at(0);
    ASSERT_EQ(event.size(), json.at("columns").at(table).size() + 1) << event;
    std::string line;
    for (std::size_t i = 1; i < event.size(); ++i) {
      const auto& value = event[i];
      line += i == 1 ? "" : "|";
      line += value.is_string()    ? value.get<std::string>()
              : value.is_boolean() ? (value.get<bool>() ? "1" : "0")
                                   : value.dump();
    }
    tables[table].push_back(line);
  }
  for (const auto& [table, columns] : json.at("columns").items()) {
    EXPECT_EQ(columns, csv.columns(table)) << table;
  }
  for (const char* table : {"rows", "ports", "firings", "tokens", "bursts"}) {
    EXPECT_FALSE(tables[table].empty()) << table;
  }
  for (const auto& [table, events] : tables) EXPECT_EQ(events, csv.query("select * from " + table)) << table;
}

TEST_F(TraceFormats, VcdHasTheHandshakesAndFiringsOfCsv) {
  SKIP_WITHOUT("sqlite3", "sqlite3");
  SKIP_WITHOUT("fst2vcd", "gtkwave");
  run(std::string("--trace csv,vcd ") + kTokens);
  const std::string out = (program_ / "out/").string();
  const Wave wave = read_wave(out + "trace.vcd");
  EXPECT_EQ(wave.timescale, "1ps ");
  const Database csv(program_ / "out");
  const std::string pipeline = "machine.core.pipeline.";
  std::map<std::string, std::size_t> high;
  for (const std::string& line :
       csv.query("select stream,side,begin_ps,end_ps,level from tokens where row!='-1'")) {
    std::istringstream in(line);
    std::string stream, side, begin, end, level;
    std::getline(in, stream, '|');
    std::getline(in, side, '|');
    std::getline(in, begin, '|');
    std::getline(in, end, '|');
    std::getline(in, level, '|');
    ASSERT_TRUE(wave.is(pipeline + stream + "." + side, 1, std::stoll(begin), std::stoll(end))) << line;
    ASSERT_EQ(wave.at(pipeline + stream + ".level", std::stoll(end)), std::stoll(level)) << line;
    ++high[stream + "." + side];
  }
  EXPECT_GT(high.size(), 20u);
  for (const std::string& line :
       csv.query("select stage,work,start_ps,end_ps,frame,row,case when start_ps=free_ps then '' when "
                 "ready_ps-free_ps>=start_ps-ready_ps then input_wait else room_wait end from firings")) {
    std::istringstream in(line);
    std::string stage, work, start, end, frame, row, wait;
    std::getline(in, stage, '|');
    std::getline(in, work, '|');
    std::getline(in, start, '|');
    std::getline(in, end, '|');
    std::getline(in, frame, '|');
    std::getline(in, row, '|');
    std::getline(in, wait, '|');
    ASSERT_EQ(kWaits[static_cast<std::size_t>(wave.at(pipeline + stage + ".waited", std::stoll(start)))],
              wait)
        << line;
    ASSERT_TRUE(
        wave.is(pipeline + stage + ".state", work == "busy" ? 0 : 5, std::stoll(start), std::stoll(end)))
        << line;
    ASSERT_EQ(wave.at(pipeline + stage + ".frame", std::stoll(start)), std::stoll(frame)) << line;
    ASSERT_EQ(wave.at(pipeline + stage + ".row", std::stoll(start)), std::stoll(row)) << line;
  }
  // High for as long as tokens pass, and no longer.
  const auto& writes = wave.changes.at(pipeline + "winners.write");
  std::int64_t time_high = 0;
  for (std::size_t i = 0; i + 1 < writes.size(); ++i) {
    if (writes[i].second == 1) time_high += writes[i + 1].first - writes[i].first;
  }
  EXPECT_EQ(time_high,
            csv.number("select sum(end_ps-begin_ps) from tokens where stream='winners' and side='write'"));
}

TEST_F(TraceFormats, VcdOfRowsHasTheRowsOfCsv) {
  SKIP_WITHOUT("sqlite3", "sqlite3");
  SKIP_WITHOUT("fst2vcd", "gtkwave");
  run("--trace csv,vcd");
  const std::string out = (program_ / "out/").string();
  const Wave wave = read_wave(out + "trace.vcd");
  const Database csv(program_ / "out");
  const auto rows = csv.query("select stage,begin_ps,end_ps,frame,row,wait from rows");
  EXPECT_GT(rows.size(), 1000u);
  for (const std::string& line : rows) {
    std::istringstream in(line);
    std::string stage, begin, end, frame, row;
    std::getline(in, stage, '|');
    std::getline(in, begin, '|');
    std::getline(in, end, '|');
    std::getline(in, frame, '|');
    std::getline(in, row, '|');
    const std::string name = "machine.core.pipeline." + stage;
    ASSERT_TRUE(wave.is(name + ".row", std::stoll(row), std::stoll(begin), std::stoll(end))) << line;
    ASSERT_TRUE(wave.is(name + ".frame", std::stoll(frame), std::stoll(begin), std::stoll(end))) << line;
  }
  for (const char* step :
       {"exposed", "first_byte", "startable", "in_memory", "core_started", "results_in_memory", "at_host"}) {
    const std::int64_t date = csv.number(fmt::format("select {}_ps from frames where frame='2'", step));
    EXPECT_EQ(wave.at(std::string("frames.") + step, date), 2) << step;
    EXPECT_EQ(wave.at(std::string("frames.") + step, date - 1), 1) << step;
  }
}

class PerfettoFormat : public TraceFormats {
 protected:
  Tracks tracks() const { return read_tracks((program_ / "out/trace.pftrace").string()); }
};

TEST_F(PerfettoFormat, OfRowsHasTheRowsPortsAndFramesOfCsv) {
  SKIP_WITHOUT("protoc", "protobuf-compiler");
  SKIP_WITHOUT("sqlite3", "sqlite3");
  run("--trace csv,perfetto");
  const Tracks perfetto = tracks();
  const Database csv(program_ / "out");
  for (const std::string& stage : csv.query("select distinct stage from rows")) {
    std::vector<std::string> slices;
    for (const Tracks::Slice& slice : perfetto.slices.at(stage)) {
      if (slice.name.rfind("row ", 0) != 0) continue;
      EXPECT_GE(slice.flows, 1u);
      const auto argument = [&](const char* name) {
        const auto found = slice.arguments.find(name);
        return found == slice.arguments.end() ? std::string("0") : found->second;
      };
      slices.push_back(fmt::format("{}|{}|{}|{}|{}|{}|{}|{}", slice.name, argument("frame"), slice.begin,
                                   slice.end, argument("firings"), argument("busy_cycles"),
                                   argument("starved_cycles"), argument("memory_cycles")));
    }
    EXPECT_EQ(slices,
              csv.query("select 'row '||row||(case draining when '1' then ' out' else '' end),frame,begin_ps,"
                        "busy_until_ps,firings,busy,starved,memory from rows where stage='" +
                        stage + "'"))
        << stage;
  }
  for (const std::string& port : csv.query("select distinct port from ports")) {
    std::vector<std::string> slices;
    for (const Tracks::Slice& slice : perfetto.slices.at("memory: " + port)) {
      slices.push_back(fmt::format("{}|{}|{}|{}|{}", slice.name, slice.begin, slice.end,
                                   slice.arguments.at("bytes"), slice.arguments.at("bursts")));
    }
    EXPECT_EQ(slices, csv.query("select 'row '||row,begin_ps,end_ps,bytes,bursts from ports where port='" +
                                port + "'"))
        << port;
  }
  std::set<std::string> frames;
  for (const auto& [track, slices] : perfetto.slices) {
    if (track.rfind("frame in flight", 0) != 0) continue;
    for (const Tracks::Slice& slice : slices) {
      if (slice.name.rfind("frame ", 0) == 0)
        frames.insert(fmt::format("{}|{}|{}", slice.name, slice.begin, slice.end));
    }
  }
  const auto expected = csv.query("select 'frame '||frame,exposed_ps,at_host_ps from frames");
  EXPECT_EQ(frames, std::set<std::string>(expected.begin(), expected.end()));
}

TEST_F(PerfettoFormat, OfTokensHasTheFiringsLevelsAndBurstsOfCsv) {
  SKIP_WITHOUT("protoc", "protobuf-compiler");
  SKIP_WITHOUT("sqlite3", "sqlite3");
  run(std::string("--trace csv,perfetto ") + kTokens);
  const Tracks perfetto = tracks();
  const Database csv(program_ / "out");
  for (const std::string& stage : csv.query("select distinct stage from firings")) {
    std::vector<std::string> slices;
    for (const Tracks::Slice& slice : perfetto.slices.at(stage)) {
      if (slice.name == "firing" || slice.name == "overhead")
        slices.push_back(fmt::format("{}|{}", slice.begin, slice.end));
    }
    EXPECT_EQ(slices, csv.query("select start_ps,end_ps from firings where stage='" + stage + "'")) << stage;
  }
  for (const std::string& line : csv.query("select stream,count(*) from tokens group by stream")) {
    const std::string stream = line.substr(0, line.find('|'));
    const auto found = std::find_if(
        perfetto.counters.begin(), perfetto.counters.end(),
        [&](const auto& counter) { return counter.first.rfind("FIFO: " + stream + " (", 0) == 0; });
    ASSERT_NE(found, perfetto.counters.end()) << stream;
    std::vector<std::string> levels;
    for (const auto& [time, level] : found->second) levels.push_back(fmt::format("{}|{}", time, level));
    EXPECT_EQ(levels, csv.query("select end_ps,level from tokens where stream='" + stream + "'")) << stream;
  }
  std::size_t bursts = 0;
  for (const auto& [track, slices] : perfetto.slices)
    bursts += track.find(" burst ") != std::string::npos ? slices.size() : 0;
  EXPECT_EQ(static_cast<std::int64_t>(bursts), csv.number("select count(*) from bursts"));
  for (const auto& [track, counts] : perfetto.counters) {
    if (track.find("requests under way") == std::string::npos) continue;
    for (const auto& [time, count] : counts) EXPECT_GE(count, 0) << track;
  }
}

}  // namespace trace_formats_test
}  // namespace parallax::test
