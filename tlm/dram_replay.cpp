// SPDX-License-Identifier: Apache-2.0
#include "tlm/dram_replay.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>

namespace parallax {
namespace {

using Clock = DramController::Clock;

constexpr std::uint64_t kPart = 64;

class Replay {
 public:
  Replay(const DramTiming& timing, const DramPolicy& policy, DramMapping mapping, std::size_t window)
      : controller_(timing, policy),
        address_(timing, mapping),
        burst_(timing.burst_bytes()),
        period_ns_(static_cast<double>(timing.clock_period_ps) / 1000),
        window_(window) {}

  ReplayResult run(const std::vector<TraceRequest>& trace) {
    result_.saturating =
        std::all_of(trace.begin(), trace.end(), [](const TraceRequest& r) { return r.time_ns == 0; });
    if (!trace.empty()) result_.first_clock = edge(trace.front().time_ns);
    for (const TraceRequest& request : trace) {
      const std::uint64_t end = request.address + request.bytes;
      next_ = std::max(next_, edge(request.time_ns));
      for (std::uint64_t at = request.address; at < end; at = (at / kPart + 1) * kPart) {
        enter(request, at, std::min(end, (at / kPart + 1) * kPart));
      }
    }
    while (!controller_.idle()) step();
    result_.commands = controller_.statistics();
    result_.bytes = (result_.commands.reads + result_.commands.writes) * burst_;
    return result_;
  }

 private:
  // A time that is an edge must not become the next one by a rounding error.
  Clock edge(double time_ns) const {
    return std::max(Clock{0}, static_cast<Clock>(std::ceil(time_ns / period_ns_ - 1e-6)));
  }

  struct Read {
    double begin_ns = 0;          // from which its latency counts
    Clock end = 0;                // of the last data beat so far
    std::size_t bursts_left = 0;  // without a read command
  };

  // Bytes begin to end - 1 of a request, all in one part.
  void enter(const TraceRequest& request, std::uint64_t begin, std::uint64_t end) {
    if (!request.write) wait_for_window();
    begin = begin / burst_ * burst_;
    wait_for_room(request.write);
    const std::uint64_t tag = reads_.size();
    if (request.write) {
      ++result_.writes;
    } else {
      ++result_.reads;
      ++under_way_;
      const double accepted = static_cast<double>(next_) * period_ns_;
      reads_.push_back(
          {result_.saturating ? accepted : request.time_ns, 0, (end - begin + burst_ - 1) / burst_});
    }
    for (std::uint64_t at = begin; at < end; at += burst_) {
      wait_for_room(request.write);
      run_until(next_ + 1);
      controller_.submit({address_.locate(at), tag, request.write}, next_);
      ++next_;
    }
  }

  void wait_for_window() {
    for (;;) {
      run_until(next_);
      for (; !ends_.empty() && ends_.top() <= next_; ends_.pop()) --under_way_;
      if (under_way_ < window_) return;
      // A read whose command is still to come ends after all that have it.
      if (ends_.empty()) {
        step();
      } else {
        next_ = ends_.top();
      }
    }
  }

  void wait_for_room(bool write) {
    for (run_until(next_); !controller_.room(write); run_until(next_)) {
      next_ = std::max(next_, controller_.next_command() + 1);
    }
  }

  void step() { run_until(controller_.next_command() + 1); }

  void run_until(Clock limit) {
    controller_.run_until(limit, done_);
    for (const DramController::Done& done : done_) {
      result_.clocks = std::max(result_.clocks, done.data_end);
      if (done.write) continue;
      Read& read = reads_[done.tag];
      read.end = std::max(read.end, done.data_end);
      if (--read.bursts_left > 0) continue;
      ends_.push(read.end);
      const double latency = static_cast<double>(read.end) * period_ns_ - read.begin_ns;
      result_.latency_sum += latency;
      result_.latency_largest = std::max(result_.latency_largest, latency);
    }
    done_.clear();
  }

  DramController controller_;
  const DramAddress address_;
  const std::uint64_t burst_;
  const double period_ns_;
  const std::size_t window_;
  ReplayResult result_;
  Clock next_ = 0;  // in which the next burst may enter
  std::vector<DramController::Done> done_;
  std::vector<Read> reads_;
  std::priority_queue<Clock, std::vector<Clock>, std::greater<>>
      ends_;                   // of reads whose commands are all out
  std::size_t under_way_ = 0;  // reads whose last data beat is not over
};

}  // namespace

ReplayResult replay(const std::vector<TraceRequest>& trace, const DramTiming& timing,
                    const DramPolicy& policy, DramMapping mapping, std::size_t window) {
  return Replay(timing, policy, mapping, window).run(trace);
}

}  // namespace parallax
