// SPDX-License-Identifier: Apache-2.0
// Leap: going through one period, and whether all that can still make a difference is as it was before it.
#include "tlm/leap.hpp"

#include <algorithm>

#include "tlm/leap_detail.hpp"

namespace parallax {

using namespace leap_detail;

void Leap::set_limits(bool limited, bool with_period) {
  for (Member& member : members_) {
    Stage& stage = *member.stage;
    if (member.active && !member.takes_part) continue;
    stage.fire_limit_ = !limited                       ? kAlways
                        : with_period && member.active ? stage.statistics_.firings + member.firings
                                                       : stage.statistics_.firings;
  }
}

// Lets every stage go through one period, and compares what came of it with what was before.
Leap::Found Leap::observe() {
  set_limits(true, false);
  dataflow_.drain();  // what can be written of what has been fired
  snapshot();
  set_limits(true, true);
  for (Member& member : members_) {
    if (!member.active || !member.takes_part) continue;
    member.observed.clear();
    member.stage->observed_ = &member.observed;
    dataflow_.wake(*member.stage);
  }
  dataflow_.drain();
  for (Member& member : members_) member.stage->observed_ = nullptr;
  set_limits(false, false);

  bool same = true;
  bool whole = true;
  for (Member& member : members_) {
    Stage& stage = *member.stage;
    if (!member.active) {
      same = same && !stage.can_fire() && stage.left_ == member.left_before;
      if (same) stage.advance();  // says which streams it waits for
    } else if (member.takes_part) {
      member.base = stage.statistics_.firings;
      whole = whole && member.base == member.before.firings + member.firings;
      member.last_event_write = stage.last_write_;
      member.claimed_pending = 0;
      member.position_firing = 0;
      member.done = member.sure_periods = 0;
      same = same && repeats(member);
      while (same && !member.ended && member.scanned < member.base) scan(member);
      same = same && member.scanned >= member.base;
      while (!member.events.empty() && member.events.front().firing < member.base) member.events.pop_front();
    }
  }
  for (Link& link : links_) {
    link.stream->settle();
    link.stream->counted_ = nullptr;
    if (link.core) {
      same = same && repeats(link);
    } else {
      same = same && !link.stream->read_watch_.binds && !link.stream->write_watch_.binds;
    }
  }
  periods_ = materialized_ = 0;
  holding_ = same;
  open_.clear();
  for (Link& link : links_) {
    if (link.core) open_.push_back(&link);
  }
  if (same) announce();
  if (same) due_ = find_due();
  release_asked_ = false;
  for (Member& member : members_) {
    if (member.active && !member.takes_part) continue;
    if (same) {
      dataflow_.hold(*member.stage, this, member.active);
    } else {
      dataflow_.wake(*member.stage);
    }
  }
  return same ? Found::kPeriod : whole ? Found::kNothing : Found::kUnknown;
}

void Leap::snapshot() {
  for (Member& member : members_) {
    const Stage& stage = *member.stage;
    member.before = stage.statistics_;
    member.entered_before = stage.entered_;
    member.left_before = stage.left_;
    member.free_before = stage.free_;
    member.last_write_before = stage.last_write_;
    member.frames_before = stage.frames_.size();
  }
  for (Link& link : links_) {
    StreamBase& stream = *link.stream;
    stream.settle();
    stream.read_watch_.reset();
    stream.write_watch_.reset();
    link.before = stream.statistics_;
    link.settled_before = stream.settled_writes_;
    link.freed_before = stream.freed_;
    link.settled_until_before = stream.settled_until_;
    link.levels.clear();
    link.claimed_reads = link.claimed_writes = 0;
    if (link.core) stream.counted_ = &link.levels;
  }
}

// Whether the stage is where it was before the period, T cycles later.
bool Leap::repeats(Member& member) const {
  const Stage& stage = *member.stage;
  const Cycles period(period_);
  const StageStatistics& now = stage.statistics_;
  if (now.firings != member.before.firings + member.firings || member.observed.size() != member.firings ||
      stage.free_ - member.free_before != period || stage.frames_.size() != member.frames_before ||
      stage.frames_.empty()) {
    return false;
  }
  member.delta = now;
  member.delta -= member.before;
  const bool writes = within(member.common.produce, member.core_out) != 0;
  member.writes = writes ? stage.entered_ - member.entered_before : 0;
  const auto firing = [&stage](std::uint64_t i) -> const Stage::Firing& {
    return stage.pipe_[i & stage.pipe_mask_];
  };
  if (!writes) {
    for (std::uint64_t i = member.left_before; i < stage.entered_; ++i) {
      if (within(firing(i).produce, member.core_out) != 0) return false;  // still on its way out
    }
    // What it writes irregularly must not hold it back.
    return member.delta.blocked + member.delta.memory + member.delta.synchroniser == Cycles(0);
  }
  if (stage.left_ - member.left_before != member.writes ||
      (member.writes != 0 && stage.last_write_ - member.last_write_before != period)) {
    return false;
  }
  if (stage.latency_ == 0) return true;
  if (stage.entered_ < stage.latency_ + member.writes) return false;
  for (std::uint64_t i = stage.entered_ - stage.latency_; i < stage.entered_; ++i) {
    const bool left = i < stage.left_;
    const Stage::Firing& before = firing(i - member.writes);
    if ((left ? firing(i).left - before.left : firing(i).start - before.start) != period) return false;
    if (firing(i).produce != before.produce) return false;
  }
  for (std::uint64_t i = stage.left_ - member.writes; i < stage.entered_; ++i) {
    if (firing(i).frame + 1 != stage.frames_.size()) return false;
  }
  return true;
}

bool Leap::repeats(Link& link) const {
  const StreamBase& stream = *link.stream;
  link.base_read = stream.statistics_.read;
  link.base_written = stream.statistics_.written;
  link.reads = link.base_read - link.before.read;
  link.writes = link.base_written - link.before.written;
  if (link.reads > kLargestUnit || link.writes > kLargestUnit) return false;
  link.blocked = stream.statistics_.blocked_on_full - link.before.blocked_on_full;
  link.starved = stream.statistics_.starved_on_empty - link.before.starved_on_empty;
  if (!reads_repeat(link) || !writes_repeat(link)) return false;
  if (link.reads != link.writes || link.reads == 0) return true;
  // The occupancy: as many dates counted, and those not counted yet are a period later than their
  // predecessors.
  if (stream.settled_writes_ - link.settled_before != link.writes ||
      stream.freed_ - link.freed_before != link.reads ||
      stream.settled_until_ - link.settled_until_before != Cycles(period_)) {
    return false;
  }
  const auto periodic = [this](const auto& date, std::uint64_t from, std::uint64_t to, std::uint64_t step) {
    if (from < step) return false;
    for (std::uint64_t i = from; i < to; ++i) {
      if (date(i) - date(i - step) != Cycles(period_)) return false;
    }
    return true;
  };
  return periodic([&](std::uint64_t i) { return stream.write_date(i); }, stream.settled_writes_,
                  link.base_written, link.writes) &&
         periodic([&](std::uint64_t i) { return stream.read_date(i); }, stream.freed_, link.base_read,
                  link.reads);
}

// Whether the tokens to read will be there in time, as in the period observed. Where one held its reader
// back, all must be a period later than their predecessors; where none did, each is looked at later.
bool Leap::reads_repeat(Link& link) const {
  const StreamBase& stream = *link.stream;
  link.reads_bind = stream.read_watch_.binds;
  link.sure_reads = link.base_read;
  if (link.reads == 0 || !link.reads_bind) return true;
  link.sure_reads = kAlways;
  if (link.reads != link.writes || link.base_read < link.reads ||
      link.base_written - link.base_read + link.reads > stream.history()) {
    return false;
  }
  for (std::uint64_t i = link.base_read; i < link.base_written; ++i) {
    if (stream.write_date(i) - stream.write_date(i - link.reads) != Cycles(period_)) return false;
  }
  return true;
}

// The same for the slots to write.
bool Leap::writes_repeat(Link& link) const {
  const StreamBase& stream = *link.stream;
  link.writes_bind = stream.write_watch_.binds;
  link.sure_writes = link.base_written;
  if (link.writes == 0 || !link.writes_bind) return true;
  link.sure_writes = kAlways;
  const std::uint64_t depth = stream.depth();
  if (link.reads != link.writes || link.base_written < depth + link.writes ||
      link.base_read - (link.base_written - depth) + link.writes > stream.history()) {
    return false;
  }
  for (std::uint64_t i = link.base_written - depth; i < link.base_read; ++i) {
    if (stream.read_date(i) - stream.read_date(i - link.writes) != Cycles(period_)) return false;
  }
  return true;
}

}  // namespace parallax
