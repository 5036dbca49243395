// SPDX-License-Identifier: Apache-2.0
// Leap: going over periodic motion, as far as it is certain.
#include "tlm/leap.hpp"

#include <algorithm>
#include <utility>

#include "tlm/leap_detail.hpp"

namespace parallax {

using namespace leap_detail;

namespace {

constexpr std::uint64_t kScannedAhead = 8192;  // firings
constexpr std::size_t kEventsAhead = 256;

}  // namespace

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
  const auto look = [&](Member& member) {
    bool outside = false;
    const std::uint64_t possible = possible_firings(member, outside) / member.firings;
    if (possible == 0 && !outside) waits_outside_ = false;
    periods = std::min(periods, possible);
    return possible;
  };
  for (Member* member : irregular_) look(*member);
  for (Member* member : regular_) {
    // Its schedule alone can end its motion, and has been looked at for so many.
    const std::uint64_t sure = member->sure_periods;
    if (sure <= periods_ || sure - periods_ < periods) member->sure_periods = periods_ + look(*member);
  }
  for (std::size_t i = 0; i < open_.size() && periods != 0;) {
    Link& link = *open_[i];
    periods = std::min(periods, possible_periods(link, periods));
    if (periods == 0) waits_outside_ = false;
    if (is_sure(link)) {
      open_[i] = open_.back();
      open_.pop_back();
    } else {
      ++i;
    }
  }
  if (periods == 0) return false;
  periods_ += periods;
  for (const std::vector<Member*>* members : {&irregular_, &regular_}) {
    for (Member* member : *members) {
      notify_listeners(*member, periods, Notify::kImpatient);
      member->done += periods * member->firings;
    }
  }
  for (Member* member : irregular_) commit_events(*member, member->base + member->done);
  return true;
}

// Adds `periods` to those that the stage's listeners do not know of yet, and notifies of them those whose
// patience is at an end, or all. Each is called as if it were the only one.
void Leap::notify_listeners(Member& member, std::uint64_t periods, Notify whom) {
  Stage& stage = *member.stage;
  if (!stage.listeners_.any()) return;
  // One that was added or removed meanwhile: all knew of everything then.
  member.untold.resize(stage.listeners_.size());
  auto untold = member.untold.begin();
  for (StageListener* listener : stage.listeners_) {
    std::uint64_t& waiting = *untold++;
    waiting += periods;
    if (waiting == 0 || (whom == Notify::kImpatient && waiting * member.firings < listener->patience())) {
      continue;
    }
    const Cycles later(period_ * as_signed(periods_ - waiting + 1));
    listener->repeated(stage, member.observed, later, Cycles(period_), std::exchange(waiting, 0));
  }
}

// Follows the schedule as long as it keeps to the pattern.
void Leap::scan(Member& member) {
  const Stage& stage = *member.stage;
  const Schedule& schedule = stage.schedule_;
  if (member.ended) return;
  if (member.unit > 1) {
    const Schedule::Segment& segment = schedule.segments()[member.cursor.segment];
    std::uint64_t gone = member.cursor.count;
    for (std::uint32_t i = 0; i < member.cursor.phase; ++i) {
      gone += schedule.phases()[segment.first_phase + i].count;
    }
    member.scanned += (segment.repeat - member.cursor.repetition) * member.unit - gone;
    member.ended = true;
    return;
  }
  const std::uint64_t target = member.base + member.done + kScannedAhead;
  const auto ports = [](unsigned consume, unsigned produce) { return consume | produce << 8U; };
  const unsigned core = ports(member.core_in, member.core_out);
  const unsigned common = ports(member.common.consume, member.common.produce);
  const std::size_t segments = schedule.segments().size();
  const Schedule::Segment* const all = schedule.segments().data();
  const Phase* const phases = schedule.phases().data();
  // The cursor, a variable each: a Position that is copied as one word after a part of it was written is a
  // store-forwarding stall (some 4 ns).
  std::size_t number = member.cursor.segment;
  std::uint64_t repetition = member.cursor.repetition;
  std::uint32_t phase_number = member.cursor.phase;
  std::uint32_t count = member.cursor.count;
  std::uint64_t scanned = member.scanned;
  while (scanned < target && member.events.size() < kEventsAhead) {
    if (number == segments) {
      member.ended = true;
      break;
    }
    const Schedule::Segment& segment = all[number];
    const Phase& phase = phases[segment.first_phase + phase_number];
    // As same_in(), at once: this is gone through for each word of the map.
    const unsigned here = ports(phase.consume, phase.produce);
    const unsigned loose = here & ~core;
    if (((here ^ common) & core) != 0 || phase.interval != member.common.interval ||
        phase.idle != member.common.idle) {
      member.ended = true;
      break;
    }
    if (loose != 0) {
      if (loose > 0xffU && within(phase.produce, member.core_out) != 0) {
        member.ended = true;  // a firing that writes to both kinds of stream is left to itself
        break;
      }
      Event& event = member.events.add();
      event.firing = scanned;
      event.consume = mask(loose & 0xffU);
      event.produce = mask(loose >> 8U);
      event.pending = false;
      event.position.segment = number;
      event.position.repetition = repetition;
      event.position.phase = phase_number;
      event.position.count = count;
      ++scanned;
      if (++count < phase.count) continue;
    } else if (segment.phase_count == 1) {  // all repetitions are alike
      scanned += phase.count - count + (segment.repeat - repetition - 1) * phase.count;
      repetition = segment.repeat - 1;
    } else {
      scanned += phase.count - count;
    }
    count = 0;
    if (++phase_number < segment.phase_count) continue;
    phase_number = 0;
    if (++repetition < segment.repeat) continue;
    repetition = 0;
    ++number;
  }
  member.cursor.segment = number;
  member.cursor.repetition = repetition;
  member.cursor.phase = phase_number;
  member.cursor.count = count;
  member.scanned = scanned;
}

// Firings that keep to the pattern and whose irregular tokens and slots are known to be there in time.
// `outside`: it may become more when more is known.
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

// Writes what waits in the pipeline of a stage that writes irregularly, as far as it is known when there is
// room. False when it was held back: no leap goes over that.
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
    firing.room = nullptr;
    firing.wait = StageActivity::kBlocked;
    ++stage.left_;
    for (StreamBase* stream : stage.outputs_.of_mask[firing.produce])
      stream->mark_written(written, Cycles(0));
    stage.note_write(firing.frame, written);
    member.last_event_write = written;
  }
  return true;
}

Leap::Check Leap::check(Member& member, Event& event) {
  const Stage& stage = *member.stage;
  const auto [index, later] = in_period(member, event.firing);
  const Cycles free = member.observed[index].free + later;
  event.start = member.observed[index].start + later;
  const Cycles written = event.start + Cycles(stage.latency_);
  for (const Link* link : member.loose_in) {
    if (!contains(event.consume, link->reader_port)) continue;
    StreamBase& stream = *link->stream;
    const std::uint64_t token = stream.statistics_.read + link->claimed_reads;
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
    for (const Link* link : member.loose_out) {
      if (!contains(event.produce, link->writer_port) || pending) continue;
      if (!link->stream->write_date_known(link->claimed_writes)) {
        pending = true;
        link->stream->wait_for_room();
      } else if (link->stream->writable_at(link->claimed_writes) > (stage.latency_ == 0 ? free : written)) {
        return Check::kLate;
      }
    }
    // Where it is not known when there will be room, the firing can wait in the pipeline.
    if (pending && stage.entered_ - stage.left_ + member.claimed_pending >= stage.latency_)
      return Check::kUnknown;
    if (pending) {
      ++member.claimed_pending;
    } else {
      member.last_event_write = written;
    }
  }
  for (Link* link : member.loose_in) {
    if (contains(event.consume, link->reader_port)) ++link->claimed_reads;
  }
  for (Link* link : member.loose_out) {
    if (!pending && contains(event.produce, link->writer_port)) ++link->claimed_writes;
  }
  event.pending = pending;
  return Check::kInTime;
}

// Whether the stream holds no stage back any more, however many periods.
bool Leap::is_sure(const Link& link) {
  if (link.reads != link.writes) return false;
  if (link.reads == 0) return true;
  return (link.reads_bind || link.sure_reads >= link.base_written) &&
         (link.writes_bind || link.sure_writes >= link.base_read + link.stream->depth());
}

// Periods, of those wanted, for which the stream is known to hold no stage back more than in the period
// observed.
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
      const std::uint64_t period = (link.sure_reads - link.base_read) / link.reads;
      const std::uint64_t index = (link.sure_reads - link.base_read) % link.reads;
      const Cycles needed = stream.read_watch_.ready[index] + Cycles(period_ * as_signed(period + 1));
      if (stream.forward(stream.write_date(link.sure_reads)) > needed) {
        periods = std::min(periods, period - periods_);
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
      const std::uint64_t period = (link.sure_writes - link.base_written) / link.writes;
      const std::uint64_t index = (link.sure_writes - link.base_written) % link.writes;
      const Cycles needed = stream.write_watch_.ready[index] + Cycles(period_ * as_signed(period + 1));
      if (stream.backward(stream.read_date(link.sure_writes - stream.depth())) > needed) {
        periods = std::min(periods, period - periods_);
        break;
      }
    }
  }
  return periods;
}

void Leap::commit_events(Member& member, std::uint64_t until) {
  Stage& stage = *member.stage;
  const Event* last = nullptr;
  while (!member.events.empty() && member.events.front().firing < until) {
    const Event& event = member.events.front();
    last = &event;
    --member.checked;
    const Cycles start = event.start;
    for (Link* link : member.loose_in) {
      if (!contains(event.consume, link->reader_port)) continue;
      --link->claimed_reads;
      link->stream->mark_read(start, Cycles(0));
    }
    const PortMask produce = event.produce;
    const bool pending = event.pending;
    member.events.pop_front();
    if (produce == 0) continue;
    const Cycles written = start + Cycles(stage.latency_);
    stage.enter_pipeline(start, produce).left = written;
    if (pending) {
      --member.claimed_pending;
      continue;
    }
    stage.left_ = stage.entered_;
    for (Link* link : member.loose_out) {
      if (!contains(produce, link->writer_port)) continue;
      --link->claimed_writes;
      link->stream->mark_written(written, Cycles(0));
    }
    stage.note_write(stage.frame_number_, written);
  }
  if (last == nullptr) return;
  member.position = last->position;  // its slot in the ring is not taken before the next scan
  member.position_firing = last->firing;
}

Cycles Leap::start_of(const Member& member, std::uint64_t firing) const {
  const auto [index, later] = in_period(member, firing);
  return member.observed[index].start + later;
}

// Which firing of the period observed it is like, and how much later it comes.
std::pair<std::size_t, Cycles> Leap::in_period(const Member& member, std::uint64_t firing) const {
  const std::uint64_t since = firing - member.base;
  if (member.firings == 1) return {0, Cycles(period_ * as_signed(since + 1))};
  return {since % member.firings, Cycles(period_ * as_signed(since / member.firings + 1))};
}

}  // namespace parallax
