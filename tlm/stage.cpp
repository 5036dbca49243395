// SPDX-License-Identifier: Apache-2.0
#include "tlm/stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace parallax {

Stage::Stage(const sc_core::sc_module_name& name, const ClockDomain& clock, Dataflow& dataflow,
             std::uint32_t latency)
    : sc_module(name), clock_(clock), dataflow_(dataflow), latency_(latency), left_(latency) {}

void Stage::end_of_elaboration() {
  std::size_t in = 0;
  std::size_t out = 0;
  for (sc_core::sc_object* child : get_child_objects()) {
    auto* port = dynamic_cast<StreamPort*>(child);
    if (port == nullptr) continue;
    if ((port->is_input() ? in : out) == kMaxPorts) {
      throw std::logic_error(fmt::format("{}: more than {} stream ports one way", name(), kMaxPorts));
    }
    (port->is_input() ? inputs_[in++] : outputs_[out++]) = port->streams();
  }
  for (const Phase& phase : schedule_.phases()) {
    if ((phase.consume >> in) != 0 || (phase.produce >> out) != 0 || phase.interval == 0) {
      throw std::logic_error(fmt::format("{}: the schedule names a port that does not exist", name()));
    }
  }
}

void Stage::start_of_simulation() { dataflow_.wake(*this); }

template <class Function>
void Stage::for_each(const std::array<std::vector<StreamBase*>, kMaxPorts>& ports, PortMask mask,
                     Function function) {
  for (std::size_t port = 0; mask != 0; ++port, mask = static_cast<PortMask>(mask >> 1)) {
    if ((mask & 1u) == 0) continue;
    for (StreamBase* stream : ports[port]) function(*stream);
  }
}

void Stage::advance() {
  if (schedule_.empty()) return;
  drain();
  while (fire()) drain();
}

// Starts the next firing if its date is known.
bool Stage::fire() {
  const bool frame_begins = next_.segment == 0 && next_.pass == 0 && next_.phase == 0 && next_.count == 0;
  if (frame_begins && frame_limit_ != 0 && frames_.size() == frame_limit_) return false;
  const Schedule::Segment& segment = schedule_.segments()[next_.segment];
  const Phase& phase = schedule_.phases()[segment.first_phase + next_.phase];

  bool known = true;
  Cycles inputs(0);
  StreamBase* latest = nullptr;
  for_each(inputs_, phase.consume, [&](StreamBase& stream) {
    if (!stream.read_date_known()) {
      stream.wait_for_token();
      known = false;
    } else if (const Cycles date = stream.readable_at(); date > inputs || latest == nullptr) {
      inputs = date;
      latest = &stream;
    }
  });

  Cycles room(0);
  if (phase.produce != 0) {
    if (latency_ == 0) {
      for_each(outputs_, phase.produce, [&](StreamBase& stream) {
        if (!stream.write_date_known()) {
          stream.wait_for_room();
          known = false;
        } else {
          room = std::max(room, stream.writable_at());
        }
      });
    } else if (pipe_.size() == latency_) {
      known = false;  // drain() has said which stream it waits for
    } else if (left_count_ + pipe_.size() >= latency_) {
      room = left_[(left_count_ + pipe_.size()) % latency_];
    }
  }
  if (!known) return false;

  const Cycles ready = std::max(free_, inputs);
  const Cycles start = std::max(ready, room);
  const Cycles starved = ready - free_;
  for_each(inputs_, phase.consume,
           [&](StreamBase& stream) { stream.mark_read(start, &stream == latest ? starved : Cycles(0)); });
  statistics_.starved += starved;
  statistics_.blocked += start - ready;
  (phase.consume == 0 && phase.produce == 0 ? statistics_.idle : statistics_.busy) += Cycles(phase.interval);
  ++statistics_.firings;

  if (frame_begins) {
    frames_.push_back({start, start, Cycles(-1), Cycles(-1)});
  }
  frames_.back().last_firing = start;
  free_ = start + Cycles(phase.interval);
  if (phase.produce != 0) {
    const Pending firing{start, phase.produce, static_cast<std::uint32_t>(frames_.size() - 1)};
    if (latency_ == 0) {
      write(firing, start);
    } else {
      pipe_.push_back(firing);
    }
  }
  step(phase);
  return true;
}

void Stage::drain() {
  while (!pipe_.empty() && write(pipe_.front(), pipe_.front().start + Cycles(latency_))) {
    left_[left_count_++ % latency_] = last_write_;
    pipe_.pop_front();
  }
}

// Writes a firing's tokens if it is known when all its outputs have room.
bool Stage::write(const Pending& firing, Cycles earliest) {
  bool known = true;
  Cycles room(0);
  StreamBase* latest = nullptr;
  for_each(outputs_, firing.produce, [&](StreamBase& stream) {
    if (!stream.write_date_known()) {
      stream.wait_for_room();
      known = false;
    } else if (const Cycles date = stream.writable_at(); date > room || latest == nullptr) {
      room = date;
      latest = &stream;
    }
  });
  if (!known) return false;
  const Cycles wanted = std::max(earliest, last_write_ + Cycles(1));
  last_write_ = std::max(wanted, room);
  const Cycles blocked = last_write_ - wanted;
  for_each(outputs_, firing.produce, [&](StreamBase& stream) {
    stream.mark_written(last_write_, &stream == latest ? blocked : Cycles(0));
  });
  FrameDates& frame = frames_[firing.frame];
  if (frame.first_write < Cycles(0)) frame.first_write = last_write_;
  frame.last_write = last_write_;
  return true;
}

void Stage::step(const Phase& phase) {
  if (++next_.count < phase.count) return;
  next_.count = 0;
  const Schedule::Segment& segment = schedule_.segments()[next_.segment];
  if (++next_.phase < segment.phase_count) return;
  next_.phase = 0;
  if (++next_.pass < segment.repeat) return;
  next_.pass = 0;
  if (++next_.segment == schedule_.segments().size()) next_.segment = 0;
}

}  // namespace parallax
