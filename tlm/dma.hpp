// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <systemc>
#include <vector>

#include "tlm/bus_master.hpp"
#include "tlm/ring.hpp"
#include "tlm/stream.hpp"
#include "tlm/transfer_progress.hpp"
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

/// One transfer: rows of bytes in memory. They lie one after the other and are moved as one piece; or, with a
/// pitch, each is a piece of its own: no burst crosses its end.
struct DmaJob {
  std::uint64_t address = 0;             ///< of the first byte
  std::vector<std::uint32_t> row_bytes;  ///< length of each row
  bool values = true;                    ///< false: the traffic alone, for timing; no bytes are handed on
  std::function<void()> done;            ///< called when the last burst is answered
  std::uint64_t pitch =
      0;  ///< bytes from one row's begin to the next one's, the rows being equally long; or 0
  struct Mark {
    std::uint64_t bytes = 0;        ///< from the transfer's begin
    std::function<void()> reached;  ///< called when the bursts that hold these are answered
  };
  std::vector<Mark> marks{};  ///< ascending
  bool downwards = false;     ///< the last burst first; of one piece that is a whole number of bursts, each a
                              ///< row if it has values
  std::shared_ptr<TransferProgress> progress{};  ///< notified of each burst that is answered
  /// Of a writer: bytes may come after the date of their burst, as behind a block in kernel time whose values
  /// are worked on a row at a time. They are put into memory when they come, which must be before the last
  /// burst's date.
  bool late_values = false;
  /// For a reader that must not overtake a writer: bytes before `last_byte` of this job are requested when
  /// `needed(last_byte)` bursts of `behind` have been answered; with values, all rows that the burst touches
  /// must be in memory then.
  std::shared_ptr<TransferProgress> behind{};
  std::function<std::uint64_t(std::uint64_t last_byte)> needed{};

  std::uint64_t bytes() const;
  /// Bytes of a piece; the transfer's own where it is one piece.
  std::uint64_t piece_bytes() const;
  /// Bursts that hold the first `bytes` bytes.
  std::uint64_t bursts_until(std::uint64_t bytes, Bytes burst) const;
  /// Of the first byte of row `row`, which begins with byte `byte` of the transfer.
  std::uint64_t row_address(std::size_t row, std::uint64_t byte) const {
    return pitch == 0 ? address + byte : address + row * pitch;
  }
};

/// Bursts that a piece of `bytes` takes, the last one perhaps shorter.
std::uint64_t burst_count(std::uint64_t bytes, Bytes burst);

/// What both engines are: a queue of jobs that are cut into bursts, and requests for them. Requests are sent
/// ahead of their dates, as soon as these are known, and answers come in the present; so an engine is an
/// actor among the dataflow's, and no kernel event is spent on a request.
class DmaEngine : public sc_core::sc_module, public Actor, private BusClient {
 public:
  BusMaster master;

  /// Queues a transfer.
  void start(DmaJob job);

 protected:
  DmaEngine(const sc_core::sc_module_name& name, const DmaEngineConfig& config, const ClockDomain& clock);

  /// The next burst to request: bytes first_byte() to last_byte() - 1 of job().
  const DmaJob& job() const { return job_; }
  std::uint64_t first_byte() const { return at_; }
  std::uint64_t last_byte() const { return std::min(at_ + burst_, piece_end_); }
  std::uint64_t memory_address() const {
    return job_.downwards ? job_.address + bytes_ - last_byte() : piece_address_ + at_;
  }
  /// First cycle in which the engine itself could request it.
  Cycles free() const { return free_; }
  void not_free_before(Cycles cycle) { free_ = std::max(free_, cycle); }
  /// Bursts requested and not answered.
  std::uint64_t under_way() const { return requested_ - answered_; }
  /// `values`: it carries bytes, not traffic alone.
  ::tlm::tlm_generic_payload& take_payload(::tlm::tlm_command command, bool values);
  /// Requests the burst in `cycle`, free() at the earliest.
  void request(::tlm::tlm_generic_payload& payload, Cycles cycle);
  /// Looks at the burst again in `cycle`, if not before.
  void look_again(Cycles cycle);
  Cycles cycle_at_or_after(const sc_core::sc_time& time) const { return clock_.cycle_at_or_after(time); }
  bool has_come(Cycles cycle) const { return clock_.time_of(cycle) <= sc_core::sc_time_stamp(); }

 private:
  /// Requests the next burst if its date is known, else says to a stream what it waits for.
  virtual bool request_next() = 0;
  virtual void job_begins() {}
  /// The last request was taken in `cycle`.
  virtual void request_taken(Cycles cycle) = 0;
  /// The next burst is there in `cycle`, the present one or later.
  virtual void burst_answered(Cycles cycle) = 0;
  virtual Dataflow& dataflow() = 0;

  void advance() override;
  void taken(const sc_core::sc_time& time) override;
  void answered(const sc_core::sc_time& time, bool was_full) override;
  bool have_burst();
  void finish_jobs();

  const std::uint64_t burst_;
  const ClockDomain& clock_;
  sc_core::sc_event go_on_;
  std::deque<DmaJob> jobs_;
  DmaJob job_;                       // under way
  std::uint64_t bytes_ = 0;          // of it
  std::uint64_t at_ = 0;             // bytes of it that have been requested
  std::uint64_t piece_ = 0;          // bytes of a piece
  std::uint64_t piece_end_ = 0;      // byte of the job at which the piece under way ends
  std::uint64_t piece_address_ = 0;  // memory address less byte of the job, in this piece
  struct End {                       // of a job
    std::uint64_t answers;           // the last one's number
    std::function<void()> done;
    sc_core::sc_time time;  // of the last answer, once `answers` have come
  };
  std::deque<End> ends_;
  struct Followed {       // by each of a job's answers
    std::uint64_t first;  // its number
    std::uint64_t last;
    std::shared_ptr<TransferProgress> progress;
  };
  std::deque<Followed> followed_;
  sc_core::sc_time last_answer_;
  std::uint64_t requested_ = 0;
  std::uint64_t answered_ = 0;
  Cycles free_{0};
  Cycles request_cycle_{0};  // of the last request
  sc_core::sc_time request_time_;
  bool advancing_ = false;
};

/// Memory to stream: reads the bytes of its jobs in bursts, at most one request a cycle, as long as the FIFO
/// has a slot reserved for the answer. A token is one burst; values are the rows' bytes. Storage: the FIFO.
///
/// Values run ahead of time: a row is fetched by a functional access when its first burst is requested, so it
/// must be in memory by the start of its job, or by the date that DmaJob::behind gives.
class DmaReader final : public DmaEngine {
 public:
  StreamOut<std::uint8_t> out_bursts{"out_bursts"};

  DmaReader(const sc_core::sc_module_name& name, const DmaEngineConfig& config, const ClockDomain& clock)
      : DmaEngine(name, config, clock) {}

 private:
  bool request_next() override;
  void job_begins() override;
  void request_taken(Cycles) override {}
  void burst_answered(Cycles cycle) override;
  Dataflow& dataflow() override { return out_bursts[0]->dataflow(); }
  std::optional<Cycles> written();
  void send_rows(std::uint64_t until);

  std::size_t row_ = 0;          // of the job: the next to be handed on
  std::uint64_t row_start_ = 0;  // byte of the job
  Cycles last_write_{-1};
  struct Blocked {
    int stream = 0;  // the one that had room last
    Cycles cycles;
  };
  Ring<Blocked> blocked_;  // how long lack of room held the requests back that are under way
};

/// Stream to memory: writes the bursts it is given to the addresses of its jobs. A token is one burst; values
/// are bytes, in any pieces. Storage: the FIFO before it; a burst leaves it when the memory has taken the
/// request.
class DmaWriter final : public DmaEngine {
 public:
  StreamIn<std::uint8_t> in_bursts{"in_bursts"};

  DmaWriter(const sc_core::sc_module_name& name, const DmaEngineConfig& config, const ClockDomain& clock);

 private:
  bool request_next() override;
  void request_taken(Cycles cycle) override;
  void burst_answered(Cycles) override {}
  Dataflow& dataflow() override { return in_bursts->dataflow(); }

  void take_bytes(const std::uint8_t* bytes, std::size_t size);

  std::deque<std::uint8_t> bytes_;
  struct Late {  // a burst that was requested before its bytes had come
    std::uint64_t address;
    std::uint64_t bytes;
  };
  std::deque<Late> late_;  // theirs are the first of bytes_
  Cycles starved_;         // how long lack of a token held the last request back
};

}  // namespace parallax
