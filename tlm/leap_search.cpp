// SPDX-License-Identifier: Apache-2.0
// Leap: finding periodic motion.
#include "tlm/leap.hpp"

#include <algorithm>
#include <utility>

#include "tlm/leap_detail.hpp"

namespace parallax {

using namespace leap_detail;

namespace {

constexpr std::uint64_t kLookedAt = 64;  // firings looked at to tell what an irregular schedule does always
constexpr int kWide = 3;                 // looks for which a stage counts as moving

}  // namespace

void Leap::build(const std::vector<Stage*>& stages) {
  for (Stage* stage : stages) {
    if (stage->clock().frequency() == clock_.frequency()) {
      members_.emplace_back();
      members_.back().stage = stage;
    }
  }
  const auto link_of = [this](StreamBase* stream) {
    const auto found =
        std::find_if(links_.begin(), links_.end(), [&](const Link& link) { return link.stream == stream; });
    if (found != links_.end()) return static_cast<int>(found - links_.begin());
    links_.emplace_back();
    links_.back().stream = stream;
    return static_cast<int>(links_.size() - 1);
  };
  for (std::size_t m = 0; m < members_.size(); ++m) {
    Member& member = members_[m];
    for (unsigned port = 0; port < member.stage->inputs_.count; ++port) {
      for (StreamBase* stream : member.stage->inputs_.of_mask[1u << port]) {
        const int link = link_of(stream);
        links_[static_cast<std::size_t>(link)].reader = static_cast<int>(m);
        links_[static_cast<std::size_t>(link)].reader_port = static_cast<PortMask>(1u << port);
        member.in.push_back(link);
      }
    }
    for (unsigned port = 0; port < member.stage->outputs_.count; ++port) {
      for (StreamBase* stream : member.stage->outputs_.of_mask[1u << port]) {
        const int link = link_of(stream);
        links_[static_cast<std::size_t>(link)].writer = static_cast<int>(m);
        links_[static_cast<std::size_t>(link)].writer_port = static_cast<PortMask>(1u << port);
        member.out.push_back(link);
      }
    }
  }
}

bool Leap::attempt() {
  // In the order in which the stages happen to be gone through, one that moves all the time may have stood
  // still since the last look, and one that has come to its end may have moved. Every other look is a wide
  // one.
  const int recent = wide_ ? kWide : 1;
  wide_ = !wide_;
  for (Member& member : members_) {
    const Stage& stage = *member.stage;
    member.looks_still = stage.statistics_.firings == member.seen_firings ? member.looks_still + 1 : 0;
    member.seen_firings = stage.statistics_.firings;
    member.active = stage.statistics_.firings != 0 && (member.looks_still < recent || stage.can_fire());
  }
  return classify() && find_period() && observe();
}

// Finds out who takes part: the stages that have moved lately, with the unit in which each repeats itself,
// and the streams that go along with it. Where a stage touches a stream irregularly, the stream is not core,
// for either end.
bool Leap::classify() {
  for (Link& link : links_) link.core = link.writer >= 0 && link.reader >= 0 && link.stream->same_clock_;
  for (bool changed = true; changed;) {
    changed = false;
    for (Member& member : members_) {
      if (!member.active) continue;
      const auto core_ports = [&](const std::vector<int>& links, PortMask Link::*port) {
        unsigned all = 0;
        unsigned off = 0;
        for (const int l : links) {
          const Link& link = links_[static_cast<std::size_t>(l)];
          all |= link.*port;
          if (!link.core) off |= link.*port;
        }
        return static_cast<PortMask>(all & ~off);
      };
      const auto demote = [&](const std::vector<int>& links, PortMask Link::*port, PortMask kept) {
        for (const int l : links) {
          Link& link = links_[static_cast<std::size_t>(l)];
          if (link.core && !contains(link.*port, kept)) {
            link.core = false;
            changed = true;
          }
        }
      };
      member.core_in = core_ports(member.in, &Link::reader_port);
      member.core_out = core_ports(member.out, &Link::writer_port);
      member.takes_part = member.core_in != 0 || member.core_out != 0;
      PortMask mixed_in = 0;
      PortMask mixed_out = 0;
      if (member.takes_part && !find_unit(member, mixed_in, mixed_out)) return false;
      member.core_in = without(member.core_in, mixed_in);
      member.core_out = without(member.core_out, mixed_out);
      demote(member.in, &Link::reader_port, member.core_in);
      demote(member.out, &Link::writer_port, member.core_out);
    }
  }
  bool any = false;
  for (Member& member : members_) {
    if (!member.active || !member.takes_part) continue;
    any = true;
    const auto loose = [this](const std::vector<int>& links, std::vector<Link*>& found) {
      found.clear();
      for (const int l : links) {
        Link& link = links_[static_cast<std::size_t>(l)];
        if (!link.core) found.push_back(&link);
      }
    };
    loose(member.in, member.loose_in);
    loose(member.out, member.loose_out);
  }
  return any;
}

// The firings after which the stage does the same again, in what it does to core ports: one, where they are
// all alike, else a pass of the segment. In a list of single phases, ports that only some firings touch are
// `mixed`.
bool Leap::find_unit(Member& member, PortMask& mixed_in, PortMask& mixed_out) {
  const Stage& stage = *member.stage;
  const Schedule& schedule = stage.schedule_;
  const Schedule::Segment& segment = schedule.segments()[stage.next_.segment];
  const Phase* phases = schedule.phases().data() + segment.first_phase;
  member.cursor = stage.next_;
  member.scanned = stage.statistics_.firings;
  member.ended = false;
  member.events = {};
  member.checked = 0;
  member.common = phases[stage.next_.phase];
  member.unit = 1;
  if (segment.repeat > 1) {
    if (std::all_of(phases, phases + segment.phase_count, [&](const Phase& phase) {
          return same_in(phase, member.common, member.core_in, member.core_out);
        })) {
      return true;
    }
    if (segment.repeat - stage.next_.pass < 3) return false;
    member.unit = 0;
    PortMask consume = 0;
    PortMask produce = 0;
    for (const Phase* phase = phases; phase != phases + segment.phase_count; ++phase) {
      member.unit += phase->count;
      consume = static_cast<PortMask>(consume | phase->consume);
      produce = static_cast<PortMask>(produce | phase->produce);
    }
    member.common = {1, 1, consume, produce};
    return member.unit <= kLargestUnit && without(consume, member.core_in) == 0 &&
           without(produce, member.core_out) == 0;
  }
  unsigned any_in = 0, any_out = 0;
  unsigned all_in = 0xff, all_out = 0xff;
  std::uint64_t looked = 0;
  Stage::Position at = stage.next_;
  while (looked < kLookedAt && at.segment < schedule.segments().size()) {
    const Schedule::Segment& here = schedule.segments()[at.segment];
    const Phase& phase = schedule.phases()[here.first_phase + at.phase];
    if (phase.interval != member.common.interval || idle(phase) != idle(member.common)) break;
    any_in |= phase.consume;
    any_out |= phase.produce;
    all_in &= phase.consume;
    all_out &= phase.produce;
    const std::uint32_t count = phase.count - at.count;
    looked += count;
    stage.skip(at, count);
  }
  mixed_in = within(static_cast<PortMask>(any_in & ~all_in), member.core_in);
  mixed_out = within(static_cast<PortMask>(any_out & ~all_out), member.core_out);
  return true;
}

// The period T is that of the slowest stage; all others must fit into it a whole number of times.
bool Leap::find_period() {
  period_ = 0;
  const auto unit_time = [](const Member& member) {
    const Stage& stage = *member.stage;
    return (stage.start_of_last(0) - stage.start_of_last(member.unit)).count();
  };
  for (const Member& member : members_) {
    if (!member.active || !member.takes_part) continue;
    if (member.stage->statistics_.firings <= member.unit) return false;
    period_ = std::max(period_, unit_time(member));
  }
  for (Member& member : members_) {
    if (!member.active || !member.takes_part) continue;
    const std::int64_t time = unit_time(member);
    if (time <= 0 || period_ % time != 0) return false;
    member.firings = member.unit * static_cast<std::uint64_t>(period_ / time);
    if (member.firings > kLargestUnit) return false;
  }
  return true;
}

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
bool Leap::observe() {
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
  for (Member& member : members_) {
    Stage& stage = *member.stage;
    if (!member.active) {
      same = same && !stage.can_fire() && stage.left_ == member.left_before;
      if (same) stage.advance();  // says which streams it waits for
    } else if (member.takes_part) {
      member.base = stage.statistics_.firings;
      member.last_event_write = stage.last_write_;
      member.claimed_pending = 0;
      member.place_firing = 0;
      member.done = 0;
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
  return same;
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

// The same for the places to write.
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
