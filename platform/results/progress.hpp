// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <ostream>
#include <string>

namespace parallax {

/// Whether standard error is a terminal, the place of a progress bar.
bool standard_error_is_terminal();

/// "[==========          ] 42/100 frames, 3 s left" on one line that is drawn anew, at most ten times a
/// second. Where it is not shown (a pipe, --quiet), it prints nothing at all, but of what will take minutes
/// `note` hears once how many, some seconds after the beginning.
class Progress {
 public:
  using Clock = std::chrono::steady_clock;

  using Note = std::function<void(const std::string& line)>;

  Progress(std::ostream& out, bool shown, std::string what, std::int64_t total, Note note = {});
  /// Once `total` are done there may be more, at most so many.
  void may_go_on_to(std::int64_t most) { most_ = most; }
  ~Progress();  ///< wipes the line, so that what follows starts on an empty one
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void advance(std::int64_t count = 1, Clock::time_point now = Clock::now());

  /// Of the whole, no more than this share is done, 0 to 1: what is known before the first part is.
  void reached(double share, Clock::time_point now = Clock::now());

  /// The line after `done` of `total` parts that took `elapsed`.
  static std::string line(const std::string& what, std::int64_t done, std::int64_t total,
                          std::chrono::duration<double> elapsed);

 private:
  void estimate(double left_seconds);

  std::ostream& out_;
  bool shown_;
  std::string what_;
  std::int64_t total_;
  std::int64_t most_ = 0;
  Note note_;  ///< empty when it has been told, or is not to be
  std::int64_t done_ = 0;
  Clock::time_point first_done_{};
  Clock::time_point start_ = Clock::now();
  Clock::time_point drawn_ = start_;
};

}  // namespace parallax
