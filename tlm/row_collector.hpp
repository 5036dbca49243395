// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace parallax {

/// Makes rows of one length out of values that come in pieces.
template <class T>
class RowCollector {
 public:
  /// `length`: values of a row; 0: each piece is one.
  explicit RowCollector(std::size_t length = 0) : length_(length) {}

  /// Calls `take(row, length)` for each row that the piece completes. The row is valid during that call.
  template <class Take>
  void push(const T* values, std::size_t size, const Take& take) {
    if (length_ == 0) {
      take(values, size);
      return;
    }
    if (!begun_.empty()) {
      const std::size_t missing = std::min(size, length_ - begun_.size());
      begun_.insert(begun_.end(), values, values + missing);
      values += missing;
      size -= missing;
      if (begun_.size() < length_) return;
      take(begun_.data(), length_);
      begun_.clear();
    }
    for (; size >= length_; size -= length_, values += length_) take(values, length_);
    begun_.insert(begun_.end(), values, values + size);
  }

 private:
  std::size_t length_;
  std::vector<T> begun_;  // the row that is not complete
};

}  // namespace parallax
