// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <limits>
#include <utility>
#include <vector>

#include "traces/trace_sink.hpp"

namespace parallax {

/// Sinks that are all told the same.
using TraceSinks = std::vector<TraceSink*>;

/// Events of one part, in the order of their dates, that no sink has been told yet: parts are ahead of each other.
class TraceLane {
 public:
  static constexpr Picoseconds kNever{std::numeric_limits<std::int64_t>::max()};

  virtual ~TraceLane() = default;
  /// Date of the next event; kNever when there is none.
  virtual Picoseconds next() const = 0;
  /// Tells it to all sinks.
  virtual void tell(const TraceSinks& sinks) = 0;
};

/// A lane whose events are of one kind.
template <class Event>
class EventLane final : public TraceLane {
 public:
  using Tell = void (*)(const Event&, TraceSink&);
  using Date = Picoseconds (*)(const Event&);

  EventLane(Date date_of, Tell tell_one) : date_(date_of), tell_(tell_one) {}

  void push(const Event& event) {
    events_.push_back(event);
    // Answers of a memory may come in another order than they become known.
    for (std::size_t i = events_.size() - 1; i > 0 && date_(events_[i]) < date_(events_[i - 1]); --i) {
      std::swap(events_[i], events_[i - 1]);
    }
  }
  Picoseconds next() const override { return events_.empty() ? kNever : date_(events_.front()); }
  void tell(const TraceSinks& sinks) override {
    for (TraceSink* sink : sinks) tell_(events_.front(), *sink);
    events_.pop_front();
  }

 private:
  const Date date_;
  const Tell tell_;
  std::deque<Event> events_;
};

/// Tells the events of all lanes up to a date, in the order of their dates, those of one date in the order of the
/// lanes.
void tell_until(Picoseconds date, const std::vector<TraceLane*>& lanes, const TraceSinks& sinks);

}  // namespace parallax
