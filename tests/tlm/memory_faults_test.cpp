// SPDX-License-Identifier: Apache-2.0
// What a memory refuses, and what it says of who does not keep to the protocol.
#include <gtest/gtest.h>

#include "tests/platform/error_of.hpp"
#include "tests/tlm/memory_bench.hpp"
#include "tlm/dram_scheduler.hpp"
#include "tlm/memory.hpp"
#include "tlm/time_resolution.hpp"

namespace parallax::test {
namespace memory_faults_test {

// The error that the simulation ends with.
std::string report() {
  try {
    sc_core::sc_start();
  } catch (const sc_core::sc_report& report) {
    return std::string(report.get_msg_type()) + ": " + report.get_msg();
  }
  return "";
}

TEST(MemoryFaults, RefusesWhatItCannotDo) {
  Bench b;
  std::uint8_t enable = 0xFF;
  b.thread([&] {
    b[0].send(::tlm::TLM_READ_COMMAND, (1 << 16) - 63, 64);
    b[0].send(::tlm::TLM_READ_COMMAND, ~0ull - 10, 64);
    ::tlm::tlm_generic_payload& bytes = b[0].take(::tlm::TLM_READ_COMMAND, 0, 8);
    bytes.set_byte_enable_ptr(&enable);
    bytes.set_byte_enable_length(1);
    b[0].send(bytes);
    ::tlm::tlm_generic_payload& streaming = b[0].take(::tlm::TLM_READ_COMMAND, 0, 8);
    streaming.set_streaming_width(4);
    b[0].send(streaming);
    b[0].send(::tlm::TLM_READ_COMMAND, (1 << 16) - 64, 64);
  });
  sc_core::sc_start();
  EXPECT_EQ(b[0].times[0].status, ::tlm::TLM_ADDRESS_ERROR_RESPONSE);
  EXPECT_EQ(b[0].times[1].status, ::tlm::TLM_ADDRESS_ERROR_RESPONSE);
  EXPECT_EQ(b[0].times[2].status, ::tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE);
  EXPECT_EQ(b[0].times[3].status, ::tlm::TLM_BURST_ERROR_RESPONSE);
  EXPECT_EQ(b[0].times[4].status, ::tlm::TLM_OK_RESPONSE);
}

TEST(MemoryFaults, ReportsASecondRequestBeforeTheEndOfTheFirst) {
  BusMemory t = timing();
  t.queue_depth = 1;
  Bench b(t);
  PayloadPool pool(64);
  b.thread([&] {
    for (int i = 0; i < 3; ++i) {
      ::tlm::tlm_generic_payload& payload = pool.take(::tlm::TLM_READ_COMMAND, 0, 8);
      ::tlm::tlm_phase phase = ::tlm::BEGIN_REQ;
      sc_core::sc_time delay;
      b[0].socket->nb_transport_fw(payload, phase, delay);
    }
  });
  try {
    sc_core::sc_start();
    FAIL();
  } catch (const sc_core::sc_report& report) {
    EXPECT_STREQ(report.get_msg_type(), "/parallax/memory/phase");
  }
}

TEST(MemoryFaults, ReportsAnEndOfAResponseThatDidNotBegin) {
  Bench b;
  b.thread([&] {
    b[0].send(::tlm::TLM_READ_COMMAND, 0, 8);
    b[0].wait_for_all();
    PayloadPool pool(64);
    ::tlm::tlm_generic_payload& other = pool.take(::tlm::TLM_READ_COMMAND, 0, 8);
    ::tlm::tlm_phase phase = ::tlm::END_RESP;
    sc_core::sc_time delay;
    b[0].socket->nb_transport_fw(other, phase, delay);
  });
  EXPECT_EQ(report(), "/parallax/memory/phase: an END_RESP without a BEGIN_RESP of that request before it");
}

TEST(MemoryFaults, ReportsARequestWithoutAMemoryManager) {
  Bench b;
  ::tlm::tlm_generic_payload payload;
  b.thread([&] {
    ::tlm::tlm_phase phase = ::tlm::BEGIN_REQ;
    sc_core::sc_time delay;
    b[0].socket->nb_transport_fw(payload, phase, delay);
  });
  EXPECT_EQ(report(), "/parallax/memory/payload: nb_transport needs a payload with a memory manager");
}

TEST(MemoryFaults, ARequestWithoutBytesIsAnErrorAndNotCounted) {
  Bench b;
  ::tlm::tlm_generic_payload payload;
  b.thread([&] {
    payload.set_command(::tlm::TLM_WRITE_COMMAND);
    payload.set_address(0);
    payload.set_data_length(64);
    payload.set_streaming_width(64);
    sc_core::sc_time delay;
    b[0].socket->b_transport(payload, delay);
    b[0].send(::tlm::TLM_IGNORE_COMMAND, 0, 8);
    b[0].send(::tlm::TLM_READ_COMMAND, 0, 8);
    b[0].wait_for_all();
  });
  sc_core::sc_start();
  EXPECT_EQ(payload.get_response_status(), ::tlm::TLM_GENERIC_ERROR_RESPONSE);
  EXPECT_EQ(b.memory.statistics(0).written_bytes, 0u);
  EXPECT_EQ(b.memory.statistics(0).read_bytes, 8u);
  EXPECT_EQ(b.memory.statistics(0).requests, 3u);
}

TEST(MemoryFaults, ImpossibleDramsAreRefused) {
  const auto complaint = [](auto change) {
    DramMemory memory;
    change(memory);
    return error_of([&] { DramScheduler{memory}; });
  };
  EXPECT_EQ(complaint([](DramMemory& m) { m.policy.read_queue = 0; }),
            "memory.read_queue = 0: must be from 1 to 1024");
  EXPECT_EQ(complaint([](DramMemory& m) { m.policy.write_queue = 2000; }),
            "memory.write_queue = 2000: must be from 1 to 1024");
  EXPECT_EQ(complaint([](DramMemory& m) { m.policy.high_watermark = 33; }),
            "memory.write_high = 33: must be from 1 to 32");
  EXPECT_EQ(complaint([](DramMemory& m) { m.policy.low_watermark = 26; }),
            "memory.write_low = 26: must be from 0 to 25");
  EXPECT_EQ(complaint([](DramMemory& m) { m.policy.longest_batch = 0; }),
            "memory.write_batch = 0: must be from 1 to 1024");
  EXPECT_EQ(complaint([](DramMemory& m) { m.policy.efficiency = 0; }),
            "memory.efficiency = 0: must be from 1 to 100");
  EXPECT_EQ(complaint([](DramMemory& m) { m.timing.banks = 0; }), "dram.banks = 0: must be at least 1");
  EXPECT_EQ(complaint([](DramMemory& m) { m.timing.clock_period_ps = 0; }),
            "dram.clock_period_ps = 0: must be at least 1");
  EXPECT_EQ(complaint([](DramMemory& m) { m.latency = -1; }),
            "memory.latency_cycles = -1: must be at least 0");
  EXPECT_EQ(complaint([](DramMemory&) {}), "(no error)");
  MemoryTargetConfig target;
  target.queue_depth = 0;
  EXPECT_EQ(error_of([&] { Memory("m", target, std::make_unique<DramScheduler>(DramMemory{})); }),
            "memory.queue_depth = 0: must be at least 1");
  EXPECT_THROW(Memory("n", {}, nullptr), std::invalid_argument);
}

TEST(TimeResolution, OtherThanAPicosecondIsRefused) {
  sc_core::sc_set_time_resolution(1, sc_core::SC_NS);
  const std::string line =
      "SystemC's time resolution is 1 ns; Parallax counts in picoseconds, the default: leave "
      "sc_set_time_resolution() out";
  EXPECT_EQ(error_of([] { require_picosecond_resolution(); }), line);
  EXPECT_EQ(error_of([] { ClockDomain("clock", Hertz(1)); }), line);
}

}  // namespace memory_faults_test
}  // namespace parallax::test
