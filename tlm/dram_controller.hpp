// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "tlm/dram_address.hpp"
#include "tlm/dram_timing.hpp"
#include "tlm/listeners.hpp"

namespace parallax {

/// What the controller decides, beside the devices' own timing.
struct DramPolicy {
  std::size_t read_queue = 32;      ///< bursts, 1 to 1024
  std::size_t write_queue = 32;     ///< bursts, 1 to 1024
  std::size_t high_watermark = 26;  ///< writes queued at which a batch of them begins, at most write_queue
  std::size_t low_watermark = 6;    ///< writes queued at which it ends when reads wait, below high_watermark
  std::size_t longest_batch =
      64;                         ///< writes, 1 to 1024, that go while reads wait; then reads have their turn
  std::int64_t efficiency = 100;  ///< percent of the time that column commands may take, 1 to 100: what a
                                  ///< real controller loses beyond the devices' timing

  /// Throws UserError when a value is out of its range.
  void validate() const;
};

enum class DramCommand : std::uint8_t { kActivate, kPrecharge, kPrechargeAll, kRead, kWrite, kRefresh };

/// Counts since the beginning.
struct DramStatistics {
  std::uint64_t reads = 0;   ///< bursts
  std::uint64_t writes = 0;  ///< bursts
  std::uint64_t activates = 0;
  std::uint64_t precharges = 0;  ///< of one bank or of all
  std::uint64_t refreshes = 0;
  std::uint64_t turn_arounds = 0;  ///< changes between reading and writing, on the data bus
};

/// Sees every command, in order: for tests and traces.
class DramListener {
 public:
  virtual ~DramListener() = default;
  virtual void command(std::int64_t clock, DramCommand command, std::uint32_t bank, std::uint32_t row) = 0;
};

/// A DRAM controller with its rank of devices: open page, first-ready first-come-first-served, writes in
/// batches, refresh of all banks when it is due. One command a clock; a burst that enters in clock n can
/// cause its first command in n + 1.
///
/// Of the queue that is being served (reads, or a batch of writes) goes first what can go first: a read or
/// write of an open row, an activate, a precharge; of several in one clock that of the oldest burst. A row is
/// closed only when nothing in that queue wants it, so row hits go before conflicts. When a refresh is due
/// nothing else begins until it is done. A batch of writes begins at the high watermark, or when no read
/// waits, and ends at the low one if reads wait. Where writes come as fast as they are written it would not
/// get there: after `longest_batch` writes that reads had to wait for it ends too, and as many of the reads
/// that wait then go before another begins.
///
/// Plain C++ in clocks. It decides nothing beyond what its caller says is known (run_until), and steps from
/// command to command, so idle time costs nothing.
class DramController {
 public:
  using Clock = std::int64_t;
  static constexpr Clock kNever = std::numeric_limits<Clock>::max();

  struct Burst {
    DramLocation location;
    std::uint64_t tag = 0;
    bool write = false;
  };
  struct Done {
    std::uint64_t tag;
    bool write;
    Clock data_end;  ///< clock in which the last beat is over

    Done(std::uint64_t of, bool is_write, Clock end) : tag(of), write(is_write), data_end(end) {}
  };

  DramController(const DramTiming& timing, const DramPolicy& policy);

  /// Whether the queue has a slot for another one.
  bool room(bool write) const { return room_for(write) != 0; }
  /// For how many more it has slots.
  std::size_t room_for(bool write) const {
    return write ? policy_.write_queue - writes_.bursts : policy_.read_queue - reads_.bursts;
  }
  /// Takes a burst in clock `clock`; needs room, and run_until(clock + 1) before, so that what happens in
  /// that clock is not caused by it.
  void submit(const Burst& burst, Clock clock) {
    Queue& queue = burst.write ? writes_ : reads_;
    if (!queue.entries.empty() && queue.entries.back().joins(burst)) return join(burst, 1, clock);
    changed_ = clock;
    ++queue.bursts;
    queue.entries.emplace_back(burst);
    if (queue.misses >= 0 && banks_[burst.location.bank].open_row != std::int64_t{burst.location.row})
      ++queue.misses;
    planned_ = planned_ && direction() == plan_writing_ && (burst.write != plan_writing_ || plan_newest());
  }
  /// Takes `number` bursts like `burst`, one a clock from `clock` on; needs that many of may_join(), and else
  /// what submit() needs.
  void join(const Burst& burst, std::size_t number, Clock clock) {
    Queue& queue = burst.write ? writes_ : reads_;
    changed_ = clock + static_cast<Clock>(number) - 1;
    queue.bursts += number;
    queue.entries.back().bursts += number;  // which can go no sooner than those before
    planned_ = planned_ && direction() == plan_writing_;
  }
  /// How many bursts like `burst` may join() the one that entered last, from `clock` on: those that enter
  /// before anything else is decided. Needs run_until(clock + 1) before.
  std::size_t may_join(const Burst& burst, Clock clock) const {
    const Queue& queue = burst.write ? writes_ : reads_;
    if (queue.entries.empty() || !queue.entries.back().joins(burst)) return 0;
    std::size_t most = room_for(burst.write);
    if (writing_ != plan_writing_) most = 1;  // the direction turns in the clock after
    if (plan_.clock != kNever) most = std::min(most, static_cast<std::size_t>(plan_.clock - clock));
    if (burst.write && queue.bursts < policy_.high_watermark)
      most = std::min(most, policy_.high_watermark - queue.bursts);  // with the last of which a batch begins
    return most;
  }
  /// Takes `number` bursts of one row that enter one a clock from `clock` on, and issues all that they cause,
  /// provided that the last command of it comes before `limit`, no refresh falls between, and the controller
  /// is idle; else does nothing and returns false. It is what submit() and run_until() do, sooner done. Needs
  /// run_until(clock + 1) before, and that nothing else enters in a clock before that of the last command.
  bool serve_alone(const Burst& burst, std::uint64_t number, Clock clock, Clock limit,
                   std::vector<Done>& done);
  /// Issues all commands before clock `limit`; appends the bursts whose command that was, in order.
  void run_until(Clock limit, std::vector<Done>& done) {
    plan();
    if (plan_.clock < limit) issue_until(limit, done);
    // A direction is chosen in the clock after a queue has changed, when all that entered with the change is
    // known.
    if (changed_ + 1 < limit) turn(plan_writing_);
  }
  /// Clock of the next command if nothing else arrives; kNever when it waits for nothing but refreshes.
  Clock next_command();
  /// Clocks from one read or write to the next, at least.
  Clock least_pace() const { return std::max(timing_.ccd, command_share_ / 100); }
  bool idle() const { return reads_.bursts + writes_.bursts == 0; }

  const DramStatistics& statistics() const { return statistics_; }
  const DramTiming& timing() const { return timing_; }
  /// One more listener, or one less (Listeners).
  void add_listener(DramListener& listener) { listeners_.add(listener); }
  void remove_listener(DramListener& listener) { listeners_.remove(listener); }

 private:
  struct Entry {  // bursts of one row with one tag, one after the other
    Burst burst;
    std::size_t bursts = 1;

    explicit Entry(const Burst& first) {
      burst.location.bank = first.location.bank;
      burst.location.row = first.location.row;
      burst.tag = first.tag;
      burst.write = first.write;
    }
    bool joins(const Burst& next) const {
      return burst.tag == next.tag && burst.location.bank == next.location.bank &&
             burst.location.row == next.location.row;
    }
  };
  struct Queue {
    std::vector<Entry> entries;  // by age
    std::size_t bursts = 0;
    std::int64_t misses = 0;  // entries whose row is not open; -1: to be counted
  };
  struct Bank {
    std::size_t group = 0;
    std::int64_t open_row = -1;
    Clock column = 0;     // earliest read or write of the open row
    Clock activate = 0;   // earliest
    Clock precharge = 0;  // earliest
  };
  struct Free {  // earliest clock of a command that other banks allow
    Clock read = kLongAgo;
    Clock write = kLongAgo;
    Clock activate = kLongAgo;
  };
  struct Plan {
    Clock clock = kNever;
    DramCommand command = DramCommand::kRefresh;
    std::size_t entry = 0;
  };
  static constexpr Clock kLongAgo = -(1ll << 40);

  Queue& queue() { return plan_writing_ ? writes_ : reads_; }
  bool direction() const {
    const bool only_writes = reads_.bursts == 0 && writes_.bursts != 0;
    if (only_writes) return true;
    return writing_ ? writes_.bursts > policy_.low_watermark && batch_ < policy_.longest_batch
                    : writes_.bursts >= policy_.high_watermark && reads_first_ == 0;
  }
  // A batch of writes begins or ends.
  void turn(bool writing) {
    if (writing == writing_) return;
    writing_ = writing;
    reads_first_ =
        !writing && batch_ >= policy_.longest_batch ? std::min(reads_.bursts, policy_.longest_batch) : 0;
    batch_ = 0;
  }
  void plan_queue();
  bool plan_oldest();
  void rows_change() { reads_.misses = writes_.misses = -1; }
  bool plan_newest();
  Clock column_clock(const Entry& entry) const;
  Clock row_clock(const Entry& entry) const;
  void plan_column(Clock clock, std::size_t entry);
  void plan_row(Clock clock, std::size_t entry);
  Plan plan_refresh(Clock at) const;
  void plan() {
    if (!planned_) plan_anew();
  }
  void plan_anew();
  void plan_exactly();
  void issue_until(Clock limit, std::vector<Done>& done);
  void issue(Clock limit, std::vector<Done>& done);
  void issue_row(const Plan& plan);
  void notify(Clock at, DramCommand command, const DramLocation& location) const {
    for (DramListener* listener : listeners_) listener->command(at, command, location.bank, location.row);
  }
  void activate(Clock at, const DramLocation& location);
  void precharge(Clock at, Bank& bank);
  std::size_t longest_train() const;
  std::size_t columns(Clock at, const Burst& burst, std::size_t most, Clock limit, std::vector<Done>& done);
  void lose_time(Clock at, Clock& column_free, std::int64_t& lost) const;
  void skip_refreshes(Clock limit);
  void refresh(Clock at);
  Clock column_ready(const Burst& burst) const;
  Clock activate_ready(std::uint32_t bank) const;

  const DramTiming timing_;
  const DramPolicy policy_;
  Queue reads_;
  Queue writes_;
  bool writing_ = false;         // whether a batch of writes is under way
  std::size_t batch_ = 0;        // writes of it that went while reads waited
  std::size_t reads_first_ = 0;  // reads that go before the next batch
  std::vector<Bank> banks_;
  std::vector<Free> groups_;          // what each bank group allows,
  Free any_;                          // and all of them
  std::array<Clock, 4> activates_{};  // the last four, in a ring
  std::size_t oldest_activate_ = 0;
  Clock command_free_ = 0;            // next clock without a command
  const std::int64_t command_share_;  // hundredths of a clock that the efficiency makes of a column command
  Clock column_free_ = 0;             // when the efficiency allows the next column command
  std::int64_t lost_ = 0;             // hundredths of a clock, below one
  Clock refresh_due_;
  Clock refresh_free_ = 0;  // after the precharge of all banks
  bool last_was_write_ = false;
  Plan plan_;
  bool refresh_next_ =
      false;  // the plan is a refresh or what it takes; its clock is not exact, but not before
  bool plan_writing_ = false;  // from the queue of writes
  Clock changed_ = -1;         // last clock in which a queue changed, or a command was issued
  bool planned_ = false;
  std::vector<std::uint8_t> wanted_;  // per bank: how plan_queue() has seen it
  bool oldest_planned_ = false;       // by plan_oldest()
  DramStatistics statistics_;
  Listeners<DramListener> listeners_;
};

}  // namespace parallax
