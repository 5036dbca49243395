// SPDX-License-Identifier: Apache-2.0
#include "tlm/dataflow.hpp"

#include <fmt/format.h>

#include <utility>

#include "tlm/deadlock.hpp"
#include "tlm/stream_base.hpp"

namespace parallax {

Dataflow::Dataflow(const sc_core::sc_module_name& name) : sc_module(name) {
  SC_HAS_PROCESS(Dataflow);
  SC_METHOD(run);
  sensitive << work_;
}

void Dataflow::wake(Actor& actor) {
  if (actor.queued_) return;
  actor.queued_ = true;
  ready_.push_back(&actor);
  if (!std::exchange(notified_, true)) work_.notify();
}

void Dataflow::post(std::function<void()> action) {
  actions_.push_back(std::move(action));
  if (!std::exchange(notified_, true)) work_.notify();
}

void Dataflow::run() {
  // notified_ is true here, so wakes from within need no event.
  while (!actions_.empty() || !ready_.empty()) {
    if (!actions_.empty()) {
      const auto action = std::move(actions_.front());
      actions_.pop_front();
      action();
      continue;
    }
    Actor& actor = *ready_.front();
    ready_.pop_front();
    actor.queued_ = false;
    actor.advance();
  }
  notified_ = false;
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
    text += fmt::format("  {} waits on stream {} ({}, depth {}) for {}\n", wait.waiter, wait.stream->name(),
                        wait.on_full ? "full" : "empty", wait.stream->depth(), wait.other);
  }
  return text;
}

}  // namespace parallax
