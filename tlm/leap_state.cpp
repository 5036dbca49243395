// SPDX-License-Identifier: Apache-2.0
// Leap: what the stages and streams are left with.
#include "tlm/leap.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "tlm/leap_detail.hpp"

namespace parallax {

using namespace leap_detail;

void Leap::materialize() {
  for (Member& member : members_) {
    if (member.active && member.takes_part) notify_listeners(member, 0, Notify::kAll);
  }
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
  if (member.position_firing > first) {
    stage.next_ = member.position;
    stage.skip(stage.next_, first + periods * member.firings - member.position_firing);
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
  // The entries of one period, from which all others follow; they may be overwritten below.
  std::vector<Stage::Firing> entered;
  std::vector<Stage::Firing> left;
  for (std::uint64_t i = 0; i < member.writes; ++i) {
    entered.push_back(stage.pipe_[(stage.entered_ - member.writes + i) & stage.pipe_mask_]);
    left.push_back(stage.pipe_[(stage.left_ - member.writes + i) & stage.pipe_mask_]);
  }
  const auto shift = [this](std::uint64_t number) { return Cycles(period_ * as_signed(number + 1)); };
  const std::uint64_t added = periods * member.writes;
  for (std::uint64_t i = added - std::min(added, size); i < added; ++i) {
    const Stage::Firing& model = entered[i % member.writes];
    Stage::Firing& entry = stage.pipe_[(stage.entered_ + i) & stage.pipe_mask_];
    entry.start = model.start + shift(i / member.writes);
    entry.produce = model.produce;
    entry.frame = stage.frame_number_;
  }
  for (std::uint64_t i = added - std::min(added, size); i < added; ++i) {
    const Stage::Firing& model = left[i % member.writes];
    Stage::Firing& entry = stage.pipe_[(stage.left_ + i) & stage.pipe_mask_];
    entry.left = model.left + shift(i / member.writes);
    entry.wait = model.wait;
    entry.room = model.room;
  }
  stage.entered_ += added;
  stage.left_ += added;
  stage.last_write_ += later;
  stage.frames_.back().last_write += later;
}

void Leap::materialize(Link& link, std::uint64_t periods) {
  StreamBase& stream = *link.stream;
  const Cycles later(period_ * as_signed(periods));
  const auto extend = [&](std::vector<Cycles>& dates, std::uint64_t from, std::uint64_t step) {
    std::vector<Cycles>& model = model_;
    model.clear();
    for (std::uint64_t i = from - step; i < from; ++i) model.push_back(dates[i & stream.mask_]);
    const std::uint64_t added = periods * step;
    const std::uint64_t begin = added - std::min<std::uint64_t>(added, stream.mask_ + 1);
    std::uint64_t index = begin % step;
    Cycles shift(period_ * as_signed(begin / step + 1));
    for (std::uint64_t i = begin; i < added; ++i) {
      dates[(from + i) & stream.mask_] = model[index] + shift;
      if (++index == step) {
        index = 0;
        shift += Cycles(period_);
      }
    }
  };
  StreamStatistics& statistics = stream.statistics_;
  if (link.writes != 0) {
    extend(stream.write_dates_, statistics.written, link.writes);
    for (StreamListener* listener : stream.listeners_) {
      listener->written_again(stream, model_, Cycles(period_), periods);
    }
    statistics.written += periods * link.writes;
    statistics.blocked_on_full += link.blocked * as_signed(periods);
    stream.last_write_ = stream.write_date(statistics.written - 1);
    stream.reader_waits_ = false;
  }
  if (link.reads != 0) {
    extend(stream.read_dates_, statistics.read, link.reads);
    for (StreamListener* listener : stream.listeners_) {
      listener->read_again(stream, model_, Cycles(period_), periods);
    }
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

// Lets streams whose fill repeats itself say so from here on.
void Leap::announce() {
  for (Link& link : links_) {
    if (!link.core || link.reads != link.writes || link.reads == 0) continue;
    StreamBase::Ahead& ahead = link.stream->ahead_;
    ahead = {&periods_, &materialized_, Cycles(period_), link.writes};
    for (const auto& [level, cycles] : link.levels) {
      ahead.token_cycles += level * cycles;
      if (level == 0) ahead.empty_cycles += cycles;
      if (level == link.stream->depth()) ahead.full_cycles += cycles;
    }
  }
}

// Gives the stages back to themselves.
void Leap::release() {
  materialize();
  for (const Link& link : links_) link.stream->ahead_ = {};
  holding_ = false;
  release_asked_ = false;
  for (Member& member : members_) {
    if (member.active && !member.takes_part) continue;
    // Woken, each says anew what it waits for.
    for (const std::size_t l : member.in) links_[l].stream->reader_waits_ = false;
    for (const std::size_t l : member.out) links_[l].stream->writer_waits_ = false;
    dataflow_.release(*member.stage);
    member.looks_still = 0;
  }
  // Who moves from here on is to be seen, and soon.
  for (Member& member : members_) member.seen_firings = member.stage->statistics_.firings;
  wide_ = false;
  dataflow_.look_anew();
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
      first = std::min(
          first, std::max(leaves, stage.last_write_ + Cycles(1)) + (member.writes != 0 ? later : Cycles(0)));
    }
  }
  return clock_.time_of(std::max(Cycles(0), first - Cycles(1)));
}

}  // namespace parallax
