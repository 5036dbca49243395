// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <vector>

#include "traces/date_queue.hpp"
#include "traces/trace_sink.hpp"

namespace parallax {

/// Sinks that are all told the same.
using TraceSinks = std::vector<TraceSink*>;

/// Events of one part, in the order of their dates, that no sink has been told yet: parts are ahead of each
/// other.
class TraceLane {
 public:
  static constexpr Picoseconds kNever{std::numeric_limits<std::int64_t>::max()};

  virtual ~TraceLane() = default;
  /// Date of the next event; kNever when there is none.
  virtual Picoseconds next() const = 0;
  /// Tells all sinks of the events of that date, and returns the next one.
  virtual Picoseconds tell(const TraceSinks& sinks) = 0;
};

/// A lane whose events are of one kind.
template <class Event>
class EventLane final : public TraceLane {
 public:
  using Tell = void (*)(const Event&, TraceSink&);
  using Date = Picoseconds (*)(const Event&);

  EventLane(Date date_of, Tell tell_one) : tell_(tell_one), events_(date_of) {}

  void push(const Event& event) { events_.push(event); }
  Picoseconds next() const override { return events_.empty() ? kNever : events_.date(); }
  Picoseconds tell(const TraceSinks& sinks) override {
    const Picoseconds date = events_.date();
    do {
      for (TraceSink* sink : sinks) tell_(events_.front(), *sink);
      events_.pop();
    } while (!events_.empty() && events_.date() == date);
    return next();
  }

 private:
  const Tell tell_;
  DateQueue<Event, Date> events_;
};

/// Tells the events of all lanes up to a date, in the order of their dates, those of one date in the order of
/// the lanes.
void tell_until(Picoseconds date, const std::vector<TraceLane*>& lanes, const TraceSinks& sinks);

}  // namespace parallax
