// SPDX-License-Identifier: Apache-2.0
#include "tlm/leap.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace parallax {
namespace {

constexpr std::uint64_t kLargestUnit = 64;   // firings of a unit, and of a period: within the history that is kept
constexpr std::uint64_t kLookedAt = 64;      // firings looked at to tell what an irregular schedule does always
constexpr std::uint64_t kScannedAhead = 8192;  // firings
constexpr std::size_t kEventsAhead = 256;
constexpr int kWide = 3;                       // looks for which a stage counts as moving
constexpr std::uint64_t kAlways = std::numeric_limits<std::uint64_t>::max();

std::int64_t as_signed(std::uint64_t count) { return static_cast<std::int64_t>(count); }
PortMask without(PortMask mask, PortMask core) { return static_cast<PortMask>(mask & ~core); }
PortMask within(PortMask mask, PortMask core) { return static_cast<PortMask>(mask & core); }
bool contains(PortMask mask, PortMask port) { return (mask & port) != 0; }

bool same_in(const Phase& a, const Phase& b, PortMask in, PortMask out) {
  return a.interval == b.interval && within(a.consume, in) == within(b.consume, in) &&
         within(a.produce, out) == within(b.produce, out);
}

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
  // In the order in which the stages happen to be gone through, one that moves all the time may have stood still since
  // the last look, and one that has come to its end may have moved. Every other look is a wide one.
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

// Finds out who takes part: the stages that have moved lately, with the unit in which each repeats itself, and the
// streams that go along with it. Where a stage touches a stream irregularly, the stream is not core, for either end.
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
  return std::any_of(members_.begin(), members_.end(), [](const Member& m) { return m.active && m.takes_part; });
}

// The firings after which the stage does the same again, in what it does to core ports: one, where they are all
// alike, else a pass of the segment. In a list of single phases, ports that only some firings touch are `mixed`.
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
    if (phase.interval != member.common.interval) break;
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
    stage.fire_limit_ = !limited ? kAlways
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
    return member.delta.blocked == Cycles(0) && member.delta.memory == Cycles(0);
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
  // The occupancy: as many dates counted, and those not counted yet are a period later than their predecessors.
  if (stream.settled_writes_ - link.settled_before != link.writes || stream.freed_ - link.freed_before != link.reads ||
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
  return periodic([&](std::uint64_t i) { return stream.write_date(i); }, stream.settled_writes_, link.base_written,
                  link.writes) &&
         periodic([&](std::uint64_t i) { return stream.read_date(i); }, stream.freed_, link.base_read, link.reads);
}

// Whether the tokens to read will be there in time, as in the period observed. Where one held its reader back, all
// must be a period later than their predecessors; where none did, each is looked at later.
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

bool Leap::go_on(bool eager) {
  if (release_asked_) {
    release();
    return true;
  }
  if (!eager && due_ > sc_core::sc_time_stamp()) return false;
  const bool extended = extend();
  due_ = find_due();
  if (extended) return true;
  if (!waits_outside_ || due_ <= sc_core::sc_time_stamp()) {
    release();
    return true;
  }
  return false;
}

// Goes through as many periods as are certain.
bool Leap::extend() {
  std::uint64_t periods = kAlways;
  waits_outside_ = true;
  for (Member& member : members_) {
    if (!member.active || !member.takes_part) continue;
    bool outside = false;
    const std::uint64_t possible = possible_firings(member, outside) / member.firings;
    if (possible == 0 && !outside) waits_outside_ = false;
    periods = std::min(periods, possible);
  }
  for (Link& link : links_) {
    if (!link.core || periods == 0) continue;
    periods = std::min(periods, possible_periods(link, periods));
    if (periods == 0) waits_outside_ = false;
  }
  if (periods == 0) return false;
  periods_ += periods;
  for (Member& member : members_) {
    if (!member.active || !member.takes_part) continue;
    member.done += periods * member.firings;
    commit_events(member, member.base + member.done);
  }
  return true;
}

// Follows the schedule as long as it keeps to the pattern.
void Leap::scan(Member& member) {
  const Stage& stage = *member.stage;
  const Schedule& schedule = stage.schedule_;
  if (member.ended) return;
  if (member.unit > 1) {
    const Schedule::Segment& segment = schedule.segments()[member.cursor.segment];
    std::uint64_t into_pass = member.cursor.count;
    for (std::uint32_t i = 0; i < member.cursor.phase; ++i) {
      into_pass += schedule.phases()[segment.first_phase + i].count;
    }
    member.scanned += (segment.repeat - member.cursor.pass) * member.unit - into_pass;
    member.ended = true;
    return;
  }
  const std::uint64_t target = member.base + member.done + kScannedAhead;
  while (member.scanned < target && member.events.size() < kEventsAhead) {
    if (member.cursor.segment == schedule.segments().size()) {
      member.ended = true;
      return;
    }
    const Schedule::Segment& segment = schedule.segments()[member.cursor.segment];
    const Phase& phase = schedule.phases()[segment.first_phase + member.cursor.phase];
    if (!same_in(phase, member.common, member.core_in, member.core_out)) {
      member.ended = true;
      return;
    }
    const PortMask consume = without(phase.consume, member.core_in);
    const PortMask produce = without(phase.produce, member.core_out);
    std::uint64_t count = phase.count - member.cursor.count;
    if (consume != 0 || produce != 0) {
      if (produce != 0 && within(phase.produce, member.core_out) != 0) {
        member.ended = true;  // a firing that writes to both kinds of stream is left to itself
        return;
      }
      count = 1;
      member.events.push_back({member.scanned, consume, produce, false, member.cursor});
    } else if (segment.phase_count == 1) {
      count += (segment.repeat - member.cursor.pass - 1) * phase.count;
      member.scanned += count;
      stage.skip(member.cursor, count);
      continue;
    }
    member.scanned += count;
    member.cursor.count += static_cast<std::uint32_t>(count);
    if (member.cursor.count == phase.count) stage.next_phase(member.cursor);
  }
}

// Firings that keep to the pattern and whose irregular tokens and places are known to be there in time. `outside`:
// it may become more when more is known.
std::uint64_t Leap::possible_firings(Member& member, bool& outside) {
  const std::uint64_t now = member.base + member.done;
  outside = false;
  if (!write_pending(member)) return 0;
  scan(member);
  outside = !member.ended;
  for (; member.checked < member.events.size(); ++member.checked) {
    Event& event = member.events[member.checked];
    const Check result = check(member, event);
    if (result == Check::kInTime) continue;
    outside = result == Check::kUnknown;
    return event.firing - now;
  }
  return member.scanned - now;
}

// Writes what waits in the pipeline of a stage that writes irregularly, as far as it is known when there is room. False
// when it was held back: no leap goes over that.
bool Leap::write_pending(Member& member) {
  Stage& stage = *member.stage;
  if (within(member.common.produce, member.core_out) != 0) return true;
  while (stage.left_ != stage.entered_) {
    Stage::Firing& firing = stage.pipe_[stage.left_ & stage.pipe_mask_];
    const Cycles written = std::max(firing.start + Cycles(stage.latency_), stage.last_write_ + Cycles(1));
    bool known = true;
    for (const StreamBase* stream : stage.outputs_.of_mask[firing.produce]) {
      known = known && stream->write_date_known();
      if (known && stream->writable_at() > written) return false;
    }
    if (!known) {
      for (StreamBase* stream : stage.outputs_.of_mask[firing.produce]) {
        if (!stream->write_date_known()) stream->wait_for_room();
      }
      return true;
    }
    firing.left = written;
    firing.by_memory = false;
    ++stage.left_;
    for (StreamBase* stream : stage.outputs_.of_mask[firing.produce]) stream->mark_written(written, Cycles(0));
    stage.note_write(stage.frames_[firing.frame], written);
    member.last_event_write = written;
  }
  return true;
}

Leap::Check Leap::check(Member& member, Event& event) {
  const Stage& stage = *member.stage;
  const Cycles free = free_before(member, event.firing);
  const Cycles written = start_of(member, event.firing) + Cycles(stage.latency_);
  for (const int l : member.in) {
    Link& link = links_[static_cast<std::size_t>(l)];
    if (link.core || !contains(event.consume, link.reader_port)) continue;
    StreamBase& stream = *link.stream;
    const std::uint64_t token = stream.statistics_.read + link.claimed_reads;
    if (token >= stream.statistics_.written) {
      stream.wait_for_token();
      return Check::kUnknown;
    }
    if (stream.forward(stream.write_date(token)) > free) return Check::kLate;
  }
  bool pending = false;
  if (event.produce != 0) {
    if (stage.latency_ > 0 && member.last_event_write > free) return Check::kLate;
    pending = stage.entered_ != stage.left_ || member.claimed_pending != 0;
    for (const int l : member.out) {
      const Link& link = links_[static_cast<std::size_t>(l)];
      if (link.core || !contains(event.produce, link.writer_port) || pending) continue;
      if (!link.stream->write_date_known(link.claimed_writes)) {
        pending = true;
        link.stream->wait_for_room();
      } else if (link.stream->writable_at(link.claimed_writes) > (stage.latency_ == 0 ? free : written)) {
        return Check::kLate;
      }
    }
    // Where it is not known when there will be room, the firing can wait in the pipeline.
    if (pending && stage.entered_ - stage.left_ + member.claimed_pending >= stage.latency_) return Check::kUnknown;
    if (pending) {
      ++member.claimed_pending;
    } else {
      member.last_event_write = written;
    }
  }
  for (const int l : member.in) {
    Link& link = links_[static_cast<std::size_t>(l)];
    if (!link.core && contains(event.consume, link.reader_port)) ++link.claimed_reads;
  }
  for (const int l : member.out) {
    Link& link = links_[static_cast<std::size_t>(l)];
    if (!link.core && !pending && contains(event.produce, link.writer_port)) ++link.claimed_writes;
  }
  event.pending = pending;
  return Check::kInTime;
}

// Periods, of those wanted, for which the stream is known to hold nobody back more than in the period observed.
std::uint64_t Leap::possible_periods(Link& link, std::uint64_t wanted) {
  const StreamBase& stream = *link.stream;
  const bool balanced = link.reads == link.writes;
  std::uint64_t periods = wanted;
  if (link.reads != 0 && !link.reads_bind) {
    // Tokens from before the leap are looked at one by one; those from within it are read as long after their
    // writing as their predecessors were.
    const std::uint64_t known = link.base_written - link.base_read;
    if (!balanced) periods = std::min(periods, known / link.reads - periods_);
    const std::uint64_t end = std::min(link.base_read + (periods_ + periods) * link.reads, link.base_written);
    for (; link.sure_reads < end; ++link.sure_reads) {
      const std::uint64_t pass = (link.sure_reads - link.base_read) / link.reads;
      const std::uint64_t place = (link.sure_reads - link.base_read) % link.reads;
      const Cycles needed = stream.read_watch_.ready[place] + Cycles(period_ * as_signed(pass + 1));
      if (stream.forward(stream.write_date(link.sure_reads)) > needed) {
        periods = std::min(periods, pass - periods_);
        break;
      }
    }
  }
  if (link.writes != 0 && !link.writes_bind) {
    const std::uint64_t room = link.base_read + stream.depth() - link.base_written;
    if (!balanced) periods = std::min(periods, room / link.writes - periods_);
    const std::uint64_t end =
        std::min(link.base_written + (periods_ + periods) * link.writes, link.base_read + stream.depth());
    for (; link.sure_writes < end; ++link.sure_writes) {
      if (link.sure_writes < stream.depth()) continue;
      const std::uint64_t pass = (link.sure_writes - link.base_written) / link.writes;
      const std::uint64_t place = (link.sure_writes - link.base_written) % link.writes;
      const Cycles needed = stream.write_watch_.ready[place] + Cycles(period_ * as_signed(pass + 1));
      if (stream.backward(stream.read_date(link.sure_writes - stream.depth())) > needed) {
        periods = std::min(periods, pass - periods_);
        break;
      }
    }
  }
  return periods;
}

void Leap::commit_events(Member& member, std::uint64_t until) {
  Stage& stage = *member.stage;
  while (!member.events.empty() && member.events.front().firing < until) {
    const Event event = member.events.front();
    member.events.pop_front();
    --member.checked;
    member.place = event.place;
    member.place_firing = event.firing;
    const Cycles start = start_of(member, event.firing);
    for (const int l : member.in) {
      Link& link = links_[static_cast<std::size_t>(l)];
      if (link.core || !contains(event.consume, link.reader_port)) continue;
      --link.claimed_reads;
      link.stream->mark_read(start, Cycles(0));
    }
    if (event.produce == 0) continue;
    const Cycles written = start + Cycles(stage.latency_);
    stage.pipe_[stage.entered_++ & stage.pipe_mask_] = {start, written, event.produce, false,
                                                        static_cast<std::uint32_t>(stage.frames_.size() - 1)};
    if (event.pending) {
      --member.claimed_pending;
      continue;
    }
    stage.left_ = stage.entered_;
    for (const int l : member.out) {
      Link& link = links_[static_cast<std::size_t>(l)];
      if (link.core || !contains(event.produce, link.writer_port)) continue;
      --link.claimed_writes;
      link.stream->mark_written(written, Cycles(0));
    }
    stage.note_write(stage.frames_.back(), written);
  }
}

Cycles Leap::start_of(const Member& member, std::uint64_t firing) const {
  const std::uint64_t since = firing - member.base;
  return member.observed[since % member.firings].start +
         Cycles(period_ * as_signed(since / member.firings + 1));
}

Cycles Leap::free_before(const Member& member, std::uint64_t firing) const {
  const std::uint64_t since = firing - member.base;
  return member.observed[since % member.firings].free + Cycles(period_ * as_signed(since / member.firings + 1));
}


void Leap::materialize() {
  const std::uint64_t periods = periods_ - materialized_;
  if (periods == 0) return;
  materialized_ = periods_;
  for (Member& member : members_) {
    if (member.active && member.takes_part) materialize(member, periods);
  }
  for (Link& link : links_) {
    if (link.core) materialize(link, periods);
  }
}

void Leap::materialize(Member& member, std::uint64_t periods) {
  Stage& stage = *member.stage;
  const Cycles later(period_ * as_signed(periods));
  const std::uint64_t first = stage.statistics_.firings;
  if (member.place_firing > first) {
    stage.next_ = member.place;
    stage.skip(stage.next_, first + periods * member.firings - member.place_firing);
  } else {
    stage.skip(stage.next_, periods * member.firings);
  }
  if (stage.next_.segment == stage.schedule_.segments().size()) stage.next_ = {};
  stage.phase_ = &stage.phase_at(stage.next_);
  stage.free_ += later;
  stage.statistics_.add(member.delta, as_signed(periods));
  leaped_firings_ += periods * member.firings;
  const std::uint64_t last = stage.statistics_.firings;
  for (std::uint64_t i = std::max(first, last - std::min(last, 2 * kLargestUnit)); i < last; ++i) {
    stage.starts_[i % Stage::kStartsKept] = start_of(member, i);
  }
  stage.frames_.back().last_firing += later;
  if (member.writes == 0) return;

  const std::uint64_t size = stage.pipe_mask_ + 1;
  const auto frame = static_cast<std::uint32_t>(stage.frames_.size() - 1);
  // The entries of one period, from which all others follow; they may be overwritten below.
  std::vector<Stage::Firing> entered;
  std::vector<Cycles> left;
  for (std::uint64_t i = 0; i < member.writes; ++i) {
    entered.push_back(stage.pipe_[(stage.entered_ - member.writes + i) & stage.pipe_mask_]);
    left.push_back(stage.pipe_[(stage.left_ - member.writes + i) & stage.pipe_mask_].left);
  }
  const auto shift = [this](std::uint64_t passes) { return Cycles(period_ * as_signed(passes + 1)); };
  const std::uint64_t added = periods * member.writes;
  for (std::uint64_t i = added - std::min(added, size); i < added; ++i) {
    const Stage::Firing& model = entered[i % member.writes];
    Stage::Firing& entry = stage.pipe_[(stage.entered_ + i) & stage.pipe_mask_];
    entry.start = model.start + shift(i / member.writes);
    entry.produce = model.produce;
    entry.by_memory = false;
    entry.frame = frame;
  }
  for (std::uint64_t i = added - std::min(added, size); i < added; ++i) {
    stage.pipe_[(stage.left_ + i) & stage.pipe_mask_].left = left[i % member.writes] + shift(i / member.writes);
  }
  stage.entered_ += added;
  stage.left_ += added;
  stage.last_write_ += later;
  stage.frames_.back().last_write += later;
}

void Leap::materialize(Link& link, std::uint64_t periods) {
  StreamBase& stream = *link.stream;
  const Cycles later(period_ * as_signed(periods));
  const auto extend = [&](std::vector<Cycles>& dates, std::uint64_t from, std::uint64_t step, const auto& tell) {
    std::vector<Cycles>& model = model_;
    model.clear();
    for (std::uint64_t i = from - step; i < from; ++i) model.push_back(dates[i & stream.mask_]);
    const std::uint64_t added = periods * step;
    const std::uint64_t begin =
        stream.listener_ != nullptr ? 0 : added - std::min<std::uint64_t>(added, stream.mask_ + 1);
    std::uint64_t place = begin % step;
    Cycles shift(period_ * as_signed(begin / step + 1));
    for (std::uint64_t i = begin; i < added; ++i) {
      const Cycles date = model[place] + shift;
      dates[(from + i) & stream.mask_] = date;
      tell(date);
      if (++place == step) {
        place = 0;
        shift += Cycles(period_);
      }
    }
  };
  StreamStatistics& statistics = stream.statistics_;
  if (link.writes != 0) {
    extend(stream.write_dates_, statistics.written, link.writes, [&](Cycles date) {
      if (stream.listener_ != nullptr) stream.listener_->written(stream, date);
    });
    statistics.written += periods * link.writes;
    statistics.blocked_on_full += link.blocked * as_signed(periods);
    stream.last_write_ = stream.write_date(statistics.written - 1);
    stream.reader_waits_ = false;
  }
  if (link.reads != 0) {
    extend(stream.read_dates_, statistics.read, link.reads, [&](Cycles date) {
      if (stream.listener_ != nullptr) stream.listener_->read(stream, date);
    });
    statistics.read += periods * link.reads;
    statistics.starved_on_empty += link.starved * as_signed(periods);
    stream.last_read_ = stream.read_date(statistics.read - 1);
    stream.writer_waits_ = false;
  }
  if (link.reads == link.writes && link.reads != 0) {
    stream.settled_writes_ += periods * link.writes;
    stream.freed_ += periods * link.reads;
    stream.settled_until_ += later;
    for (const auto& [level, cycles] : link.levels) stream.occupancy_.add(level, cycles * periods);
  } else {
    stream.settle();
  }
}

// Gives the stages back to themselves.
void Leap::release() {
  materialize();
  holding_ = false;
  release_asked_ = false;
  for (Member& member : members_) {
    if (member.active && !member.takes_part) continue;
    // Woken, each says anew what it waits for.
    for (const int l : member.in) links_[static_cast<std::size_t>(l)].stream->reader_waits_ = false;
    for (const int l : member.out) links_[static_cast<std::size_t>(l)].stream->writer_waits_ = false;
    dataflow_.release(*member.stage);
    member.looks_still = 0;
  }
}

sc_core::sc_time Leap::find_due() const {
  // An edge before the first date that is not known, so that it is in time for whoever acts on that date.
  Cycles first(std::numeric_limits<std::int64_t>::max());
  const Cycles later(period_ * as_signed(periods_ - materialized_));
  for (const Member& member : members_) {
    if (!member.active || !member.takes_part) continue;
    const Stage& stage = *member.stage;
    first = std::min(first, stage.free_ + later);
    if (stage.entered_ != stage.left_) {
      const Cycles leaves = stage.pipe_[stage.left_ & stage.pipe_mask_].start + Cycles(stage.latency_);
      first = std::min(first, std::max(leaves, stage.last_write_ + Cycles(1)) + (member.writes != 0 ? later : Cycles(0)));
    }
  }
  return clock_.time_of(std::max(Cycles(0), first - Cycles(1)));
}

}  // namespace parallax
