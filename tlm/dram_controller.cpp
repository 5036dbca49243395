// SPDX-License-Identifier: Apache-2.0
#include "tlm/dram_controller.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tlm/error.hpp"

namespace parallax {
namespace {

// What plan_queue() knows of a bank, as bits.
constexpr std::uint8_t kHit = 1;      // a burst of the queue wants its open row
constexpr std::uint8_t kPrepare = 2;  // the oldest who wants another row has been seen

template <class T>
const T& valid(const T& config) {
  config.validate();
  return config;
}

}  // namespace

void DramPolicy::validate() const {
  const auto require = [](const char* name, std::int64_t value, std::int64_t least, std::int64_t most) {
    if (value >= least && value <= most) return;
    throw UserError(fmt::format("memory.{} = {}: must be from {} to {}", name, value, least, most));
  };
  constexpr std::int64_t kLongest = 1024;
  require("read_queue", read_queue, 1, kLongest);
  require("write_queue", write_queue, 1, kLongest);
  require("write_high", high_watermark, 1, write_queue);
  require("write_low", low_watermark, 0, high_watermark - 1);
  require("write_batch", longest_batch, 1, kLongest);
  require("efficiency", efficiency, 1, 100);
}

DramController::DramController(const DramTiming& timing, const DramPolicy& policy)
    : timing_(valid(timing)),
      policy_(valid(policy)),
      banks_(timing.banks),
      groups_(timing.bank_groups),
      command_share_(timing.burst_clocks() * 100 * 100 / policy.efficiency),
      refresh_due_(timing.refi > 0 ? timing.refi : kNever),
      wanted_(timing.banks) {
  activates_.fill(kLongAgo);
  for (std::size_t bank = 0; bank < banks_.size(); ++bank) banks_[bank].group = bank % groups_.size();
  reads_.entries.reserve(policy.read_queue);
  writes_.entries.reserve(policy.write_queue);
}

// Adds the burst that entered last to the plan; false when that takes a new one. Only what it can do sooner
// than the plan matters: of several in one clock the older goes first.
bool DramController::plan_newest() {
  const std::size_t index = queue().entries.size() - 1;
  const Entry& entry = queue().entries[index];
  const std::uint32_t number = entry.burst.location.bank;
  Clock clock = kNever;
  const bool hit = banks_[number].open_row == std::int64_t{entry.burst.location.row};
  if (oldest_planned_) return hit;  // which can go no sooner
  if (hit) {
    if ((wanted_[number] & kPrepare) != 0) return false;  // the bank must not be closed any more
    wanted_[number] |= kHit;
    clock = column_clock(entry);
  } else {
    if (wanted_[number] != 0) return true;
    wanted_[number] = kPrepare;
    clock = row_clock(entry);
  }
  if (clock >= std::min(plan_.clock, refresh_due_)) return true;
  hit ? plan_column(clock, index) : plan_row(clock, index);
  refresh_next_ = false;
  return true;
}

void DramController::issue_until(Clock limit, std::vector<Done>& done) {
  for (plan_exactly(); plan_.clock < limit; plan_exactly()) {
    if (idle() && plan_.command == DramCommand::kRefresh && !listeners_.any()) skip_refreshes(limit);
    issue(limit, done);
  }
}

DramController::Clock DramController::next_command() {
  if (idle()) return kNever;
  plan_exactly();
  return plan_.clock;
}

void DramController::plan_anew() {
  plan_writing_ = direction();
  oldest_planned_ = plan_oldest();
  if (!oldest_planned_) plan_queue();
  refresh_next_ = plan_.clock >= refresh_due_;
  if (refresh_next_) plan_.clock = std::max(refresh_due_, command_free_);
  planned_ = true;
}

// This and columns() are inline: they happen for all bursts. The compiler would leave them out of line, which
// costs 3 % of the instructions of a frame.
inline void DramController::plan_exactly() {
  plan();
  if (refresh_next_) plan_ = plan_refresh(plan_.clock);
  refresh_next_ = false;
}

// The plan when all rows are open and may be read and written, which is simply the oldest burst's; false when
// it takes more to know.
bool DramController::plan_oldest() {
  const Queue& queue = plan_writing_ ? writes_ : reads_;
  if (groups_.size() > 1 || queue.misses != 0 || queue.bursts == 0) return false;
  const Entry& oldest = queue.entries.front();
  plan_column(column_clock(oldest), 0);
  return banks_[oldest.burst.location.bank].column < plan_.clock;
}

// The earliest command for the queue that is being served; of several in one clock the oldest burst's.
void DramController::plan_queue() {
  const std::vector<Entry>& entries = queue().entries;
  std::fill(wanted_.begin(), wanted_.end(), std::uint8_t{0});
  Clock column = kNever;
  Clock row = kNever;
  std::size_t column_entry = 0;
  std::size_t row_entry = 0;
  std::size_t hits = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const DramLocation& location = entries[i].burst.location;
    if (banks_[location.bank].open_row != std::int64_t{location.row}) continue;
    ++hits;
    if (wanted_[location.bank] != 0) continue;  // an older burst for the same row can go as soon
    wanted_[location.bank] = kHit;
    if (const Clock clock = column_clock(entries[i]); clock < column) {
      column = clock;
      column_entry = i;
    }
  }
  queue().misses = entries.size() - hits;
  for (std::size_t i = 0; i < entries.size() && hits < entries.size(); ++i) {
    std::uint8_t& wanted = wanted_[entries[i].burst.location.bank];
    if (wanted != 0) continue;  // its row is wanted, or an older burst prepares it
    wanted = kPrepare;
    if (const Clock clock = row_clock(entries[i]); clock < row) {
      row = clock;
      row_entry = i;
    }
  }
  if (column != row ? column < row : column_entry < row_entry) {
    plan_column(column, column_entry);
  } else {
    plan_row(row, row_entry);
  }
}

// When a burst whose row is open can be read or written.
DramController::Clock DramController::column_clock(const Entry& entry) const {
  // What could have been done before the last change has been done, or the direction was another.
  return std::max({command_free_, changed_ + 1, column_ready(entry.burst)});
}

// When the row of a burst can be opened, or the one that is open instead closed.
DramController::Clock DramController::row_clock(const Entry& entry) const {
  const std::uint32_t number = entry.burst.location.bank;
  const Bank& bank = banks_[number];
  return std::max({command_free_, changed_ + 1, bank.open_row < 0 ? activate_ready(number) : bank.precharge});
}

void DramController::plan_column(Clock clock, std::size_t entry) {
  plan_.clock = clock;
  plan_.command = plan_writing_ ? DramCommand::kWrite : DramCommand::kRead;
  plan_.entry = entry;
}

void DramController::plan_row(Clock clock, std::size_t entry) {
  plan_.clock = clock;
  plan_.entry = entry;
  if (clock == kNever) return;  // there is none
  const Bank& bank = banks_[queue().entries[entry].burst.location.bank];
  plan_.command = bank.open_row < 0 ? DramCommand::kActivate : DramCommand::kPrecharge;
}

DramController::Plan DramController::plan_refresh(Clock at) const {
  Clock closed = std::max(at, refresh_free_);
  Clock open = -1;
  for (const Bank& bank : banks_) {
    closed = std::max(closed, bank.activate);
    if (bank.open_row >= 0) open = std::max(open, bank.precharge);
  }
  if (open >= 0) return {std::max(at, open), DramCommand::kPrechargeAll, 0};
  return {closed, DramCommand::kRefresh, 0};
}

DramController::Clock DramController::column_ready(const Burst& burst) const {
  const Bank& bank = banks_[burst.location.bank];
  const Free& group = groups_[bank.group];
  const Clock others = burst.write ? std::max(any_.write, group.write) : std::max(any_.read, group.read);
  return std::max({bank.column, column_free_, others});
}

DramController::Clock DramController::activate_ready(std::uint32_t number) const {
  const Bank& bank = banks_[number];
  return std::max({bank.activate, any_.activate, groups_[bank.group].activate,
                   activates_[oldest_activate_] + timing_.faw});
}

void DramController::issue(Clock limit, std::vector<Done>& done) {
  turn(plan_writing_);
  if (plan_.command == DramCommand::kRead || plan_.command == DramCommand::kWrite) {
    Queue& from = queue();
    Entry& entry = from.entries[plan_.entry];
    const std::size_t number =
        columns(plan_.clock, entry.burst, longest_train(), std::min(limit, refresh_due_), done);
    from.bursts -= number;
    entry.bursts -= number;
    if (entry.bursts == 0) from.entries.erase(from.entries.begin() + plan_.entry);
    if (plan_writing_) {
      if (reads_.bursts != 0) batch_ += number;
    } else {
      reads_first_ -= std::min(reads_first_, number);
    }
  } else {
    issue_row(plan_);
    changed_ = plan_.clock;
    command_free_ = plan_.clock + 1;
  }
  planned_ = false;
}

// How many bursts of the planned one's entry are the next ones for sure, unless something enters or a refresh
// is due: of the oldest entry, where all rows are open, until the direction changes.
std::size_t DramController::longest_train() const {
  const Queue& from = plan_writing_ ? writes_ : reads_;
  if (groups_.size() > 1 || from.misses != 0 || plan_.entry != 0) return 1;
  std::size_t most = from.entries.front().bursts;
  if (plan_writing_ && reads_.bursts != 0)
    most = std::min({most, writes_.bursts - policy_.low_watermark, policy_.longest_batch - batch_});
  if (!plan_writing_ && writes_.bursts >= policy_.high_watermark) most = std::min(most, reads_first_);
  return most;
}

// A command that is no read or write.
void DramController::issue_row(const Plan& plan) {
  if (plan.command == DramCommand::kRefresh || plan.command == DramCommand::kPrechargeAll) {
    notify(plan.clock, plan.command, {});
    if (plan.command == DramCommand::kRefresh) return refresh(plan.clock);
    ++statistics_.precharges;
    for (Bank& bank : banks_) {
      if (bank.open_row >= 0) precharge(plan.clock, bank);
    }
    refresh_free_ = plan.clock + timing_.rp_all;
    return;
  }
  const DramLocation location = queue().entries[plan.entry].burst.location;
  notify(plan.clock, plan.command, location);
  if (plan.command == DramCommand::kActivate) return activate(plan.clock, location);
  ++statistics_.precharges;
  precharge(plan.clock, banks_[location.bank]);
}

void DramController::activate(Clock at, const DramLocation& location) {
  ++statistics_.activates;
  rows_change();
  Bank& bank = banks_[location.bank];
  bank.open_row = location.row;
  bank.column = at + timing_.rcd;
  bank.activate = at + timing_.rc;
  bank.precharge = at + timing_.ras;
  any_.activate = at + timing_.rrd;
  groups_[bank.group].activate = at + timing_.rrd_group;
  activates_[oldest_activate_] = at;
  oldest_activate_ = (oldest_activate_ + 1) % activates_.size();
}

void DramController::precharge(Clock at, Bank& bank) {
  rows_change();
  bank.open_row = -1;
  bank.activate = std::max(bank.activate, at + timing_.rp);
}

// Reads or writes bursts of an open row, each as soon as it can go, the first in clock `at`: at most `most`,
// those after the first before `limit`. Returns how many.
inline std::size_t DramController::columns(Clock at, const Burst& burst, std::size_t most, Clock limit,
                                           std::vector<Done>& done) {
  const DramCommand command = burst.write ? DramCommand::kWrite : DramCommand::kRead;
  const Clock until_data = (burst.write ? timing_.cwl : timing_.cl) + timing_.burst_clocks();
  const Clock pace = std::max(timing_.ccd, timing_.ccd_group);
  std::size_t number = 0;
  Clock next = at;
  do {
    at = next;
    notify(at, command, burst.location);
    done.emplace_back(burst.tag, burst.write, at + until_data);
    lose_time(at, column_free_, lost_);
    next = std::max(at + pace, column_free_);
  } while (++number < most && next < limit);

  Bank& bank = banks_[burst.location.bank];
  Free& group = groups_[bank.group];
  const Clock data = at + until_data;
  const auto not_before = [](Clock& free, Clock clock) { free = std::max(free, clock); };
  if (statistics_.reads + statistics_.writes > 0 && burst.write != last_was_write_)
    ++statistics_.turn_arounds;
  last_was_write_ = burst.write;
  if (burst.write) {
    statistics_.writes += number;
    any_.write = at + timing_.ccd;
    group.write = at + timing_.ccd_group;
    not_before(any_.read, data + timing_.wtr);
    not_before(group.read, data + timing_.wtr_group);
    not_before(bank.precharge, data + timing_.wr);
  } else {
    statistics_.reads += number;
    any_.read = at + timing_.ccd;
    group.read = at + timing_.ccd_group;
    not_before(any_.write, at + timing_.rtw);
    not_before(bank.precharge, at + timing_.rtp);
  }
  changed_ = at;
  command_free_ = at + 1;
  return number;
}

// What the efficiency takes from the time after a column command.
void DramController::lose_time(Clock at, Clock& column_free, std::int64_t& lost) const {
  if (policy_.efficiency == 100) return;
  lost += command_share_;
  column_free = std::max(column_free, at) + lost / 100;
  lost %= 100;
}

bool DramController::serve_alone(const Burst& burst, std::uint64_t number, Clock clock, Clock limit,
                                 std::vector<Done>& done) {
  limit = std::min(limit, refresh_due_);
  const std::size_t slots = burst.write ? policy_.write_queue : policy_.read_queue;
  if (!idle() || number > slots || command_free_ >= limit) return false;
  // The dates, by the same rules as those of the queue, for one bank and one row.
  const Bank& bank = banks_[burst.location.bank];
  Clock next = std::max(command_free_, clock + 1);
  Clock close = -1;
  Clock open = -1;
  Clock column_at = column_ready(burst);
  if (bank.open_row != std::int64_t{burst.location.row}) {
    Clock ready = activate_ready(burst.location.bank);
    if (bank.open_row >= 0) {
      close = std::max(next, bank.precharge);
      next = close + 1;
      ready = std::max(ready, close + timing_.rp);
    }
    open = std::max(next, ready);
    next = open + 1;
    column_at = std::max(column_at, open + timing_.rcd);
  }
  const Clock pace = std::max(timing_.ccd, timing_.ccd_group);
  const Clock first = std::max({next, column_at, column_free_, clock + 1});
  Clock last = first;
  Clock column_free = column_free_;
  std::int64_t lost = lost_;
  for (std::uint64_t i = 1; i < number; ++i) {  // which entered long before, one a clock
    lose_time(last, column_free, lost);
    last = std::max(last + pace, column_free);
  }
  if (last >= limit) return false;
  if (close >= 0) {
    notify(close, DramCommand::kPrecharge, burst.location);
    ++statistics_.precharges;
    precharge(close, banks_[burst.location.bank]);
  }
  if (open >= 0) {
    notify(open, DramCommand::kActivate, burst.location);
    activate(open, burst.location);
  }
  columns(first, burst, number, limit, done);
  turn(burst.write);
  planned_ = false;
  return true;
}

// With nothing to do and all rows closed, refreshes follow each other like one another: all but the last
// before `limit` at once.
void DramController::skip_refreshes(Clock limit) {
  if (plan_.clock != refresh_due_) return;
  const Clock refreshes = (limit - 1 - plan_.clock) / timing_.refi;
  statistics_.refreshes += refreshes;
  refresh_due_ += refreshes * timing_.refi;
  plan_.clock = refresh_due_;
}

void DramController::refresh(Clock at) {
  ++statistics_.refreshes;
  for (Bank& bank : banks_) bank.activate = at + timing_.rfc;
  refresh_due_ += timing_.refi;
}

}  // namespace parallax
