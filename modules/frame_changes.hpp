// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>

namespace parallax {

/// What changes for a stage from frame to frame: told ahead, frame by frame, and handed out at a frame's
/// first row. A kernel that has got all rows of a frame holds nothing of it any more, so a new one can take
/// its place then.
template <class T>
class FrameChanges {
 public:
  /// `rows` of input make a frame.
  explicit FrameChanges(int rows) : rows_(rows) {}

  /// For the next frame that has not been told yet; none: as before. Frames are told in order, or none is.
  void push(const std::optional<T>& change) { next_.push_back(change); }

  /// To be called for each row, before it is used: the change for a frame that begins with it.
  std::optional<T> at_row() {
    std::optional<T> change;
    if (row_ == 0 && !next_.empty()) {
      change = next_.front();
      next_.pop_front();
    }
    row_ = (row_ + 1) % rows_;
    return change;
  }

 private:
  std::deque<std::optional<T>> next_;
  int rows_;
  int row_ = 0;  // of the frame
};

}  // namespace parallax
