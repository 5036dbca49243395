// SPDX-License-Identifier: Apache-2.0
#include "tlm/stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "tlm/firing_rule.hpp"

namespace parallax {

Stage::Stage(const sc_core::sc_module_name& name, const ClockDomain& clock, Dataflow& dataflow,
             std::uint32_t latency)
    : sc_module(name), clock_(clock), dataflow_(dataflow), latency_(latency) {
  std::size_t size = 1;
  while (size < latency + kLeapHistory) size *= 2;
  pipe_.resize(size);
  pipe_mask_ = size - 1;
  dataflow.add(*this);
}

Stage::~Stage() = default;

void Stage::end_of_elaboration() {
  StreamsOfPorts in;
  StreamsOfPorts out;
  for (sc_core::sc_object* child : get_child_objects()) {
    auto* port = dynamic_cast<StreamPort*>(child);
    if (port != nullptr) (port->is_input() ? in : out).push_back(port->streams());
  }
  const std::size_t most = writing_side_ ? StageSchedule::kHandedPort : kMaxPorts;
  if (in.size() > most || out.size() > most) {
    throw std::logic_error(fmt::format("{}: more than {} stream ports one way", name(), most));
  }
  if (writing_side_) {
    share_ports(std::move(in), std::move(out));
  } else {
    bind_ports(in, out);
  }
}

void Stage::bind_ports(const StreamsOfPorts& in, const StreamsOfPorts& out) {
  for (const Phase& phase : schedule_.phases()) {
    if ((phase.consume >> in.size()) != 0 || (phase.produce >> out.size()) != 0 || phase.interval == 0) {
      throw std::logic_error(fmt::format("{}: the schedule names a port that does not exist", name()));
    }
  }
  if (!schedule_.empty()) phase_ = &phase_at(next_);
  inputs_ = gather(in);
  outputs_ = gather(out);
}

// Lays the streams of every mask out one after the other, so that a firing goes through a plain array.
Stage::Ports Stage::gather(const StreamsOfPorts& ports) {
  Ports all;
  all.count = ports.size();
  std::vector<std::size_t> ends;
  for (unsigned mask = 0; mask < (1u << ports.size()); ++mask) {
    for (std::size_t port = 0; port < ports.size(); ++port) {
      if (((mask >> port) & 1u) != 0) {
        all.streams.insert(all.streams.end(), ports[port].begin(), ports[port].end());
      }
    }
    ends.push_back(all.streams.size());
  }
  std::size_t begin = 0;
  for (const std::size_t end : ends) {
    Streams streams{all.streams.data() + begin, all.streams.data() + end};
    streams.in_batches = fit_batches(streams);
    streams.at_memory = std::any_of(streams.begin(), streams.end(),
                                    [](const StreamBase* stream) { return stream->at_memory(); });
    all.of_mask.push_back(streams);
    begin = end;
  }
  return all;
}

std::vector<const StreamBase*> Stage::at_port(const Ports& ports, unsigned port) {
  if (port >= ports.count) return {};
  const Streams& streams = ports.of_mask[1u << port];
  return {streams.begin(), streams.end()};
}

void Stage::start_of_simulation() { dataflow_.wake(*this); }

void Stage::advance() {
  if (schedule_.empty()) return;
  const std::uint64_t before = statistics_.firings;
  for (;;) {
    const Batch batch = fire_batch();
    if (batch == Batch::kStopped) break;
    if (batch == Batch::kMoved) continue;
    drain();
    if (!fire()) break;
  }
  dataflow_.count_firings(statistics_.firings - before);
}

// Starts the next firing if its date is known.
bool Stage::fire() {
  const bool frame_begins = next_.is_start();
  if (frame_begins && frame_limit_ != 0 && frames_.size() == frame_limit_) return false;
  if (statistics_.firings == fire_limit_) return false;
  const Phase& phase = *phase_;

  bool known = true;
  Cycles inputs(0);
  const StreamBase* latest = nullptr;
  const Streams consumed = inputs_.of_mask[phase.consume];
  for (StreamBase* stream : consumed) {
    if (!stream->read_date_known()) {
      stream->wait_for_token();
      known = false;
    } else if (const Cycles date = stream->readable_at(); date > inputs || latest == nullptr) {
      inputs = date;
      latest = stream;
    }
  }

  Cycles room(0);
  StageActivity room_wait = StageActivity::kBlocked;
  const StreamBase* fullest = nullptr;
  if (phase.produce != 0) {
    if (latency_ == 0) {
      for (StreamBase* stream : outputs_.of_mask[phase.produce]) {
        if (!stream->write_date_known()) {
          stream->wait_for_room();
          known = false;
        } else if (const Cycles date = stream->writable_at(); date > room) {
          room = date;
          fullest = stream;
        }
      }
    } else if (entered_ - left_ == latency_) {
      known = false;  // drain() has said which stream it waits for
    } else if (entered_ >= latency_) {
      const Firing& ahead = pipe_[(entered_ - latency_) & pipe_mask_];
      room = ahead.left;
      room_wait = ahead.wait;
      fullest = ahead.room;
    }
  }
  if (!known) return false;

  const auto [ready, start] = FiringStart(free_, inputs, room);
  const Cycles starved = ready - free_;
  const Cycles blocked = start - ready;
  const StageActivity work = phase.idle ? StageActivity::kBlanking : StageActivity::kBusy;
  StageActivity input_wait = StageActivity::kStarved;
  if (starved > Cycles(0)) {
    input_wait = frame_begins && latest->at_memory() ? StageActivity::kBlanking
                                                     : wait_for_token(*latest, inputs, free_);
    statistics_.of(input_wait) += starved;
  }
  if (blocked > Cycles(0)) {
    if (latency_ == 0) {
      room_wait = wait_for_room(*fullest, room, ready);
      fullest->count_blocked(blocked);
    }
    statistics_.of(room_wait) += blocked;
  }
  if (observed_ != nullptr || listeners_.any()) {
    const FiringDates dates{free_,      ready,     start,  phase.interval, work,
                            input_wait, room_wait, latest, fullest};
    if (observed_ != nullptr) {
      observed_->push_back(dates);
      observe(phase, consumed);
    }
    for (StageListener* listener : listeners_) listener->fired(*this, dates);
  }
  starts_[statistics_.firings % kStartsKept] = start;
  for (StreamBase* stream : consumed) stream->mark_read(start, stream == latest ? starved : Cycles(0));
  if (frame_begins) begin_frame(start);
  (work == StageActivity::kBlanking ? statistics_.blanking : statistics_.busy) += Cycles(phase.interval);
  ++statistics_.firings;
  frame_->last_firing = start;
  free_ = start + Cycles(phase.interval);
  if (phase.produce != 0) {
    Firing& firing = enter_pipeline(start, phase.produce);
    if (latency_ == 0) {
      ++left_;
      write(firing);
    }
  }
  step();
  return true;
}

void Stage::drain() {
  while (left_ != entered_) {
    Firing& firing = pipe_[left_ & pipe_mask_];
    if (!write(firing)) return;
    ++left_;
  }
}

// Writes a firing's tokens if it is known when all its outputs have room.
bool Stage::write(Firing& firing) {
  bool known = true;
  Cycles room(0);
  const StreamBase* latest = nullptr;
  const Streams produced = outputs_.of_mask[firing.produce];
  for (StreamBase* stream : produced) {
    if (!stream->write_date_known()) {
      stream->wait_for_room();
      known = false;
    } else if (const Cycles date = stream->writable_at(); date > room || latest == nullptr) {
      room = date;
      latest = stream;
    }
  }
  if (!known) return false;
  const FiringEnd end(firing.start, latency_, last_write_, room);
  const Cycles wanted = end.wanted;
  if (observed_ != nullptr && latency_ != 0) {
    for (StreamBase* stream : produced) stream->watch_write(wanted);
  }
  last_write_ = end.left;
  firing.left = last_write_;
  const Cycles blocked = last_write_ - wanted;
  firing.room = blocked > Cycles(0) ? latest : nullptr;
  firing.wait = blocked > Cycles(0) ? wait_for_room(*latest, room, wanted) : StageActivity::kBlocked;
  for (StreamBase* stream : produced) {
    stream->mark_written(last_write_, stream == latest ? blocked : Cycles(0));
  }
  note_write(firing.frame, last_write_);
  return true;
}

// What a wait for the next token of `stream` counts as, or for its next slot, which is there in cycle `date`
// and was wanted in cycle `wanted`.
StageActivity Stage::wait_for_token(const StreamBase& stream, Cycles date, Cycles wanted) {
  if (stream.at_memory()) return StageActivity::kMemory;
  return stream.token_behind_synchroniser(date, wanted) ? StageActivity::kSynchroniser
                                                        : StageActivity::kStarved;
}

StageActivity Stage::wait_for_room(const StreamBase& stream, Cycles date, Cycles wanted) {
  if (stream.at_memory()) return StageActivity::kMemory;
  return stream.slot_behind_synchroniser(date, wanted) ? StageActivity::kSynchroniser
                                                       : StageActivity::kBlocked;
}

void Stage::note_write(std::uint32_t number, Cycles cycle) {
  FrameDates& frame = number == frame_number_ ? *frame_ : frames_[number];
  if (frame.first_write < Cycles(0)) frame.first_write = cycle;
  frame.last_write = cycle;
  last_write_ = cycle;
}

void Stage::begin_frame(Cycles cycle) {
  frames_.push_back({cycle, cycle, Cycles(-1), Cycles(-1), statistics_});
  frame_ = &frames_.back();
  frame_number_ = static_cast<std::uint32_t>(frames_.size() - 1);
}

// Whether the dates that the next firing needs are known.
bool Stage::can_fire() const {
  if (schedule_.empty()) return false;
  if (next_.is_start() && frame_limit_ != 0 && frames_.size() == frame_limit_) return false;
  const Phase& phase = *phase_;
  for (const StreamBase* stream : inputs_.of_mask[phase.consume]) {
    if (!stream->read_date_known()) return false;
  }
  if (phase.produce == 0) return true;
  if (latency_ != 0) return entered_ - left_ != latency_;
  for (const StreamBase* stream : outputs_.of_mask[phase.produce]) {
    if (!stream->write_date_known()) return false;
  }
  return true;
}

// Notes for Leap which streams hold this firing back.
void Stage::observe(const Phase& phase, Streams consumed) {
  for (StreamBase* stream : consumed) stream->watch_read(free_);
  if (latency_ != 0) return;
  for (StreamBase* stream : outputs_.of_mask[phase.produce]) stream->watch_write(free_);
}

// Moves a position on; at the frame's end it is left behind the last segment.
void Stage::skip(Position& position, std::uint64_t firings) const {
  while (firings > 0) {
    const Schedule::Segment& segment = schedule_.segments()[position.segment];
    const Phase* phases = schedule_.phases().data() + segment.first_phase;
    if (position.count + firings < phases[position.phase].count) {
      position.count += static_cast<std::uint32_t>(firings);
      return;
    }
    if (position.phase == 0 && position.count == 0 && segment.repeat > 1) {
      std::uint64_t in_one = 0;
      for (std::uint32_t i = 0; i < segment.phase_count; ++i) in_one += phases[i].count;
      const std::uint64_t whole = std::min(firings / in_one, segment.repeat - position.repetition);
      firings -= whole * in_one;
      position.repetition += whole;
      if (position.repetition == segment.repeat) {
        ++position.segment;
        position.repetition = 0;
        continue;
      }
      if (firings == 0) return;
    }
    const std::uint64_t step =
        std::min<std::uint64_t>(firings, phases[position.phase].count - position.count);
    firings -= step;
    position.count += static_cast<std::uint32_t>(step);
    if (position.count < phases[position.phase].count) return;
    next_phase(position);
  }
}

void Stage::step() {
  if (++next_.count < phase_->count) return;
  if (!next_phase(next_)) next_ = {};
  phase_ = &phase_at(next_);
}

}  // namespace parallax
