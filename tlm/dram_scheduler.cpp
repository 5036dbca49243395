// SPDX-License-Identifier: Apache-2.0
#include "tlm/dram_scheduler.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tlm/error.hpp"

namespace parallax {
namespace {

// A burst's tag in the controller: the port, and the number of the read at it.
constexpr std::uint64_t kPorts = 256;
// Bursts: more than wait for anything.
constexpr std::uint64_t kMany = std::uint64_t{1} << 32;

}  // namespace

DramScheduler::DramScheduler(const DramMemory& memory)
    : memory_(memory),
      period_((memory.timing.validate(), memory.timing.clock_period_ps)),
      rate_(1, period_),
      burst_bytes_(memory.timing.burst_bytes()),
      burst_clocks_(memory.timing.burst_clocks()),
      address_(memory.timing, memory.mapping),
      controller_(memory.timing, memory.policy) {
  if (memory.latency < 0)
    throw UserError(fmt::format("memory.latency_cycles = {}: must be at least 0", memory.latency));
}

void DramScheduler::bind(MemoryQueues& queues) {
  queues_ = &queues;
  if (queues.ports() > kPorts) SC_REPORT_ERROR("/parallax/memory/ports", "a DRAM has at most 256 ports");
  ports_.resize(queues.ports());
  arrival_dates_.assign(queues.ports(), MemoryQueues::kNever);
  arrivals_.assign(queues.ports(), DramController::kNever);
  if (queues.ports() > 0) current_ = queues.ports() - 1;  // the first turn is the first port's
}

double DramScheduler::usable_bandwidth() const {
  return memory_.timing.peak_bandwidth() * static_cast<double>(memory_.policy.efficiency) / 100.0;
}

void DramScheduler::serve_until(Picoseconds date, bool inclusive, MemoryService& service) {
  const Clock clock = clock_at_or_after(date);
  if (beats_.size() > kBeats) count_beats(clock);  // or they pile up until the statistics are read
  const Clock limit = clock + (inclusive && date_of(clock) == date ? 1 : 0);
  if (limit <= decided_) return;
  enter_until(limit, service);
  run_controller(limit, service);
  decided_ = limit;
}

// Lets bursts in, in all clocks before `limit`.
void DramScheduler::enter_until(Clock limit, MemoryService& service) {
  look_at_heads();
  while (!queues_->empty()) {
    // A request under way goes on: what had room then has room now.
    const PortBursts& port = ports_[current_];
    if (port.bursts_left != 0 && next_ < limit && controller_.room(port.write)) {
      run_controller(next_ + 1, service);
      enter(current_, limit, service);
      continue;
    }
    const Clock entry = next_entry();
    if (entry >= limit) return;  // and what comes may come earlier
    next_ = entry;
    run_controller(next_, service);
    if (choose(next_)) {
      run_controller(next_ + 1, service);
      if (!serve_alone(current_, limit, service)) enter(current_, limit, service);
    } else {
      next_ = std::min(next_change(next_), limit);  // what comes after it is not known
    }
  }
}

void DramScheduler::look_at_heads() {
  for (std::size_t id = 0; id < arrivals_.size(); ++id) look_at_head(id);
}

// Clock in which some burst could enter at the earliest, if there is room.
DramScheduler::Clock DramScheduler::next_entry() const {
  Clock first = DramController::kNever;
  for (const Clock arrival : arrivals_) first = std::min(first, arrival);
  return std::max(first, next_);
}

bool DramScheduler::can_enter(std::size_t id, Clock clock) const {
  return arrivals_[id] <= clock && controller_.room(queues_->head(id).payload->is_write());
}

// Makes the port current whose burst enters in `clock`; false if none can.
bool DramScheduler::choose(Clock clock) {
  if (ports_[current_].bursts_left != 0 && can_enter(current_, clock)) return true;
  const bool all_enter = controller_.room(false) && controller_.room(true);
  const bool in_turn = memory_.arbitration == MemoryArbitration::kRoundRobin;
  std::size_t id = in_turn ? current_ + 1 : 0;
  for (std::size_t i = 0; i < ports_.size(); ++i, ++id) {
    if (id >= ports_.size()) id -= ports_.size();
    if (arrivals_[id] > clock || (!all_enter && !can_enter(id, clock))) continue;
    current_ = id;
    return true;
  }
  return false;
}

// No burst can enter in `clock`: the first later one in which one might.
DramScheduler::Clock DramScheduler::next_change(Clock clock) {
  Clock next = controller_.next_command();
  if (next != DramController::kNever) ++next;
  for (const Clock arrival : arrivals_) {
    if (arrival > clock) next = std::min(next, arrival);
  }
  return std::max(next, clock + 1);
}

std::uint64_t DramScheduler::bursts_of(const ::tlm::tlm_generic_payload& payload) const {
  const std::uint64_t begin = payload.get_address() % burst_bytes_;
  return (begin + std::max(1U, payload.get_data_length()) + burst_bytes_ - 1) / burst_bytes_;
}

// The controller was idle until something enters in this clock.
void DramScheduler::begins_work(Clock clock) {
  if (clock < work_end_) return;  // its last beats are not over
  work_ += work_end_ - work_begin_;
  work_begin_ = clock;
}

// The port's first request from its entry in clock next_ to its last command, if nothing else comes in
// between.
bool DramScheduler::serve_alone(std::size_t id, Clock limit, MemoryService& service) {
  if (!controller_.idle() || ports_[id].bursts_left != 0) return false;
  const ::tlm::tlm_generic_payload& payload = *queues_->head(id).payload;
  const std::uint64_t bursts = bursts_of(payload);
  const std::uint64_t first = payload.get_address() / burst_bytes_ * burst_bytes_;
  if (bursts > address_.bursts_in_row(first)) return false;
  for (std::size_t other = 0; other < arrivals_.size(); ++other) {
    if (other != id) limit = std::min(limit, arrivals_[other] + (arrivals_[other] < limit ? 1 : 0));
  }
  if (const Picoseconds second = queues_->second_arrival(id); second != MemoryQueues::kNever) {
    limit = std::min(limit, std::max(clock_at_or_after(second), next_ + static_cast<Clock>(bursts)) + 1);
  }
  const bool write = payload.is_write();
  if (!controller_.serve_alone({address_.locate(first), id, write}, bursts, next_, limit, done_))
    return false;
  begins_work(next_);
  next_ += static_cast<Clock>(bursts);
  for (const DramController::Done& done : done_) add_beats(done.data_end, id);
  work_end_ = done_.back().data_end;
  done_.clear();
  const MemoryRequest request = queues_->pop(id, date_of(next_));
  look_at_head(id);
  service.served(id, request);
  service.answered(id, request, date_of((write ? next_ : work_end_) + memory_.latency));
  return true;
}

// The next burst of the port's first request enters in clock next_, and those after it, one a clock before
// `limit`, before which nothing else is decided.
void DramScheduler::enter(std::size_t id, Clock limit, MemoryService& service) {
  PortBursts& port = ports_[id];
  if (port.bursts_left == 0) {
    const ::tlm::tlm_generic_payload& payload = *queues_->head(id).payload;
    port.bursts_left = bursts_of(payload);
    port.next = payload.get_address() / burst_bytes_ * burst_bytes_;
    port.in_row = 0;
    port.write = payload.is_write();
    if (!port.write) {
      Read& read = port.reads.add();
      read.bursts_left = port.bursts_left;
      read.end = 0;
      ++reads_;
    }
  }
  const bool write = port.write;
  if (controller_.idle()) begins_work(next_);
  if (port.in_row == 0) {
    port.location = address_.locate(port.next);
    port.in_row = address_.bursts_in_row(port.next);
  }
  const std::uint64_t number = write ? 0 : port.first_read + port.reads.size() - 1;
  const DramController::Burst burst{port.location, number * kPorts + id, write};
  std::uint64_t entering =
      std::min<std::uint64_t>({port.bursts_left, port.in_row, static_cast<std::uint64_t>(limit - next_),
                               controller_.may_join(burst, next_)});
  if (entering == 0) {
    entering = 1;
    controller_.submit(burst, next_);
  } else {
    controller_.join(burst, entering, next_);
  }
  port.next += entering * burst_bytes_;
  port.in_row -= entering;
  next_ += static_cast<Clock>(entering);
  port.bursts_left -= entering;
  if (port.bursts_left > 0) return;
  const MemoryRequest request = queues_->pop(id, date_of(next_));
  look_at_head(id);
  if (!write) port.reads[port.reads.size() - 1].request = request;
  service.served(id, request);
  if (write) service.answered(id, request, date_of(next_ + memory_.latency));
}

void DramScheduler::take_done(MemoryService& service) {
  for (const DramController::Done& done : done_) {
    const std::size_t id = done.tag % kPorts;
    PortBursts& port = ports_[id];
    add_beats(done.data_end, id);
    work_end_ = std::max(work_end_, done.data_end);
    if (done.write) continue;
    Read& read = port.reads[done.tag / kPorts - port.first_read];
    read.end = std::max(read.end, done.data_end);
    --read.bursts_left;
    while (!port.reads.empty() && port.reads.front().bursts_left == 0) {
      const Clock end = port.reads.front().end;
      service.answered(id, port.reads.front().request, date_of(end + memory_.latency));
      port.reads.pop_front();
      --reads_;
      ++port.first_read;
      if (!port.reads.empty()) port.reads.front().end = std::max(port.reads.front().end, end);
    }
  }
  done_.clear();
}

// In which the last burst of the port's first request, which there is, could enter at the earliest.
DramScheduler::Clock DramScheduler::last_entry(std::size_t id) {
  look_at_head(id);
  const PortBursts& port = ports_[id];
  const ::tlm::tlm_generic_payload& payload = *queues_->head(id).payload;
  const std::uint64_t bursts = port.bursts_left != 0 ? port.bursts_left : bursts_of(payload);
  const Clock first = std::max({arrivals_[id], next_, decided_});
  const Clock last = first + static_cast<Clock>(bursts) - 1;
  const std::size_t room = controller_.room_for(payload.is_write());
  if (bursts <= room) return last;
  // Each of the others takes the place of one that goes before it, which may be one of its own.
  const Clock command =
      room == 0 ? controller_.next_command() : std::min(controller_.next_command(), first + 1);
  return std::max(last, command + static_cast<Clock>(bursts - room - 1) * controller_.least_pace() + 1);
}

// In which some burst that waits could enter at the earliest, if there is room; needs one.
DramScheduler::Clock DramScheduler::entry_bound() {
  look_at_heads();
  const Clock first = std::max(next_, decided_);
  if (controller_.room(false) && controller_.room(true)) return std::max(next_entry(), first);
  const Clock room = controller_.next_command() + 1;
  Clock bound = DramController::kNever;
  for (std::size_t id = 0; id < arrivals_.size(); ++id) {
    if (arrivals_[id] == DramController::kNever) continue;
    Clock clock = std::max(arrivals_[id], first);
    if (!controller_.room(queues_->head(id).payload->is_write())) clock = std::max(clock, room);
    bound = std::min(bound, clock);
  }
  return bound;
}

Picoseconds DramScheduler::next_answer() {
  const DramTiming& timing = memory_.timing;
  Clock next = DramController::kNever;
  if (reads_ > 0 && !controller_.idle()) {
    // A port's oldest read is answered when as many bursts have gone as it still waits for.
    std::uint64_t bursts = kMany;
    for (const PortBursts& port : ports_) {
      if (!port.reads.empty()) bursts = std::min(bursts, port.reads.front().bursts_left);
    }
    next = std::max(controller_.next_command(), decided_) +
           static_cast<Clock>(bursts - 1) * controller_.least_pace() + timing.cl + timing.burst_clocks();
  }
  // A read's first command comes in the clock after its entry; a write is answered after its last burst's.
  if (!queues_->empty()) next = std::min(next, entry_bound() + 1);
  return next == DramController::kNever ? MemoryQueues::kNever : date_of(next + memory_.latency);
}

Picoseconds DramScheduler::next_slot() {
  Clock next = DramController::kNever;
  for (std::size_t id = 0; id < ports_.size(); ++id) {
    if (queues_->has_refused(id)) next = std::min(next, last_entry(id));
  }
  return date_of(next + 1);
}

void DramScheduler::add_beats(Clock end, std::size_t id) {
  const Clock begin = end - burst_clocks_;
  if (last_beats_.end != begin || last_beats_.port != id) {
    keep_last_beats();
    last_beats_.begin = begin;
    last_beats_.port = id;
  }
  last_beats_.end = end;
}

void DramScheduler::keep_last_beats() {
  if (last_beats_.begin == last_beats_.end) return;
  Beats& beats = beats_.add();
  beats.begin = last_beats_.begin;
  beats.end = last_beats_.end;
  beats.port = last_beats_.port;
  last_beats_.begin = last_beats_.end;
}

void DramScheduler::count_beats(Clock clock) {
  keep_last_beats();
  for (; !beats_.empty() && beats_.front().end <= clock; beats_.pop_front()) {
    ports_[beats_.front().port].bus += Cycles(beats_.front().end - beats_.front().begin);
  }
}

Cycles DramScheduler::bus_taken(std::size_t port, Picoseconds date) {
  const Clock clock = clock_at_or_after(date);
  count_beats(clock);
  Cycles taken = ports_[port].bus;
  if (!beats_.empty() && beats_.front().port == port) {
    taken += Cycles(std::max<Clock>(0, clock - beats_.front().begin));
  }
  return taken;
}

Cycles DramScheduler::at_work(Picoseconds date) {
  const Clock clock = clock_at_or_after(date);
  const Clock end = controller_.idle() ? std::min(clock, work_end_) : clock;
  return Cycles(work_ + std::max<Clock>(0, end - work_begin_));
}

}  // namespace parallax
