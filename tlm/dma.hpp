// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <systemc>
#include <vector>

#include "tlm/bus_master.hpp"
#include "tlm/stream.hpp"
#include "tlm/units.hpp"

namespace parallax {

struct DmaEngineConfig {
  Bytes burst{128};               ///< of a full burst
  std::uint32_t outstanding = 4;  ///< requests on the way at once
  std::uint32_t fifo_bursts = 8;  ///< bursts that the engine's FIFO holds

  /// The FIFO, as the stream between the engine and what packs or unpacks bursts.
  FifoConfig fifo() const {
    FifoConfig config;
    config.depth = fifo_bursts;
    config.width = Bits(burst.count() * 8);
    config.kind = FifoKind::kRegistered;
    config.at_memory = true;
    return config;
  }
};

/// One transfer: rows of bytes that lie one after the other in memory.
struct DmaJob {
  std::uint64_t address = 0;             ///< of the first byte
  std::vector<std::uint32_t> row_bytes;  ///< length of each row
  bool values = true;                    ///< false: the traffic alone, for timing; no bytes are handed on
  std::function<void()> done;            ///< called when the last burst is answered

  std::uint64_t bytes() const;
};

/// Bursts that a transfer of `bytes` takes, the last one perhaps shorter.
std::uint64_t burst_count(std::uint64_t bytes, Bytes burst);

/// Memory to stream: reads the bytes of its jobs in bursts, at most one request a cycle, as long as the FIFO
/// has a place reserved for the answer. A token is one burst; values are the rows' bytes. Storage: the FIFO.
///
/// Values run ahead of time: a row is fetched by a functional access when its first burst is requested, so it
/// must be in memory by then.
class DmaReader final : public sc_core::sc_module {
 public:
  StreamOut<std::uint8_t> out_bursts{"out_bursts"};
  BusMaster master;

  DmaReader(const sc_core::sc_module_name& name, const DmaEngineConfig& config, const ClockDomain& clock);

  /// Queues a transfer.
  void start(DmaJob job);

 private:
  void run();
  void send_rows(std::size_t& row, std::uint64_t& row_start, std::uint64_t until);
  void arrived();

  const DmaEngineConfig config_;
  const ClockDomain& clock_;
  std::deque<DmaJob> jobs_;
  DmaJob job_;  // under way; a member, because a thread that never ends frees nothing
  sc_core::sc_event started_;
  std::deque<std::pair<std::uint64_t, std::function<void()>>>
      ends_;  // answers until a job is done, its callback
  std::uint64_t requested_ = 0;
  std::uint64_t answered_ = 0;
};

/// Stream to memory: writes the bursts it is given to the addresses of its jobs. A token is one burst; values
/// are bytes, in any pieces. Storage: the FIFO before it; a burst leaves it when the memory has taken the
/// request.
class DmaWriter final : public sc_core::sc_module {
 public:
  StreamIn<std::uint8_t> in_bursts{"in_bursts"};
  BusMaster master;

  DmaWriter(const sc_core::sc_module_name& name, const DmaEngineConfig& config, const ClockDomain& clock);

  /// Queues a transfer.
  void start(DmaJob job);

 private:
  void run();

  const DmaEngineConfig config_;
  const ClockDomain& clock_;
  std::deque<DmaJob> jobs_;
  DmaJob job_;  // under way; a member, because a thread that never ends frees nothing
  sc_core::sc_event started_;
  std::deque<std::uint8_t> bytes_;
  std::deque<std::pair<std::uint64_t, std::function<void()>>> ends_;
  std::uint64_t requested_ = 0;
  std::uint64_t answered_ = 0;
};

}  // namespace parallax
