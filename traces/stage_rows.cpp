// SPDX-License-Identifier: Apache-2.0
#include "traces/stage_rows.hpp"

#include <algorithm>
#include <limits>

namespace parallax {
namespace {

constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();

// What passes one port, row by row.
class PortRows {
 public:
  explicit PortRows(const std::optional<StagePorts::RowPort>& port) : port_(port) {}

  PortMask mask() const { return port_ ? static_cast<PortMask>(1u << port_->number) : PortMask{0}; }
  bool over() const { return !port_ || row_ == port_->rows->ends.size(); }
  /// Tokens that may pass before the first one of another row does.
  std::uint64_t until_next_row() const { return over() ? kNone : port_->rows->ends[row_] - at_; }
  /// Whether the next token is the first one of a row.
  bool at_begin() const { return !over() && (row_ == 0 ? at_ == 0 : at_ == port_->rows->ends[row_ - 1]); }
  std::int32_t row() const { return static_cast<std::int32_t>(row_); }
  std::int32_t last_row() const { return at_ == 0 ? -1 : row_of_last_; }
  void pass(std::uint64_t tokens) {
    if (tokens == 0 || over()) return;
    at_ += tokens;
    row_of_last_ = static_cast<std::int32_t>(row_);
    if (at_ == port_->rows->ends[row_]) ++row_;
  }

 private:
  const std::optional<StagePorts::RowPort>& port_;
  std::size_t row_ = 0;
  std::uint64_t at_ = 0;
  std::int32_t row_of_last_ = -1;
};

class Rows {
 public:
  explicit Rows(const StagePorts& ports) : read_(ports.read), written_(ports.written) {}

  void segment(const Phase* phases, std::uint32_t count, std::uint64_t repeat) {
    std::uint64_t firings = 0, reads = 0, writes = 0;  // of one pass
    for (std::uint32_t i = 0; i < count; ++i) {
      firings += phases[i].count;
      if ((phases[i].consume & read_.mask()) != 0) reads += phases[i].count;
      if ((phases[i].produce & written_.mask()) != 0) writes += phases[i].count;
    }
    while (repeat > 0) {
      // Passes in which no row begins, at once. The last one before a row's end is gone through by itself.
      std::uint64_t still = repeat;
      if (reads > 0 && !read_.over()) still = std::min(still, (read_.until_next_row() - 1) / reads);
      if (writes > 0 && !written_.over()) still = std::min(still, (written_.until_next_row() - 1) / writes);
      if (still > 0 && !begins(reads > 0, writes > 0)) {
        read_.pass(still * reads);
        written_.pass(still * writes);
        firing_ += still * firings;
        repeat -= still;
        note_written();
        continue;
      }
      for (std::uint32_t i = 0; i < count; ++i) phase(phases[i]);
      --repeat;
    }
  }

  ScheduleRows take() {
    rows_.firings = firing_;
    if (rows_.rows.empty()) rows_.rows.push_back({0, 0, false, -1});
    rows_.rows.front().firing = 0;  // what comes before the first token belongs to it
    return std::move(rows_);
  }

 private:
  bool begins(bool reads, bool writes) const {
    return (reads && read_.at_begin()) || (writes && read_.over() && written_.at_begin());
  }

  void phase(const Phase& phase) {
    const bool reads = (phase.consume & read_.mask()) != 0;
    const bool writes = (phase.produce & written_.mask()) != 0;
    for (std::uint64_t left = phase.count; left > 0;) {
      if (begins(reads, writes)) begin(reads && !read_.over());
      std::uint64_t step = left;
      if (reads) step = std::min(step, read_.until_next_row());
      if (writes) step = std::min(step, written_.until_next_row());
      if (reads) read_.pass(step);
      if (writes) written_.pass(step);
      firing_ += step;
      left -= step;
      note_written();
    }
  }

  void begin(bool reading) {
    const bool draining = !reading && read_.mask() != 0;
    rows_.rows.push_back({firing_, reading ? read_.row() : written_.row(), draining, -1});
  }
  void note_written() {
    if (!rows_.rows.empty() && written_.mask() != 0) rows_.rows.back().row_written = written_.last_row();
  }

  PortRows read_;
  PortRows written_;
  std::uint64_t firing_ = 0;
  ScheduleRows rows_;
};

}  // namespace

ScheduleRows rows_of(const Schedule& schedule, const StagePorts& ports) {
  Rows rows(ports);
  for (const Schedule::Segment& segment : schedule.segments()) {
    rows.segment(schedule.phases().data() + segment.first_phase, segment.phase_count, segment.repeat);
  }
  return rows.take();
}

}  // namespace parallax
