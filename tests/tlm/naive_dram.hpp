// SPDX-License-Identifier: Apache-2.0
// The DRAM controller once more, clock by clock, with every rule looked up in the history of commands.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "tlm/dram_controller.hpp"

namespace parallax::test {

struct LoggedCommand {
  std::int64_t clock;
  DramCommand command;
  std::uint32_t bank;
  std::uint32_t row;

  bool operator==(const LoggedCommand& other) const {
    return clock == other.clock && command == other.command && bank == other.bank && row == other.row;
  }
};

class NaiveDram {
 public:
  NaiveDram(const DramTiming& timing, const DramPolicy& policy) : t_(timing), policy_(policy) {}

  bool room(bool write) const {
    return write ? writes_.size() < policy_.write_queue : reads_.size() < policy_.read_queue;
  }
  bool idle() const { return reads_.empty() && writes_.empty(); }
  const std::vector<LoggedCommand>& log() const { return log_; }

  /// What happens in clock `now`; then `arrivals` enter.
  void tick(std::int64_t now, const std::vector<DramController::Burst>& arrivals) {
    choose(now);
    for (const DramController::Burst& burst : arrivals) (burst.write ? writes_ : reads_).push_back(burst);
  }

 private:
  using Queue = std::vector<DramController::Burst>;

  void choose(std::int64_t now) {
    if (!writing_) {
      const bool reads_have_their_turn = turn_ > 0 && !reads_.empty();
      if ((writes_.size() >= policy_.high_watermark && !reads_have_their_turn) ||
          (reads_.empty() && !writes_.empty())) {
        writing_ = true;
        kept_waiting_ = 0;
      }
    } else {
      const bool enough = kept_waiting_ >= policy_.longest_batch;
      if (writes_.empty() || ((writes_.size() <= policy_.low_watermark || enough) && !reads_.empty())) {
        writing_ = false;
        turn_ = enough ? std::min(reads_.size(), policy_.longest_batch) : 0;
      }
    }
    if (t_.refi > 0 && now >= (refreshes_ + 1) * t_.refi) {
      bool any_open = false;
      for (std::uint32_t bank = 0; bank < banks(); ++bank) any_open |= open_row(bank) >= 0;
      const DramCommand next = any_open ? DramCommand::kPrechargeAll : DramCommand::kRefresh;
      if (allowed(now, next, 0)) {
        issue({now, next, 0, 0});
        if (next == DramCommand::kRefresh) ++refreshes_;
      }
      return;
    }
    Queue& queue = writing_ ? writes_ : reads_;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const DramLocation location = queue[i].location;
      DramCommand next = writing_ ? DramCommand::kWrite : DramCommand::kRead;
      if (open_row(location.bank) != location.row) {
        const bool older = std::any_of(queue.begin(), queue.begin() + static_cast<std::ptrdiff_t>(i),
                                       [&](const auto& o) { return o.location.bank == location.bank; });
        const bool wanted = std::any_of(queue.begin(), queue.end(), [&](const auto& o) {
          return o.location.bank == location.bank && open_row(location.bank) == o.location.row;
        });
        if (older || wanted) continue;
        next = open_row(location.bank) < 0 ? DramCommand::kActivate : DramCommand::kPrecharge;
      }
      if (!allowed(now, next, location.bank)) continue;
      issue({now, next, location.bank, location.row});
      if (next == DramCommand::kRead || next == DramCommand::kWrite) {
        if (writing_ && !reads_.empty()) ++kept_waiting_;
        if (!writing_ && turn_ > 0) --turn_;
        queue.erase(queue.begin() + static_cast<std::ptrdiff_t>(i));
      }
      return;
    }
  }

  std::uint32_t banks() const { return static_cast<std::uint32_t>(t_.banks); }

  std::int64_t open_row(std::uint32_t bank) const {
    for (auto c = log_.rbegin(); c != log_.rend(); ++c) {
      if (c->command == DramCommand::kPrechargeAll) return -1;
      if (c->bank != bank) continue;
      if (c->command == DramCommand::kActivate) return c->row;
      if (c->command == DramCommand::kPrecharge) return -1;
    }
    return -1;
  }

  // Whether the standard allows the command now, after all that was issued.
  bool allowed(std::int64_t now, DramCommand command, std::uint32_t bank) const {
    const auto group = [&](std::uint32_t b) { return b % static_cast<std::uint32_t>(t_.bank_groups); };
    const std::int64_t data = t_.burst_length / 2;
    int activates = 0;
    for (auto c = log_.rbegin(); c != log_.rend() && c->clock > now - 20000; ++c) {
      const std::int64_t since = now - c->clock;
      const bool same_bank = c->bank == bank;
      const bool same_group = group(c->bank) == group(bank);
      std::int64_t least = 1;
      const auto need = [&](bool holds, std::int64_t clocks) {
        if (holds) least = std::max(least, clocks);
      };
      const bool read = c->command == DramCommand::kRead;
      const bool write = c->command == DramCommand::kWrite;
      switch (command) {
        case DramCommand::kActivate:
          if (c->command == DramCommand::kActivate && ++activates == 4) need(true, t_.faw);
          need(c->command == DramCommand::kActivate, t_.rrd);
          need(c->command == DramCommand::kActivate && same_group, t_.rrd_group);
          need(c->command == DramCommand::kActivate && same_bank, t_.rc);
          need(c->command == DramCommand::kPrecharge && same_bank, t_.rp);
          need(c->command == DramCommand::kRefresh, t_.rfc);
          break;
        case DramCommand::kPrecharge:
        case DramCommand::kPrechargeAll: {
          // A bank that is closed already does not hold up the precharge of all.
          const bool mine = command == DramCommand::kPrecharge ? same_bank : open_row(c->bank) >= 0;
          need(mine && c->command == DramCommand::kActivate, t_.ras);
          need(mine && read, t_.rtp);
          need(mine && write, t_.cwl + data + t_.wr);
          break;
        }
        case DramCommand::kRead:
          need(c->command == DramCommand::kActivate && same_bank, t_.rcd);
          need(read, t_.ccd);
          need(read && same_group, t_.ccd_group);
          need(write, t_.cwl + data + t_.wtr);
          need(write && same_group, t_.cwl + data + t_.wtr_group);
          break;
        case DramCommand::kWrite:
          need(c->command == DramCommand::kActivate && same_bank, t_.rcd);
          need(write, t_.ccd);
          need(write && same_group, t_.ccd_group);
          need(read, t_.rtw);
          break;
        case DramCommand::kRefresh:
          need(c->command == DramCommand::kPrecharge, t_.rp);
          need(c->command == DramCommand::kPrechargeAll, t_.rp_all);
          need(c->command == DramCommand::kActivate, t_.rc);
          need(c->command == DramCommand::kRefresh, t_.rfc);
          break;
      }
      if (since < least) return false;
    }
    return true;
  }

  void issue(const LoggedCommand& command) { log_.push_back(command); }

  const DramTiming t_;
  const DramPolicy policy_;
  Queue reads_, writes_;
  bool writing_ = false;
  std::size_t kept_waiting_ = 0;  // writes of the batch for which reads waited
  std::size_t turn_ = 0;          // reads that still go before the next batch
  std::int64_t refreshes_ = 0;
  std::vector<LoggedCommand> log_;
};

}  // namespace parallax::test
