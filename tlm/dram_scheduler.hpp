// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tlm/dram_address.hpp"
#include "tlm/dram_controller.hpp"
#include "tlm/memory_scheduler.hpp"
#include "tlm/ratio.hpp"
#include "tlm/ring.hpp"

namespace parallax {

/// A DRAM controller with its devices, behind an interconnect.
struct DramMemory {
  DramTiming timing;
  DramPolicy policy;
  DramMapping mapping = DramMapping::kRowBankColumn;
  std::int64_t latency = 0;  ///< DRAM clocks that ports, interconnect and PHY add to an answer
  MemoryArbitration arbitration = MemoryArbitration::kRoundRobin;
};

/// Requests are cut into the devices' bursts, of which one enters the controller in a clock. The arbiter
/// gives a request the way into the controller until all its bursts are in, or until the controller's queue
/// for its direction is full while another port has something for the other one. The request's slot at the
/// port is free in the clock after its last burst has entered.
///
/// A write is posted: it is answered `latency` clocks after the clock in which its last burst entered. A read
/// is answered `latency` clocks after the last beat of its last burst, and not before the reads that its port
/// asked for earlier.
class DramScheduler final : public MemoryScheduler {
 public:
  explicit DramScheduler(const DramMemory& memory);

  void bind(MemoryQueues& queues) override;
  void serve_until(Picoseconds date, bool inclusive, MemoryService& service) override;
  Picoseconds next_answer() override;
  Picoseconds next_slot() override;

  Cycles bus_taken(std::size_t port, Picoseconds date) override;
  Cycles at_work(Picoseconds date) override;
  Cycles cycle_at_or_after(Picoseconds date) const override { return Cycles(clock_at_or_after(date)); }
  double seconds(Cycles cycles) const override {
    return cycles.real() * static_cast<double>(memory_.timing.clock_period_ps) * 1e-12;
  }
  double usable_bandwidth() const override;

  const DramStatistics* commands() const override { return &controller_.statistics(); }

 private:
  using Clock = DramController::Clock;
  struct Read {  // in the controller
    MemoryRequest request;
    std::uint64_t bursts_left = 0;  // whose last beat is not known
    Clock end = 0;                  // of the last beat so far
  };
  struct PortBursts {
    std::uint64_t bursts_left = 0;  // of the head of the queue when it is on its way in
    std::uint64_t next = 0;         // address of its next burst,
    DramLocation location;          // where that lies,
    std::uint64_t in_row = 0;       // and how many from there on lie in that row; 0: to be looked up
    bool write = false;             // it is a write
    std::uint64_t first_read = 0;   // number of the oldest in `reads`
    Ring<Read> reads;               // in order
    Cycles bus;                     // that has passed
  };
  static constexpr std::size_t kBeats = 1024;  // stored before they are counted
  struct Beats {                               // on the data bus, not passed yet, without a pause
    Clock begin;
    Clock end;
    std::size_t port;
  };

  Clock clock_at_or_after(Picoseconds date) const { return static_cast<Clock>(rate_.ceil(date.size())); }
  Picoseconds date_of(Clock clock) const { return Picoseconds(clock * period_); }
  void enter_until(Clock limit, MemoryService& service);
  bool choose(Clock clock);
  bool can_enter(std::size_t port, Clock clock) const;
  void enter(std::size_t port, Clock limit, MemoryService& service);
  std::uint64_t bursts_of(const ::tlm::tlm_generic_payload& payload) const;
  bool serve_alone(std::size_t port, Clock limit, MemoryService& service);
  void begins_work(Clock clock);
  // Keeps what is known of the first request of a port's queue up to date.
  void look_at_head(std::size_t port) {
    const Picoseconds date = queues_->arrivals()[port];
    if (date == arrival_dates_[port]) return;
    arrival_dates_[port] = date;
    arrivals_[port] = date == MemoryQueues::kNever ? DramController::kNever : clock_at_or_after(date);
  }
  void look_at_heads();
  Clock next_change(Clock clock);
  void run_controller(Clock limit, MemoryService& service) {
    controller_.run_until(limit, done_);
    if (!done_.empty()) take_done(service);
  }
  void take_done(MemoryService& service);
  void add_beats(Clock end, std::size_t port);
  void keep_last_beats();
  void count_beats(Clock clock);
  Clock next_entry() const;
  Clock last_entry(std::size_t port);
  Clock entry_bound();

  const DramMemory memory_;
  const std::int64_t period_;  // ps
  const Ratio rate_;           // clocks a ps
  const std::uint64_t burst_bytes_;
  const Clock burst_clocks_;
  const DramAddress address_;
  DramController controller_;
  MemoryQueues* queues_ = nullptr;
  std::vector<PortBursts> ports_;
  // By port, of the first request that waits: its arrival, kNever without one, as date and as clock.
  std::vector<Picoseconds> arrival_dates_;
  std::vector<Clock> arrivals_;
  std::size_t current_ = 0;  // whose turn it is, or was
  Clock next_ = 0;           // in which the next burst may enter
  Clock decided_ = 0;        // all clocks before are decided
  std::vector<DramController::Done> done_;
  Ring<Beats> beats_;  // but for the last ones:
  Beats last_beats_{0, 0, 0};
  std::size_t reads_ = 0;  // in the controller or on their way in
  Clock work_ = 0;         // clocks at work, of periods that are over
  Clock work_begin_ = 0;   // of the last period
  Clock work_end_ = 0;     // likewise, as far as it is known
};

}  // namespace parallax
