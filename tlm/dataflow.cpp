// SPDX-License-Identifier: Apache-2.0
#include "tlm/dataflow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tlm/deadlock.hpp"
#include "tlm/leap.hpp"
#include "tlm/stream_base.hpp"

namespace parallax {
namespace {

// Each look for periodic motion that fails doubles the firings until the next one within a run(), so many
// times.
constexpr unsigned kMostPatience = 5;

}  // namespace

Dataflow::Dataflow(const sc_core::sc_module_name& name, std::uint64_t leap_interval)
    : sc_module(name), leap_interval_(leap_interval) {
  SC_HAS_PROCESS(Dataflow);
  SC_METHOD(run);
  sensitive << work_ << due_;
}

Dataflow::~Dataflow() = default;

void Dataflow::start_of_simulation() {
  for (Stage* stage : stages_) {
    if (std::none_of(leaps_.begin(), leaps_.end(), [&](const auto& leap) {
          return leap->clock().frequency() == stage->clock().frequency();
        })) {
      leaps_.push_back(std::make_unique<Leap>(*this, stage->clock()));
      leaps_.back()->build(stages_);
    }
  }
}

void Dataflow::wake(Actor& actor) {
  if (actor.held_by_ != nullptr) {
    if (!actor.held_idle_) return;  // it goes on when that is due
    actor.held_by_->ask_for_release();
  } else {
    if (actor.queued_) return;
    actor.queued_ = true;
    ready_.push_back(&actor);
  }
  if (!std::exchange(notified_, true)) work_.notify();
}

void Dataflow::post(std::function<void()> action) {
  actions_.push_back(std::move(action));
  if (!std::exchange(notified_, true)) work_.notify();
}

void Dataflow::hold(Actor& actor, Leap* leap, bool active) {
  actor.held_by_ = leap;
  actor.held_idle_ = !active;
}

void Dataflow::release(Actor& actor) {
  actor.held_by_ = nullptr;
  wake(actor);
}

// One action or actor; whether there was any.
bool Dataflow::step() {
  if (!actions_.empty()) {
    const auto action = std::move(actions_.front());
    actions_.pop_front();
    action();
    return true;
  }
  if (ready_.empty()) return false;
  Actor& actor = *ready_.front();
  ready_.pop_front();
  actor.queued_ = false;
  if (actor.held_by_ == nullptr) actor.advance();
  return true;
}

void Dataflow::bring_up_to_date() const {
  for (const auto& leap : leaps_) {
    if (leap->holding()) leap->materialize();
  }
}

std::uint64_t Dataflow::leaped_firings() const {
  bring_up_to_date();
  std::uint64_t firings = 0;
  for (const auto& leap : leaps_) firings += leap->leaped_firings();
  return firings;
}

void Dataflow::drain() {
  while (step()) continue;
}

bool Dataflow::attempt_leaps() {
  bool found = false;
  bool known = true;
  for (const auto& leap : leaps_) {
    if (leap->holding()) continue;
    const Leap::Found result = leap->attempt();
    found |= result == Leap::Found::kPeriod;
    known &= result != Leap::Found::kUnknown;
  }
  firings_ = 0;
  // What was not known is no failure: the next look may find it known.
  if (found) failures_ = 0;
  if (!found && known) failures_ = std::min(failures_ + 1, kMostPatience);
  return found;
}

// Whether it is time to look for periodic motion, `soon` with half the patience, and there is something to
// look at.
bool Dataflow::may_look(bool soon) const {
  return leap_interval_ != 0 && firings_ >= leap_interval_ << (soon ? failures_ / 2 : failures_) &&
         std::any_of(leaps_.begin(), leaps_.end(),
                     [](const auto& leap) { return !leap->holding() && leap->can_move(); });
}

void Dataflow::run() {
  notified_ = true;  // so wakes from within need no event
  // Everybody has come to rest before, which is where periodic motion shows best: as soon as the first can go
  // on.
  bool soon = true;
  bool eager = false;
  for (;;) {
    do {
      if (!may_look(soon)) continue;
      soon = false;
      eager |= attempt_leaps();
    } while (step());
    bool moved = false;
    for (const auto& leap : leaps_) {
      if (leap->holding() && leap->go_on(eager)) moved = eager = true;
    }
    if (!moved && ready_.empty()) break;
  }
  notified_ = false;
  for (const auto& leap : leaps_) {
    if (leap->holding()) due_.notify(leap->due() - sc_core::sc_time_stamp());
  }
}

std::vector<Wait> Dataflow::waits() const {
  std::vector<Wait> all;
  for (const StreamBase* stream : streams_) {
    if (stream->reader_waits()) {
      all.push_back({stream->reader_name(), stream, false, stream->writer_name()});
    }
    if (stream->writer_waits()) {
      all.push_back({stream->writer_name(), stream, true, stream->reader_name()});
    }
  }
  return all;
}

std::vector<Wait> Dataflow::deadlock() const { return closed_circle(waits()); }

std::string describe(const std::vector<Wait>& cycle) {
  std::string text;
  for (const Wait& wait : cycle) {
    const StreamBase& stream = *wait.stream;
    const bool in_kernel_time = (wait.on_full ? stream.writer() : stream.reader()) == nullptr;
    text += fmt::format("  {}{} waits on stream {} ({}, depth {}) for {}\n", wait.waiter,
                        in_kernel_time ? " (in kernel time)" : "", stream.name(),
                        wait.on_full ? "full" : "empty", stream.depth(), wait.other);
  }
  return text;
}

}  // namespace parallax
