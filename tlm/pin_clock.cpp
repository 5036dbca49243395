// SPDX-License-Identifier: Apache-2.0
#include "tlm/pin_clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr std::uint32_t kAfterReset = 2 * (PinClock::kMostReset + 1);  // ps

PinClockConfig checked(const char* name, const ClockDomain& domain, const PinClockConfig& config) {
  const std::int64_t period = domain.date_of(Cycles(1)).count();
  if (period < PinClock::kShortest) {
    throw UserError(fmt::format("{}: a period of {} ps of clock '{}' is too short for pins; {} ps is enough",
                                name, period, domain.name(), PinClock::kShortest));
  }
  if (config.reset_cycles > PinClock::kMostReset) {
    throw UserError(fmt::format("{}: {} cycles in reset are outside 0 to {}", name, config.reset_cycles,
                                PinClock::kMostReset));
  }
  if (config.order > PinClock::kMostOrder) {
    throw UserError(
        fmt::format("{}: an order of {} is outside 0 to {}", name, config.order, PinClock::kMostOrder));
  }
  return config;
}

}  // namespace

PinClock::PinClock(const sc_core::sc_module_name& name, const ClockDomain& domain,
                   const PinClockConfig& config)
    : sc_module(name), domain_(domain), config_(checked(this->name(), domain, config)) {
  SC_HAS_PROCESS(PinClock);
  SC_METHOD(go);
  sensitive << next_;
}

void PinClock::wake() {
  if (phase_ == Phase::kRest) next_.notify(sc_core::SC_ZERO_TIME);
}

void PinClock::start_of_simulation() {
  with_all_ = std::any_of(ends_.begin(), ends_.end(), [](const PinEnd* end) { return end->counts_steps(); });
  for (PinEnd* end : ends_) end->idle();
  drive_pin(clock, false);
  drive_pin(enable, true);
  drive_pin(reset, (config_.reset_cycles > 0) != config_.reset_is_low);
}

void PinClock::go() {
  switch (phase_) {
    case Phase::kReset:
      return reset_edge();
    case Phase::kEdge:
      return edge();
    case Phase::kDrive:
      return drive();
    case Phase::kPass:
      return pass();
    case Phase::kFall:
      return fall();
    case Phase::kRest:
      return rest();
  }
}

void PinClock::at(Phase phase, const sc_core::sc_time& date) {
  phase_ = phase;
  next_.notify(date - sc_core::sc_time_stamp());
}

// Whatever happens at the edge itself is over a picosecond later; what follows has two for each circuit.
sc_core::sc_time PinClock::drive_date(Cycles cycle) const {
  const std::uint32_t later = (cycle == Cycles(0) ? kAfterReset : 0) + 1 + 2 * config_.order;
  return domain_.time_of(cycle) + sc_core::sc_time(later, sc_core::SC_PS);
}

// A rise or a fall each picosecond.
void PinClock::reset_edge() {
  if (sc_core::sc_time_stamp() != sc_core::SC_ZERO_TIME) {
    drive_pin(clock, reset_edges_ % 2 == 0 && reset_edges_ < 2 * config_.reset_cycles);
    if (++reset_edges_ > 2 * config_.reset_cycles) {
      drive_pin(reset, config_.reset_is_low);
      return at(Phase::kDrive, drive_date(Cycles(0)));
    }
  }
  at(Phase::kReset, sc_core::sc_time_stamp() + sc_core::sc_time(1, sc_core::SC_PS));
}

void PinClock::edge() {
  if (edge_due_) drive_pin(clock, true);
  edge_due_ = false;
  at(Phase::kDrive, drive_date(cycle_));
}

void PinClock::drive() {
  if (rests_) {
    const std::optional<Cycles> first = news();
    if (!first || *first > cycle_) return end_cycle();
    rests_ = false;
    moved_ = cycle_;
  }
  drive_pin(enable, true);
  for (PinEnd* end : ends_) end->drive(cycle_);
  at(Phase::kPass, sc_core::sc_time_stamp() + sc_core::sc_time(1, sc_core::SC_PS));
}

void PinClock::pass() {
  ++cycles_;
  for (PinEnd* end : ends_) end->look(steps_);
  const bool stands = !std::all_of(ends_.begin(), ends_.end(),
                                   [this](const PinEnd* end) { return end->can_step(with_all_); });
  bool moved = false;
  for (PinEnd* end : ends_) moved |= end->pass(cycle_, stands);
  if (moved) moved_ = cycle_;
  if (!stands) ++steps_;
  drive_pin(enable, !stands);
  edge_due_ = !stands || is_bound(enable);
  rests_ = may_rest();
  end_cycle();
}

void PinClock::end_cycle() {
  at(Phase::kFall, (domain_.time_of(cycle_) + domain_.time_of(cycle_ + Cycles(1))) / 2);
  cycle_ += Cycles(1);
}

void PinClock::fall() {
  drive_pin(clock, false);
  if (edge_due_ || !rests_) return at(Phase::kEdge, domain_.time_of(cycle_));
  phase_ = Phase::kRest;
  rest();
}

bool PinClock::may_rest() const {
  if (config_.rest_after == 0 || (cycle_ - moved_).size() < config_.rest_after) return false;
  return std::all_of(ends_.begin(), ends_.end(), [](PinEnd* end) { return end->rests(); });
}

// The first cycle in which there is something new, if that is known; else PinClock::wake() is called.
std::optional<Cycles> PinClock::news() const {
  std::optional<Cycles> first;
  for (PinEnd* end : ends_) {
    end->rests();
    const std::optional<Cycles> next = end->next();
    if (next && (!first || *next < *first)) first = next;
  }
  return first;
}

void PinClock::rest() {
  const std::optional<Cycles> first = news();
  if (!first) return;
  const sc_core::sc_time& now = sc_core::sc_time_stamp();
  Cycles cycle = std::max(cycle_, *first);
  if (drive_date(cycle) < now) cycle = domain_.cycle_at_or_after(now);
  if (drive_date(cycle) > now) {
    next_.notify(drive_date(cycle) - now);
    return;
  }
  cycle_ = moved_ = cycle;
  rests_ = false;
  phase_ = Phase::kDrive;
  drive();
}

}  // namespace parallax
