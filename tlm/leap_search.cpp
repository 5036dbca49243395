// SPDX-License-Identifier: Apache-2.0
// Leap: which stages and streams might be in periodic motion, and with which period.
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
  const auto link_of = [this](StreamBase* stream) -> std::size_t {
    const auto found =
        std::find_if(links_.begin(), links_.end(), [&](const Link& link) { return link.stream == stream; });
    if (found != links_.end()) return found - links_.begin();
    links_.emplace_back();
    links_.back().stream = stream;
    return links_.size() - 1;
  };
  for (Member& member : members_) {
    for (unsigned port = 0; port < member.stage->inputs_.count; ++port) {
      for (StreamBase* stream : member.stage->inputs_.of_mask[1u << port]) {
        member.in.push_back(link_of(stream));
        links_[member.in.back()].read = true;
        links_[member.in.back()].reader_port = mask(1u << port);
      }
    }
    for (unsigned port = 0; port < member.stage->outputs_.count; ++port) {
      for (StreamBase* stream : member.stage->outputs_.of_mask[1u << port]) {
        member.out.push_back(link_of(stream));
        links_[member.out.back()].written = true;
        links_[member.out.back()].writer_port = mask(1u << port);
      }
    }
  }
}

bool Leap::can_move() const {
  return std::any_of(members_.begin(), members_.end(),
                     [](const Member& member) { return member.stage->can_fire(); });
}

Leap::Found Leap::attempt() {
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
  return classify() && find_period() ? observe() : Found::kNothing;
}

// Finds out who takes part: the stages that have moved lately, with the unit in which each repeats itself,
// and the streams that go along with it. Where a stage touches a stream irregularly, the stream is not core,
// for either end.
bool Leap::classify() {
  for (Link& link : links_) link.core = link.written && link.read && link.stream->same_frequency_;
  for (bool changed = true; changed;) {
    changed = false;
    for (Member& member : members_) {
      if (!member.active) continue;
      const auto core_ports = [&](const std::vector<std::size_t>& links, PortMask Link::*port) {
        unsigned all = 0;
        unsigned off = 0;
        for (const std::size_t l : links) {
          const Link& link = links_[l];
          all |= link.*port;
          if (!link.core) off |= link.*port;
        }
        return mask(all & ~off);
      };
      const auto demote = [&](const std::vector<std::size_t>& links, PortMask Link::*port, PortMask kept) {
        for (const std::size_t l : links) {
          Link& link = links_[l];
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
  irregular_.clear();
  regular_.clear();
  for (Member& member : members_) {
    if (!member.active || !member.takes_part) continue;
    const auto loose = [this](const std::vector<std::size_t>& links, std::vector<Link*>& found) {
      found.clear();
      for (const std::size_t l : links) {
        Link& link = links_[l];
        if (!link.core) found.push_back(&link);
      }
    };
    loose(member.in, member.loose_in);
    loose(member.out, member.loose_out);
    (member.loose_in.empty() && member.loose_out.empty() ? regular_ : irregular_).push_back(&member);
  }
  return !irregular_.empty() || !regular_.empty();
}

// The firings after which the stage does the same again, in what it does to core ports: one, where they are
// all alike, else a repetition of the segment. In a list of single phases, ports that only some firings touch
// are `mixed`.
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
    if (segment.repeat - stage.next_.repetition < 3) return false;
    member.unit = 0;
    unsigned consume = 0;
    unsigned produce = 0;
    for (const Phase* phase = phases; phase != phases + segment.phase_count; ++phase) {
      member.unit += phase->count;
      consume |= phase->consume;
      produce |= phase->produce;
    }
    member.common = fires().reads(consume).writes(produce);
    return member.unit <= kLargestUnit && (consume & ~unsigned{member.core_in}) == 0 &&
           (produce & ~unsigned{member.core_out}) == 0;
  }
  unsigned any_in = 0, any_out = 0;
  unsigned all_in = 0xff, all_out = 0xff;
  std::uint64_t looked = 0;
  Stage::Position at = stage.next_;
  while (looked < kLookedAt && at.segment < schedule.segments().size()) {
    const Schedule::Segment& here = schedule.segments()[at.segment];
    const Phase& phase = schedule.phases()[here.first_phase + at.phase];
    if (phase.interval != member.common.interval || phase.idle != member.common.idle) break;
    any_in |= phase.consume;
    any_out |= phase.produce;
    all_in &= phase.consume;
    all_out &= phase.produce;
    const std::uint32_t count = phase.count - at.count;
    looked += count;
    stage.skip(at, count);
  }
  mixed_in = within(mask(any_in & ~all_in), member.core_in);
  mixed_out = within(mask(any_out & ~all_out), member.core_out);
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

}  // namespace parallax
