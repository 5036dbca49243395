// SPDX-License-Identifier: Apache-2.0
#include "tlm/dram_controller.hpp"

#include <algorithm>

namespace parallax {
namespace {

// What plan_queue() knows of a bank, as bits.
constexpr std::uint8_t kHit = 1;      // somebody wants its open row
constexpr std::uint8_t kPrepare = 2;  // the oldest who wants another row has been seen

}  // namespace

DramController::DramController(const DramTiming& timing, const DramPolicy& policy)
    : timing_(timing),
      policy_(policy),
      banks_(static_cast<std::size_t>(timing.banks)),
      groups_(static_cast<std::size_t>(timing.bank_groups)),
      refresh_due_(timing.refi > 0 ? timing.refi : kNever),
      wanted_(static_cast<std::size_t>(timing.banks)) {
  activates_.fill(kLongAgo);
  reads_.reserve(policy.read_queue);
  writes_.reserve(policy.write_queue);
}

void DramController::submit(const Burst& burst, Clock clock) {
  (burst.write ? writes_ : reads_).push_back({burst, clock});
  changed_ = clock;
  planned_ = planned_ && direction() == plan_writing_ && (burst.write != plan_writing_ || plan_newest());
}

// Adds the burst that entered last to the plan; false when that takes a new one. Only what it can do sooner
// than the plan matters: of several in one clock the older goes first.
bool DramController::plan_newest() {
  const std::size_t index = queue().size() - 1;
  const Entry& entry = queue()[index];
  const std::uint32_t number = entry.burst.place.bank;
  Plan newest;
  if (banks_[number].open_row == std::int64_t{entry.burst.place.row}) {
    if ((wanted_[number] & kPrepare) != 0) return false;  // the bank must not be closed any more
    wanted_[number] |= kHit;
    newest = plan_column(entry, index);
  } else {
    if (wanted_[number] != 0) return true;
    wanted_[number] = kPrepare;
    newest = plan_row(entry, index);
  }
  if (newest.clock < std::min(plan_.clock, refresh_due_)) plan_ = newest;
  return true;
}

void DramController::run_until(Clock limit, std::vector<Done>& done) {
  for (plan(); plan_.clock < limit; plan()) issue(done);
  // A direction is chosen in the clock after a queue has changed, when all that entered with the change is
  // known.
  if (changed_ + 1 < limit) writing_ = plan_writing_;
}

DramController::Clock DramController::next_command() {
  plan();
  return idle() ? kNever : plan_.clock;
}

bool DramController::direction() const {
  if (!writing_) return writes_.size() >= policy_.high_watermark || (reads_.empty() && !writes_.empty());
  return !writes_.empty() && (writes_.size() > policy_.low_watermark || reads_.empty());
}

void DramController::plan() {
  if (planned_) return;
  plan_writing_ = direction();
  plan_ = plan_queue();
  if (plan_.clock >= refresh_due_) plan_ = plan_refresh(std::max(refresh_due_, command_free_));
  planned_ = true;
}

// The earliest command for the queue that is being served; of several in one clock the oldest burst's.
DramController::Plan DramController::plan_queue() {
  Plan column;
  Plan row;
  const std::vector<Entry>& entries = queue();
  std::fill(wanted_.begin(), wanted_.end(), std::uint8_t{0});
  std::size_t hits = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const DramPlace& place = entries[i].burst.place;
    if (banks_[place.bank].open_row != std::int64_t{place.row}) continue;
    ++hits;
    if (wanted_[place.bank] != 0) continue;  // an older burst for the same row can go as soon
    wanted_[place.bank] = kHit;
    const Plan plan = plan_column(entries[i], i);
    if (plan.clock < column.clock) column = plan;
  }
  for (std::size_t i = 0; i < entries.size() && hits < entries.size(); ++i) {
    std::uint8_t& wanted = wanted_[entries[i].burst.place.bank];
    if (wanted != 0) continue;  // its row is wanted, or an older burst prepares it
    wanted = kPrepare;
    const Plan plan = plan_row(entries[i], i);
    if (plan.clock < row.clock) row = plan;
  }
  if (column.clock != row.clock) return column.clock < row.clock ? column : row;
  return column.entry < row.entry ? column : row;
}

// What could have been done before the last change has been done, or the direction was another.
DramController::Clock DramController::earliest(const Entry& entry) const {
  return std::max({command_free_, changed_ + 1, entry.entered + 1});
}

// The read or write of a burst whose row is open.
DramController::Plan DramController::plan_column(const Entry& entry, std::size_t index) const {
  const Clock ready = std::max(earliest(entry), column_ready(entry));
  return {ready, entry.burst.write ? DramCommand::kWrite : DramCommand::kRead, index};
}

// What opens the row of a burst, or closes the one in its place.
DramController::Plan DramController::plan_row(const Entry& entry, std::size_t index) const {
  const std::uint32_t number = entry.burst.place.bank;
  const Bank& bank = banks_[number];
  const bool closed = bank.open_row < 0;
  const Clock ready = std::max(earliest(entry), closed ? activate_ready(number) : bank.precharge);
  return {ready, closed ? DramCommand::kActivate : DramCommand::kPrecharge, index};
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

DramController::Clock DramController::column_ready(const Entry& entry) const {
  const std::uint32_t bank = entry.burst.place.bank;
  const Group& group = groups_[group_of(bank)];
  const Clock ready = std::max(banks_[bank].column, column_free_);
  if (entry.burst.write) {
    return std::max({ready, any_.last_write + timing_.ccd, group.last_write + timing_.ccd_group,
                     any_.last_read + timing_.rtw});
  }
  const Clock written = timing_.cwl + timing_.burst_clocks();
  return std::max({ready, any_.last_read + timing_.ccd, group.last_read + timing_.ccd_group,
                   any_.last_write + written + timing_.wtr, group.last_write + written + timing_.wtr_group});
}

DramController::Clock DramController::activate_ready(std::uint32_t bank) const {
  return std::max({banks_[bank].activate, any_.last_activate + timing_.rrd,
                   groups_[group_of(bank)].last_activate + timing_.rrd_group,
                   activates_[oldest_activate_] + timing_.faw});
}

void DramController::issue(std::vector<Done>& done) {
  const Plan plan = plan_;
  writing_ = plan_writing_;
  changed_ = plan.clock;
  const DramPlace place = plan.command == DramCommand::kRefresh || plan.command == DramCommand::kPrechargeAll
                              ? DramPlace{}
                              : queue()[plan.entry].burst.place;
  if (listener_ != nullptr) listener_->command(plan.clock, plan.command, place.bank, place.row);
  switch (plan.command) {
    case DramCommand::kActivate:
      activate(plan.clock, place);
      break;
    case DramCommand::kPrecharge:
      ++statistics_.precharges;
      precharge(plan.clock, banks_[place.bank]);
      break;
    case DramCommand::kPrechargeAll:
      ++statistics_.precharges;
      for (Bank& bank : banks_) {
        if (bank.open_row >= 0) precharge(plan.clock, bank);
      }
      refresh_free_ = plan.clock + timing_.rp_all;
      break;
    case DramCommand::kRead:
    case DramCommand::kWrite:
      column(plan.clock, plan.entry, done);
      break;
    case DramCommand::kRefresh:
      refresh(plan.clock);
      break;
  }
  command_free_ = plan.clock + 1;
  planned_ = false;
}

void DramController::activate(Clock at, const DramPlace& place) {
  ++statistics_.activates;
  Bank& bank = banks_[place.bank];
  bank.open_row = place.row;
  bank.column = at + timing_.rcd;
  bank.activate = at + timing_.rc;
  bank.precharge = at + timing_.ras;
  any_.last_activate = at;
  groups_[group_of(place.bank)].last_activate = at;
  activates_[oldest_activate_] = at;
  oldest_activate_ = (oldest_activate_ + 1) % activates_.size();
}

void DramController::precharge(Clock at, Bank& bank) {
  bank.open_row = -1;
  bank.activate = std::max(bank.activate, at + timing_.rp);
}

void DramController::column(Clock at, std::size_t entry, std::vector<Done>& done) {
  std::vector<Entry>& entries = queue();
  const Burst burst = entries[entry].burst;
  entries.erase(entries.begin() + static_cast<std::ptrdiff_t>(entry));
  Bank& bank = banks_[burst.place.bank];
  Group& group = groups_[group_of(burst.place.bank)];
  const Clock data = at + (burst.write ? timing_.cwl : timing_.cl) + timing_.burst_clocks();
  if (burst.write) {
    ++statistics_.writes;
    any_.last_write = group.last_write = at;
    bank.precharge = std::max(bank.precharge, data + timing_.wr);
  } else {
    ++statistics_.reads;
    any_.last_read = group.last_read = at;
    bank.precharge = std::max(bank.precharge, at + timing_.rtp);
  }
  if (statistics_.reads + statistics_.writes > 1 && burst.write != last_was_write_)
    ++statistics_.turn_arounds;
  last_was_write_ = burst.write;
  if (policy_.efficiency < 100) {
    lost_ += timing_.burst_clocks() * 100 * 100 / policy_.efficiency;
    column_free_ = std::max(column_free_, at) + lost_ / 100;
    lost_ %= 100;
  }
  done.push_back({burst.tag, burst.write, data});
}

void DramController::refresh(Clock at) {
  ++statistics_.refreshes;
  for (Bank& bank : banks_) bank.activate = at + timing_.rfc;
  refresh_due_ += timing_.refi;
}

}  // namespace parallax
