// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace parallax {

/// A queue that keeps its storage: what goes through costs no allocation once it has been as long as it gets.
template <class T>
class Ring {
 public:
  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  /// The oldest element, the newest, and the one `i` after the oldest; they must be there.
  T& front() { return (*this)[0]; }
  const T& front() const { return (*this)[0]; }
  T& back() { return (*this)[size_ - 1]; }
  T& operator[](std::size_t i) { return slots_[(first_ + i) & mask_]; }
  const T& operator[](std::size_t i) const { return slots_[(first_ + i) & mask_]; }

  void push_back(const T& value) {
    if (size_ == capacity_) grow();
    slots_[(first_ + size_++) & mask_] = value;
  }
  /// A new element with what its slot happens to hold: to be filled in, field by field. To copy one that has
  /// just been made reads what was written in smaller pieces, a store-forwarding stall (some 4 ns).
  T& add() {
    if (size_ == capacity_) grow();
    return slots_[(first_ + size_++) & mask_];
  }
  void pop_front() {
    first_ = (first_ + 1) & mask_;
    --size_;
  }

 private:
  void grow() {
    std::vector<T> larger(slots_.empty() ? 8 : 2 * slots_.size());
    for (std::size_t i = 0; i < size_; ++i) larger[i] = std::move((*this)[i]);
    slots_ = std::move(larger);
    capacity_ = slots_.size();
    mask_ = capacity_ - 1;
    first_ = 0;
  }

  std::vector<T> slots_;
  std::size_t capacity_ = 0;  // of the slots, a power of two
  std::size_t mask_ = 0;
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace parallax
