// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <stdexcept>
#include <utility>

namespace parallax {

/// A list that keeps its first and its last records, so that a run of any length takes no more memory than a
/// short one. Records are numbered from 0, kept or not.
template <class T>
class KeptRecords {
 public:
  /// From now on at least the first `number` and the last `number` are kept. Until it is called, all.
  void keep(std::size_t number) { kept_ = number; }

  /// Record `i`, which must be kept still, is kept in any case, in place of the one that was pinned before.
  void pin(std::size_t i) { pinned_.emplace(i, (*this)[i]); }

  std::size_t size() const { return first_.size() + dropped_ + last_.size(); }
  bool empty() const { return first_.empty(); }
  void push_back(const T& record) {
    if (dropped_ == 0 && last_.empty() && (kept_ == 0 || first_.size() < kept_)) {
      first_.push_back(record);
      return;
    }
    last_.push_back(record);
    if (last_.size() <= kept_) return;
    last_.pop_front();
    ++dropped_;
  }
  T& back() { return last_.empty() ? first_.back() : last_.back(); }
  const T& back() const { return last_.empty() ? first_.back() : last_.back(); }
  T& operator[](std::size_t i) { return const_cast<T&>(static_cast<const KeptRecords&>(*this)[i]); }
  /// Throws std::out_of_range for one that is not kept.
  const T& operator[](std::size_t i) const {
    if (i < first_.size()) return first_[i];
    if (pinned_ && pinned_->first == i) return pinned_->second;
    if (i < first_.size() + dropped_) throw std::out_of_range("a record that was not kept");
    return last_.at(i - first_.size() - dropped_);
  }

 private:
  std::size_t kept_ = 0;  // 0: all
  std::deque<T> first_;
  std::deque<T> last_;
  std::size_t dropped_ = 0;  // between them
  std::optional<std::pair<std::size_t, T>> pinned_;
};

}  // namespace parallax
