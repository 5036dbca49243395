// SPDX-License-Identifier: Apache-2.0
// A DMA engine between a memory and the end of a stream.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tests/timing/date_log.hpp"
#include "tests/tlm/bus_memory.hpp"
#include "tlm/dma.hpp"
#include "tlm/memory.hpp"

namespace parallax::test {

using Dates = std::vector<std::int64_t>;
using Values = std::vector<std::uint8_t>;

inline Values pattern(std::size_t size) {
  Values all(size);
  for (std::size_t i = 0; i < size; ++i) all[i] = static_cast<std::uint8_t>(i * 7 + i / 251);
  return all;
}

/// Takes bursts, each `pause` cycles after the one before, as many as it is told, and their values.
class BurstSink final : public sc_core::sc_module {
 public:
  StreamIn<std::uint8_t> in{"in"};
  Values values;
  BurstSink(const sc_core::sc_module_name& name, const ClockDomain& clock, std::uint64_t bursts,
            std::int64_t pause)
      : sc_module(name), clock_(clock), bursts_(bursts), pause_(pause) {
    in.on_row(0,
              [this](const std::uint8_t* row, std::size_t n) { values.insert(values.end(), row, row + n); });
    SC_HAS_PROCESS(BurstSink);
    SC_THREAD(run);
  }

 private:
  void run() {
    for (std::uint64_t i = 0; i < bursts_; ++i) {
      in->wait_readable();
      in->release();
      clock_.wait_until(clock_.now() + Cycles(pause_));
    }
  }
  const ClockDomain& clock_;
  std::uint64_t bursts_;
  std::int64_t pause_;
};

/// Sends values, then as many bursts as it is told.
class BurstSource final : public sc_core::sc_module {
 public:
  std::size_t late = 0;  // of the values, those that are sent with the last burst
  StreamOut<std::uint8_t> out{"out"};
  BurstSource(const sc_core::sc_module_name& name, Values values, std::uint64_t bursts)
      : sc_module(name), values_(std::move(values)), bursts_(bursts) {
    SC_HAS_PROCESS(BurstSource);
    SC_THREAD(run);
  }

 private:
  void run() {
    const std::size_t early = values_.size() - late;
    if (early > 0) out.send_row(values_.data(), early);
    for (std::uint64_t i = 0; i < bursts_; ++i) {
      out[0]->wait_writable();
      if (i + 1 == bursts_ && late > 0) out.send_row(values_.data() + early, late);
      out[0]->commit();
    }
  }
  Values values_;
  std::uint64_t bursts_;
};

template <class MemoryModel>
struct ReaderBench {
  template <class... Arguments>
  ReaderBench(const DmaEngineConfig& config, std::uint64_t bursts, std::int64_t pause,
              Arguments&&... memory_arguments)
      : memory("memory", memory_arguments...),
        dataflow("dataflow"),
        reader("reader", config, clock),
        stream("stream", dataflow, clock, clock, config.fifo()),
        log(dates),
        sink("sink", clock, bursts, pause) {
    reader.master.socket.bind(memory.socket);
    reader.out_bursts(stream);
    sink.in(stream);
    stream.add_listener(log);
  }
  ClockDomain clock{"dma", Hertz(100'000'000)};
  MemoryModel memory;
  Dataflow dataflow;
  DmaReader reader;
  Stream<std::uint8_t> stream;
  EdgeDates dates;
  DateLog log;
  BurstSink sink;
};

template <class MemoryModel>
struct WriterBench {
  template <class... Arguments>
  WriterBench(const DmaEngineConfig& config, const Values& values, std::uint64_t bursts,
              Arguments&&... memory_arguments)
      : memory("memory", memory_arguments...),
        dataflow("dataflow"),
        writer("writer", config, clock),
        stream("stream", dataflow, clock, clock, config.fifo()),
        log(dates),
        source("source", values, bursts) {
    writer.master.socket.bind(memory.socket);
    writer.in_bursts(stream);
    source.out(stream);
    stream.add_listener(log);
  }
  ClockDomain clock{"dma", Hertz(100'000'000)};
  MemoryModel memory;
  Dataflow dataflow;
  DmaWriter writer;
  Stream<std::uint8_t> stream;
  EdgeDates dates;
  DateLog log;
  BurstSource source;
};

/// Writes the memory from its first byte on, in no time.
inline void fill(BusMaster& master, Values bytes) {
  ::tlm::tlm_generic_payload payload;
  payload.set_command(::tlm::TLM_WRITE_COMMAND);
  payload.set_data_ptr(bytes.data());
  payload.set_data_length(static_cast<unsigned>(bytes.size()));
  payload.set_streaming_width(static_cast<unsigned>(bytes.size()));
  master.socket->transport_dbg(payload);
}

/// 100 MHz as the engines; 8 B a cycle, 3 cycles of latency.
inline BusMemory plain_memory() {
  BusMemory t;
  t.size = Bytes(1 << 16);
  t.bytes_per_cycle = Bytes(8);
  t.latency = Cycles(3);
  return t;
}

inline DmaEngineConfig engine(std::int64_t burst, std::uint32_t outstanding, std::uint32_t fifo_bursts) {
  return {Bytes(burst), outstanding, fifo_bursts};
}

inline const ClockDomain& memory_clock() {
  static const ClockDomain clock("memory", Hertz(100'000'000));
  return clock;
}

}  // namespace parallax::test
