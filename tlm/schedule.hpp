// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace parallax {

/// Bit i stands for the i-th port of a stage, in order of declaration (at most 8 each way).
using PortMask = std::uint8_t;

/// `count` firings in a row that all read one token from each port of `consume`, write one token to each port
/// of `produce`, and keep the stage busy for `interval` cycles. A firing with neither is idle time.
struct Phase {
  std::uint32_t count = 1;
  std::uint32_t interval = 1;
  PortMask consume = 0;
  PortMask produce = 0;
};

/// What a stage does to its ports during one frame, as data: the order of reads and writes with its pace.
/// Values never change it, so dates can be computed without them.
class Schedule {
 public:
  struct Segment {
    std::uint64_t repeat;       ///< how often the phases are gone through
    std::uint32_t first_phase;  ///< index into phases()
    std::uint32_t phase_count;
  };

  /// Appends `repeat` times the given phases. Empty pieces are left out.
  Schedule& repeat(std::uint64_t times, const std::vector<Phase>& phases);
  /// Appends one phase.
  Schedule& run(const Phase& phase) { return repeat(1, {phase}); }

  const std::vector<Segment>& segments() const { return segments_; }
  const std::vector<Phase>& phases() const { return phases_; }
  bool empty() const { return segments_.empty(); }

  /// Busy cycles of one frame without any wait: a lower bound for the frame's time in this stage.
  std::uint64_t cycles() const;
  /// Tokens through output port `port` in one frame.
  std::uint64_t produced(unsigned port) const;
  /// Tokens through input port `port` in one frame.
  std::uint64_t consumed(unsigned port) const;

 private:
  template <class Weight>
  std::uint64_t sum(Weight weight) const;

  std::vector<Segment> segments_;
  std::vector<Phase> phases_;
};

}  // namespace parallax
