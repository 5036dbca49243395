// SPDX-License-Identifier: Apache-2.0
#include "platform/results/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace parallax {
namespace {

constexpr std::int64_t kBarColumns = 24;
constexpr std::chrono::milliseconds kRedraw{100};
// An estimate is told when it is some good, and when it is worth knowing.
constexpr std::chrono::seconds kEstimate{2};
constexpr std::chrono::seconds kEstimateWithoutAny{5};
constexpr std::chrono::duration<double> kWorthANote{180};
constexpr const char* kWipe = "\r\033[K";  // to the first column, erase to the end of the line

std::string duration_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::ceil(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

}  // namespace

bool standard_error_is_terminal() { return ::isatty(STDERR_FILENO) == 1; }

Progress::Progress(std::ostream& out, bool shown, std::string what, std::int64_t total, Note note)
    : out_(out),
      shown_(shown),
      what_(std::move(what)),
      total_(total),
      note_(shown ? Note{} : std::move(note)) {}

Progress::~Progress() {
  if (shown_) out_ << kWipe << std::flush;
}

void Progress::advance(std::int64_t count, Clock::time_point now) {
  if (done_ == 0) first_done_ = now;
  if (done_ == total_ && total_ < most_) {
    total_ = most_;
    what_ += " at most";
  }
  done_ += count;
  const std::chrono::duration<double> since_first = now - first_done_;
  if (now - start_ >= kEstimate && done_ > count)  // the first one may have taken another time
    estimate(since_first.count() / static_cast<double>(done_ - 1) * static_cast<double>(total_ - done_));
  if (!shown_ || (now - drawn_ < kRedraw && done_ < total_)) return;
  drawn_ = now;
  out_ << kWipe << line(what_, done_, total_, now - start_) << std::flush;
}

void Progress::reached(double share, Clock::time_point now) {
  const std::chrono::duration<double> elapsed = now - start_;
  if (done_ == 0 && elapsed >= kEstimateWithoutAny && share > 0) estimate(elapsed.count() * (1 / share - 1));
}

void Progress::estimate(double left_seconds) {
  if (!note_ || left_seconds < kWorthANote.count()) return;
  const Note note = std::exchange(note_, {});
  note(fmt::format(
      "about {:.0f} minutes to go, {} of {} {} are done; Ctrl-C ends it and keeps what is complete",
      left_seconds / 60, done_, total_, what_));
}

std::string Progress::line(const std::string& what, std::int64_t done, std::int64_t total,
                           std::chrono::duration<double> elapsed) {
  const std::int64_t filled =
      total > 0 ? std::clamp<std::int64_t>(kBarColumns * done / total, 0, kBarColumns) : 0;
  std::string text =
      fmt::format("[{:<{}}] {}/{} {}", std::string(filled, '='), kBarColumns, done, total, what);
  if (done > 0 && done < total) {
    const double left = elapsed.count() / static_cast<double>(done) * static_cast<double>(total - done);
    text += fmt::format(", {} left", duration_text(left));
  }
  return text;
}

}  // namespace parallax
