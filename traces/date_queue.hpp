// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace parallax {

/// Events of one part in the order of their dates, `date_of(event)`. Its memory is as large as the most that
/// it ever held.
template <class Event, class DateOf>
class DateQueue {
 public:
  explicit DateQueue(DateOf date_of) : date_of_(std::move(date_of)) {}

  bool empty() const { return first_ == events_.size(); }
  const Event& front() const { return events_[first_]; }
  auto date() const { return date_of_(front()); }

  /// Those of one date stay in the order in which they come.
  void push(const Event& event) {
    if (first_ >= kRoom && first_ > events_.size() / 2) {
      events_.erase(events_.begin(), events_.begin() + first_);
      first_ = 0;
    }
    events_.push_back(event);
    // Answers of a memory may come in another order than they become known.
    for (std::size_t i = events_.size() - 1; i > first_ && date_of_(events_[i]) < date_of_(events_[i - 1]);
         --i) {
      std::swap(events_[i], events_[i - 1]);
    }
  }
  void pop() {
    if (++first_ < events_.size()) return;
    events_.clear();
    first_ = 0;
  }

 private:
  static constexpr std::size_t kRoom = 64;

  DateOf date_of_;
  std::vector<Event> events_;
  std::size_t first_ = 0;  // those before it are gone
};

}  // namespace parallax
