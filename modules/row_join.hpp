// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <utility>
#include <vector>

namespace parallax {

/// Brings together rows of two inputs that arrive independently, in order. Whichever row comes second is
/// passed on without a copy.
template <class A, class B>
class RowJoin {
 public:
  using Both = std::function<void(const A* a, const B* b)>;

  RowJoin(std::size_t length_a, std::size_t length_b, Both both)
      : length_a_(length_a), length_b_(length_b), both_(std::move(both)) {}

  void push_a(const A* row) {
    if (waiting_b_.empty()) {
      waiting_a_.emplace_back(row, row + length_a_);
      return;
    }
    const std::vector<B> other = std::move(waiting_b_.front());
    waiting_b_.pop_front();
    both_(row, other.data());
  }
  void push_b(const B* row) {
    if (waiting_a_.empty()) {
      waiting_b_.emplace_back(row, row + length_b_);
      return;
    }
    const std::vector<A> other = std::move(waiting_a_.front());
    waiting_a_.pop_front();
    both_(other.data(), row);
  }

 private:
  std::size_t length_a_;
  std::size_t length_b_;
  Both both_;
  std::deque<std::vector<A>> waiting_a_;
  std::deque<std::vector<B>> waiting_b_;
};

}  // namespace parallax
