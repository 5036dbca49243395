// SPDX-License-Identifier: Apache-2.0
#include "platform/input/address_trace.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "platform/config/dram_device.hpp"
#include "platform/results/replay_metrics.hpp"
#include "tests/paths.hpp"
#include "tests/platform/error_of.hpp"
#include "tests/platform/temporary_folder.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace address_trace_test {

/// "time R|W address bytes" of each request.
using Requests = std::vector<std::string>;

class AddressTrace : public testing::Test {
 protected:
  Requests read(const std::string& text, const TraceReading& reading = {},
                const std::string& name = "trace") {
    notices_.clear();
    Requests found;
    for (const TraceRequest& request :
         read_address_trace(folder_.write(name, text), reading,
                            [this](const std::string& line) { notices_.push_back(line); })) {
      found.push_back(fmt::format("{:g} {} {:#x} {}", request.time_ns, request.write ? 'W' : 'R',
                                  request.address, request.bytes));
    }
    return found;
  }
  std::string complaint(const std::string& text, const TraceReading& reading = {},
                        const std::string& name = "trace") {
    const std::string path = folder_.write(name, text);
    std::string line = error_of([&] { read_address_trace(path, reading); });
    for (std::size_t at = line.find(path); at != std::string::npos; at = line.find(path))
      line.erase(at, path.size());
    return line;
  }

  const TemporaryFolder folder_;
  std::vector<std::string> notices_;
};

TEST_F(AddressTrace, Csv) {
  const Requests expected{"0 R 0x0 64", "1.5 W 0x1000 32"};
  EXPECT_EQ(read("time_ns,rw,addr,bytes\n0,R,0x0,64\n1.5,w,4096,32\n"), expected);
  EXPECT_TRUE(notices_.empty());
  EXPECT_EQ(read("\xEF\xBB\xBFtime_ns,rw,addr,bytes\r\n0,R,0x0,64\r\n1.5,W,4096,32\r\n"), expected);
  EXPECT_EQ(read("time_ns, rw, addr, bytes\n0, R, 0x0, 64\n 1.5 ,W\t, 4096, 32 \n"), expected);
  EXPECT_EQ(read("# made by hand\n\nTime_ns,RW,Addr,Bytes\n0,R,0X0,64 # first\n\n1.5,W,4096,32"), expected);
}

TEST_F(AddressTrace, Ramulator) {
  EXPECT_EQ(read("0x12345680 R\n0x4cbd56c0 W\n0x35d46f00 R\n"),
            (Requests{"0 R 0x12345680 64", "0 W 0x4cbd56c0 64", "0 R 0x35d46f00 64"}));
  EXPECT_EQ(notices_,
            (std::vector<std::string>{folder_ / "trace" +
                                      ": taken as a trace of Ramulator (0x1234 R): 64 bytes a request, all "
                                      "at once; --request-bytes states another"}));
  EXPECT_EQ(read("1000 R\r\n  ff\tW\r\n"), (Requests{"0 R 0x1000 64", "0 W 0xff 64"}))
      << "hexadecimal without 0x";
  EXPECT_EQ(read("LD 0x1234\nST 0xFF\nLD 256\n"), (Requests{"0 R 0x1234 64", "0 W 0xff 64", "0 R 0x100 64"}))
      << "of version 2; without 0x decimal";
  EXPECT_EQ(read("R 0x1234\nW 0x40\n"), (Requests{"0 R 0x1234 64", "0 W 0x40 64"}));
  TraceReading reading;
  reading.bytes = 32;
  EXPECT_EQ(read("0x40 R\n", reading), (Requests{"0 R 0x40 32"}));
}

TEST_F(AddressTrace, DramSim) {
  TraceReading reading;
  reading.cycle_ns = 1.25;
  EXPECT_EQ(read("0x3C0000 READ 0\n0x3C0040 WRITE 10\n3c0080 write 10\n", reading),
            (Requests{"0 R 0x3c0000 64", "12.5 W 0x3c0040 64", "12.5 W 0x3c0080 64"}));
  EXPECT_EQ(notices_, (std::vector<std::string>{
                          folder_ / "trace" +
                          ": taken as a trace of DRAMsim3 (0x1234 READ 10): 64 bytes a request, cycles of "
                          "1.25 ns; --request-bytes and --trace-mhz state others"}));
  EXPECT_EQ(read("0x7f64768 P_MEM_WR 2\n0x7f64768 P_MEM_RD 4\n"),
            (Requests{"2 W 0x7f64768 64", "4 R 0x7f64768 64"}));
  reading.mhz = 200;
  EXPECT_EQ(read("0x0 READ 10\n", reading), (Requests{"50 R 0x0 64"}));
}

TEST_F(AddressTrace, DramSys) {
  const std::string text =
      "# Comment lines begin with #\n\n31:\tread\t0x400140\n33: (32) read 0x400160\n33: write(128) 0x10 # a "
      "length\n"
      "56 : write 7fff8000 0x123456789abcdef\n";
  EXPECT_EQ(read(text),
            (Requests{"31 R 0x400140 64", "33 R 0x400160 32", "33 W 0x10 128", "56 W 0x7fff8000 64"}));
  EXPECT_NE(notices_.at(0).find("taken as a trace of DRAMSys (10: read 0x1234): 64 bytes a request that does "
                                "not say, cycles of 1 ns;"),
            std::string::npos);
  TraceReading reading;
  reading.mhz = 1000;
  reading.bytes = 16;
  EXPECT_EQ(read("5: read 0x0\n", reading), (Requests{"5 R 0x0 16"}));
}

TEST_F(AddressTrace, Compressed) {
  const std::string path = folder_ / "t.gz";
  gzFile file = gzopen(path.c_str(), "wb");
  gzputs(file, "0x40 READ 3\n");
  gzclose(file);
  EXPECT_EQ(read_address_trace(path).at(0).time_ns, 3);
}

TEST_F(AddressTrace, WhatIsNone) {
  const std::string known =
      "expected a line such as 'time_ns,rw,addr,bytes' (CSV), '10: read 0x1234' (DRAMSys), '0x1234 READ 10' "
      "(DRAMsim3), '0x1234 R' (Ramulator), 'LD 0x1234' (Ramulator 2)";
  EXPECT_EQ(complaint("hello\n"), ":1: 'hello' begins no trace that is known; " + known);
  EXPECT_EQ(complaint("0,R,0,64\n"), ":1: '0,R,0,64' begins no trace that is known; " + known)
      << "without its heading";
  EXPECT_EQ(
      complaint("3 20734016\n"),
      ":1: '3 20734016' begins no trace that is known; this looks like a trace of a processor (instructions, "
      "addresses), which needs a model of one; " +
          known);
  EXPECT_EQ(complaint("R 0,0,1,2,3\n"),
            ":1: 'R 0,0,1,2,3' begins no trace that is known; this looks like a trace of address vectors, "
            "which only "
            "their simulator's mapping makes addresses; " +
                known);
  EXPECT_EQ(complaint("\n# only\n"), ": holds no request");
  EXPECT_EQ(complaint("5: read 0x0\n", {}, "t.rstl"),
            ": times that count from the end of the request before are not replayed; expected a .stl trace");
}

TEST_F(AddressTrace, LinesThatAreNone) {
  EXPECT_EQ(complaint("0x40 R\n0x80\n"), ":2: expected two words, such as 0x1234 R");
  EXPECT_EQ(complaint("0x40 R\n0xg R\n"),
            ":2: the address is '0xg', expected one such as 0x1000, below 2^62");
  EXPECT_EQ(complaint("0x40 R\n0x80 X\n"), ":2: the operation is 'X', expected one such as R or W");
  EXPECT_EQ(complaint("0x40 R\n0xffffffffffffffff R\n"),
            ":2: the address is '0xffffffffffffffff', expected one such as 0x1000, below 2^62");
  EXPECT_EQ(complaint("LD 0x40\nLD\n"), ":2: expected two words, such as LD 0x1234");
  EXPECT_EQ(complaint("LD 0x40\nLD ff\n"),
            ":2: the address is 'ff', expected one such as 0x1000, below 2^62");
  EXPECT_EQ(complaint("0x40 READ 5\n0x40 READ\n"), ":2: expected three words, such as 0x1234 READ 10");
  EXPECT_EQ(complaint("0x40 READ 5\n0x40 READ 5.5\n"), ":2: the cycle is '5.5', expected a whole number");
  EXPECT_EQ(complaint("0x40 READ 5\n0x40 READ 4\n"), ":2: the cycle is 4, before 5 of an earlier line");
  EXPECT_EQ(complaint("0x40 READ 9999999999999\n"), ":1: the time is 1e+13 ns, expected at most 1e+12 ns");
  EXPECT_EQ(complaint("5: read 0x0\n6: read\n"),
            ":2: expected a cycle, an operation and an address, such as 10: read 0x1234");
  EXPECT_EQ(complaint("5: read 0x0\n6: erase 0x0\n"),
            ":2: the operation is 'erase', expected one such as R or W");
  EXPECT_EQ(complaint("5: read 0x0\n6: (0) read 0x0\n"),
            ":2: the length is '0', expected a number from 1 to 1048576");
  EXPECT_EQ(complaint("5: read 0x0\n6: (64 read 0x0\n"),
            ":2: the length is '(64', expected a number from 1 to 1048576");
}

TEST_F(AddressTrace, WhatATraceSaysItselfIsNotStated) {
  TraceReading bytes;
  bytes.bytes = 32;
  EXPECT_EQ(complaint("time_ns,rw,addr,bytes\n0,R,0,64\n", bytes),
            "--request-bytes: each request of  says how long it is");
  TraceReading clock;
  clock.mhz = 100;
  EXPECT_EQ(complaint("0x40 R\n", clock), "--trace-mhz:  counts no cycles, it is a trace like 0x1234 R");
}

double metric(const std::vector<TraceRequest>& trace, const char* name) {
  const DramTiming timing = load_dram_device("ddr3-1066-x32", {test::source_path("platform/presets")});
  return measure(replay(trace, timing, {}, DramMapping::kRowBankColumn, 16), timing).number(name);
}

TEST(ReplayMetrics, BandwidthCountsFromTheFirstRequest) {
  std::vector<TraceRequest> trace;
  for (std::uint64_t i = 0; i < 1000; ++i) trace.push_back({0, false, 64 * i, 64});
  const double at_once = metric(trace, "bandwidth");
  EXPECT_GT(at_once, 3500);
  // A multiple of the interval between refreshes and of the clock, so that nothing else is moved.
  const DramTiming timing = load_dram_device("ddr3-1066-x32", {test::source_path("platform/presets")});
  const double later = 100000.0 * static_cast<double>(timing.refi * timing.clock_period_ps) / 1000;
  for (TraceRequest& request : trace) request.time_ns = later;
  EXPECT_NEAR(metric(trace, "bandwidth") / at_once, 1, 0.02);
  EXPECT_NEAR(metric(trace, "frac_peak") * metric(trace, "peak_bandwidth"), metric(trace, "bandwidth"), 1e-6);
  EXPECT_NEAR(metric(trace, "begin"), later / 1000, 1e-6);
  EXPECT_NEAR(metric(trace, "bandwidth") * (metric(trace, "time") - metric(trace, "begin")), 64000, 1e-3)
      << "MB/s times us are bytes";
}

TEST(ReplayMetrics, AShareOfRowHitsIsNeverNegative) {
  // Sparse reads of one burst, each in another row: some rows are opened again after a refresh.
  std::vector<TraceRequest> trace;
  std::uint64_t state = 1;
  for (int i = 0; i < 20000; ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    trace.push_back({20.0 * i, false, (state >> 36) * 32 % (1u << 30), 32});
  }
  EXPECT_GT(metric(trace, "activates"), metric(trace, "bursts"));
  EXPECT_EQ(metric(trace, "row_hit_burst"), 0);
}

}  // namespace address_trace_test
}  // namespace parallax
