// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "platform/commands/cli.hpp"
#include "platform/config/dram_device.hpp"
#include "platform/config/preset.hpp"
#include "platform/config/schema.hpp"
#include "platform/input/address_trace.hpp"
#include "tests/paths.hpp"
#include "tests/platform/error_of.hpp"
#include "tests/platform/temporary_folder.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace memory_command_test {

struct Outcome {
  int code;
  std::string out;
  std::string err;
};

Outcome run(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"parallax", "memory"});
  std::vector<const char*> argv;
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  std::ostringstream out, err;
  const int code = run_command_line(static_cast<int>(argv.size()), argv.data(), out, err);
  return {code, out.str(), err.str()};
}

class MemoryCommand : public testing::Test {
 protected:
  std::string write(const std::string& text, const std::string& name = "t.csv") {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  std::string complaint(const std::string& text) {
    const std::string path = write(text);
    const std::string line = error_of([&] { read_address_trace(path); });
    return line.rfind(path, 0) == 0 ? line.substr(path.size()) : line;
  }
  const TemporaryFolder folder_;
};

TEST_F(MemoryCommand, PrintsTextAndJson) {
  const std::string trace = write("time_ns,rw,addr,bytes\n0,R,0x0,64\n0,R,64,64\r\n\n0,W,0x100000,32\n");
  const Outcome text = run({trace, "--config", "ddr3-1066-x32"});
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_NE(text.out.find("frac_peak"), std::string::npos);
  const Outcome json = run({trace, "--config", "ddr3-1066-x32", "--json", "--no-refresh"});
  const auto tree = nlohmann::json::parse(json.out);
  EXPECT_EQ(tree["bursts"]["value"], 5);
  EXPECT_EQ(tree["refreshes"]["value"], 0);
  EXPECT_EQ(tree["rd_lat_avg"]["unit"], "ns");
  EXPECT_FALSE(tree["row_hit_burst"]["description"].get<std::string>().empty());
  EXPECT_EQ(run({trace, "--config", "ddr3-1066-x32", "-q"}).out, "");
}

TEST_F(MemoryCommand, EveryDeviceMovesDataAtLessThanItsPeak) {
  std::string text = "time_ns,rw,addr,bytes\n";
  for (int i = 0; i < 2000; ++i)
    text += "0," + std::string(i % 3 == 0 ? "W" : "R") + "," + std::to_string(i * 64) + ",64\n";
  const std::string trace = write(text);
  const std::vector<PresetSummary> devices = list_presets({test::source_path("platform/presets/memory")});
  ASSERT_GE(devices.size(), 4u);
  for (const auto& [device, description] : devices) {
    for (const char* mapping : {"rbc", "brc", "rbcg"}) {
      const Outcome outcome = run({trace, "--config", device, "--mapping", mapping, "--json"});
      ASSERT_EQ(outcome.code, 0) << outcome.err;
      const double part = nlohmann::json::parse(outcome.out)["frac_peak"]["value"];
      EXPECT_GT(part, 0.3) << device;
      EXPECT_LT(part, 1.0) << device;
    }
  }
}

TEST_F(MemoryCommand, SaysWhatReachesBeyondTheDevices) {
  const std::string trace = write("time_ns,rw,addr,bytes\n0,R,0x3fffffc0,64\n0,R,0x40000000,64\n");
  const Outcome outcome = run({trace, "--config", "ddr3-1066-x32"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(
      outcome.err,
      "parallax: note: 1 of 2 requests reach beyond the devices' 1073741824 bytes and begin anew there\n");
}

TEST_F(MemoryCommand, TracesOfOtherPrograms) {
  const std::string trace = write("0x0 READ 0\n0x40 READ 100\n", "t.trace");
  const Outcome outcome = run({trace, "--config", "ddr3-1600-x64", "--json"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err,
            "parallax: note: " + trace +
                ": taken as a trace of DRAMsim3 (0x1234 READ 10): 64 bytes a request, cycles of 1.25 ns; "
                "--request-bytes and --trace-mhz state others\n");
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["bursts"]["value"], 2);
  const Outcome stated =
      run({trace, "--config", "ddr3-1600-x64", "--json", "--trace-mhz", "100", "--request-bytes", "256"});
  EXPECT_EQ(nlohmann::json::parse(stated.out)["bursts"]["value"], 8);
  // The second read begins at 1 us and takes four bursts, a row hit behind the first.
  EXPECT_NEAR(nlohmann::json::parse(stated.out)["time"]["value"], 1.0, 0.1);
  EXPECT_EQ(run({trace, "--config", "ddr3-1600-x64", "-q"}).err, "");
}

TEST_F(MemoryCommand, TracesThatAreNone) {
  EXPECT_EQ(complaint("time,rw\n").rfind(":1: 'time,rw' begins no trace that is known; ", 0), 0u);
  EXPECT_EQ(complaint(""), ": holds no request");
  const auto line = [&](const std::string& request) {
    return complaint("time_ns,rw,addr,bytes\n0,R,0,64\n" + request + "\n");
  };
  EXPECT_EQ(line("0,R,0"), ":3: expected four fields, time_ns,rw,addr,bytes");
  EXPECT_EQ(line("0,R,0,64,1"), ":3: expected four fields, time_ns,rw,addr,bytes");
  EXPECT_EQ(line("0,R,0,64,"), ":3: expected four fields, time_ns,rw,addr,bytes");
  EXPECT_EQ(line("soon,R,0,64"), ":3: time_ns is 'soon', expected a number from 0 to 1000000000000");
  EXPECT_EQ(line("-1,R,0,64"), ":3: time_ns is '-1', expected a number from 0 to 1000000000000");
  EXPECT_EQ(line("0,X,0,64"), ":3: rw is 'X', expected R or W");
  EXPECT_EQ(line("0,R,0xg,64"), ":3: addr is '0xg', expected an address such as 0x1000, below 2^62");
  EXPECT_EQ(line("0,R,-5,64"), ":3: addr is '-5', expected an address such as 0x1000, below 2^62");
  EXPECT_EQ(line("0,R,0,0"), ":3: bytes is '0', expected a number from 1 to 1048576");
  EXPECT_EQ(line("0,R,0,1048577"), ":3: bytes is '1048577', expected a number from 1 to 1048576");
  EXPECT_EQ(complaint("time_ns,rw,addr,bytes\n5,R,0,64\n4,R,0,64\n"),
            ":3: time_ns is 4, before 5 of an earlier line");
  // A compressed file whose end is missing.
  const std::string whole = folder_ / "whole.csv.gz";
  gzFile file = gzopen(whole.c_str(), "wb");
  for (const char* row : {"time_ns,rw,addr,bytes\n", "0,R,0,64\n", "0,w,64,64\n"}) {
    gzputs(file, row);
    gzflush(file, Z_SYNC_FLUSH);
  }
  gzclose(file);
  EXPECT_EQ(read_address_trace(whole).size(), 2u);
  std::filesystem::resize_file(whole, std::filesystem::file_size(whole) - 10);
  EXPECT_EQ(error_of([&] { read_address_trace(whole); }),
            whole + ": ends in the middle of the compressed data");
  EXPECT_EQ(error_of([&] { read_address_trace(folder_ / "none.csv"); }),
            (folder_ / "none.csv") + ": cannot be read: No such file or directory");
  EXPECT_EQ(error_of([&] { read_address_trace(folder_.path()); }),
            folder_.path().string() + ": cannot be read: Is a directory");
}

TEST_F(MemoryCommand, OptionsOutOfRange) {
  const std::string trace = write("time_ns,rw,addr,bytes\n0,R,0x0,64\n");
  const auto error = [&](std::vector<std::string> options) {
    options.insert(options.begin(), trace);
    const Outcome outcome = run(options);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.out, "");
    return outcome.err;
  };
  EXPECT_EQ(error({"--config", "ddr3-1066-x32", "--window", "0"}),
            "parallax: error: --window is 0, allowed is 1 to 1000000\n");
  EXPECT_EQ(error({"--config", "ddr3-1066-x32", "--efficiency", "101"}),
            "parallax: error: --efficiency is 101, allowed is 1 to 100\n");
  EXPECT_EQ(error({"--config", "ddr3-1066-x32", "--request-bytes", "0"}),
            "parallax: error: --request-bytes is 0, allowed is 1 to 1048576\n");
  EXPECT_EQ(error({"--config", "ddr3-1066-x32", "--trace-mhz", "0"}),
            "parallax: error: --trace-mhz is 0, allowed is 0.001 to 1000000\n");
  EXPECT_EQ(error({"--config", "ddr3-1066-x32", "--mapping", "cbr"}),
            "parallax: error: --mapping is 'cbr', expected rbc, brc or rbcg\n");
  EXPECT_NE(error({"--config", "ddr3-1066-x23"}).find("the nearest is ddr3-1066-x32"), std::string::npos);
}

TEST_F(MemoryCommand, ADeviceOfOnesOwn) {
  const std::string device =
      write("description = \"slow\"\ninherits = \"ddr3-1066-x32\"\n[dram]\ncl = 9\n", "slow.toml");
  EXPECT_EQ(load_dram_device(device, {test::source_path("platform/presets")}).cl, 9);
  const std::string wrong = write("description = \"\"\n[dram]\ntCL = 9\n", "wrong.toml");
  EXPECT_NE(error_of([&] { load_dram_device(wrong, {}); }).find("dram.tCL"), std::string::npos);
  EXPECT_EQ(error_of([] { load_dram_device("none", {}); }), "no memory device 'none' in no folder");
  DramTiming timing;
  const auto complaint = [&timing](auto change) {
    timing = {};
    change(timing);
    return error_of([&] { timing.validate(); });
  };
  EXPECT_EQ(complaint([](DramTiming& t) { t.burst_length = 7; }),
            "dram.burst_length = 7: must be even, data moves twice a clock");
  EXPECT_EQ(complaint([](DramTiming& t) { t.columns = 1001; }),
            "dram.columns = 1001: must be a multiple of dram.burst_length = 8");
  EXPECT_EQ(complaint([](DramTiming& t) { t.bank_groups = 3; }),
            "dram.bank_groups = 3: must divide dram.banks = 8");
  EXPECT_EQ(complaint([](DramTiming& t) { t.ccd = 3; }),
            "dram.ccd = 3: must be at least 4, half of dram.burst_length");
  EXPECT_EQ(
      complaint([](DramTiming& t) { t.refi = 173; }),
      "dram.refi = 173: must be 0 or more than 181, the clocks in which a row is closed, refreshed, opened "
      "and read "
      "(dram.ras, dram.rp, dram.rfc, dram.rcd and others), or no row is ever read between two refreshes");
  EXPECT_EQ(complaint([](DramTiming&) {}), "(no error)");
}

TEST_F(MemoryCommand, ADeviceOfAnotherClockStatesAllItsTimes) {
  const auto error = [this](const std::string& text) {
    const std::string device = write("description = \"\"\n" + text, "device.toml");
    return error_of([&] { load_dram_device(device, {test::source_path("platform/presets")}); });
  };
  std::string times;
  Schema schema;
  DramTiming timing;
  describe(schema, timing);
  for (const Key& key : schema.keys()) {
    if (key.unit == "clocks")
      times += fmt::format("{} = {}\n", key.name(), std::get<std::int64_t>(key.get()));
  }
  const std::string inherits = "inherits = \"ddr3-1066-x32\"\n";
  const std::string clock = "[dram]\nclock_period_ps = 2500\n";
  EXPECT_EQ(error(clock + times), "(no error)");
  EXPECT_EQ(error(inherits + clock + times), "(no error)");
  EXPECT_EQ(error(inherits + "[dram]\ncl = 8\nbanks = 16\n"), "(no error)");
  const auto without = [&](const std::string& line) {
    std::string left = times;
    left.erase(left.find(line), line.size());
    return left;
  };
  for (const std::string& head : {std::string(), inherits}) {
    const std::string message = error(head + clock + without("cl = 7\n"));
    const std::string expected =
        "dram.clock_period_ps is stated without all times in its clocks; state too: dram.cl";
    EXPECT_EQ(message.substr(message.find("dram.clock")), expected);
    EXPECT_NE(message.find("device.toml:"), std::string::npos) << message;
  }
}

// The median of three public cycle-accurate simulators, where the reference is there.
TEST(MemoryReference, BandwidthLatencyAndRowHits) {
  const std::string folder = test::shared_data("dram/");
  std::ifstream reference(folder + "reference.csv");
  if (!reference) GTEST_SKIP() << "no reference data";
  const std::map<std::string, const char*> devices{{"x32", "ddr3-1066-x32"}, {"x64", "ddr3-1600-x64"}};
  std::string line;
  std::getline(reference, line);
  int rows = 0;
  while (std::getline(reference, line)) {
    std::istringstream in(line);
    std::vector<std::string> fields;
    for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
    const DramTiming timing =
        load_dram_device(devices.at(fields[0]), {test::source_path("platform/presets")});
    const ReplayResult result = replay(read_address_trace(folder + fields[1] + ".csv.gz"), timing, {},
                                       DramMapping::kRowBankColumn, 16);
    const double seconds = static_cast<double>(result.clocks * timing.clock_period_ps) * 1e-12;
    const double part = static_cast<double>(result.bytes) / seconds / timing.peak_bandwidth();
    const double latency = result.latency_sum / static_cast<double>(result.reads);
    const auto bursts = static_cast<double>(result.commands.reads + result.commands.writes);
    const double hits = 1 - static_cast<double>(result.commands.activates) / bursts;
    EXPECT_NEAR(part / std::stod(fields[2]), 1, 0.02) << line;
    EXPECT_NEAR(latency / std::stod(fields[5]), 1, 0.02) << line;
    EXPECT_NEAR(hits, std::stod(fields[8]), 0.015) << line;
    ++rows;
  }
  EXPECT_GE(rows, 1);
}

}  // namespace memory_command_test
}  // namespace parallax
