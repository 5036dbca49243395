// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace parallax {

/// Bit i stands for the i-th port of a stage, in order of declaration (at most 8 each way).
using PortMask = std::uint8_t;

/// `count` firings in a row that all read one token from each port of `consume`, write one token to each port
/// of `produce`, and keep the stage busy for `interval` cycles. A firing may do neither: a step between those
/// that do.
struct Phase {
  std::uint32_t count = 1;
  std::uint32_t interval = 1;
  PortMask consume = 0;
  PortMask produce = 0;
  bool idle = false;  ///< no work, but a declared pause; with neither

  // Put down as a data sheet reads: fires(20).reads(0b11).writes(0b1).every(3).
  constexpr Phase reads(unsigned ports) const {
    return {count, interval, static_cast<PortMask>(ports), produce};
  }
  constexpr Phase writes(unsigned ports) const {
    return {count, interval, consume, static_cast<PortMask>(ports)};
  }
  constexpr Phase every(std::uint32_t cycles) const { return {count, cycles, consume, produce, idle}; }

  /// Whether a firing of this phase does what one of the other does.
  constexpr bool like(const Phase& other) const {
    return interval == other.interval && consume == other.consume && produce == other.produce &&
           idle == other.idle;
  }
};

/// So many firings, less than 2^32, an interval of 1 cycle each; what they read and write is said with it.
constexpr Phase fires(std::uint64_t times = 1) { return {static_cast<std::uint32_t>(times), 1}; }
/// Idle time of so many cycles.
constexpr Phase idles(std::uint32_t cycles) { return {cycles == 0 ? 0U : 1U, cycles, 0, 0, true}; }

/// Firings put down one after the other: those that do the same as the one before lengthen its phase.
class Firings {
 public:
  void add(const Phase& phase) {
    if (!phases_.empty() && phases_.back().like(phase)) {
      phases_.back().count += phase.count;
    } else if (phase.count != 0) {
      phases_.push_back(phase);
    }
  }
  /// The firing added last takes `cycles` more. Needs one.
  void lengthen(std::uint32_t cycles);

  const std::vector<Phase>& phases() const { return phases_; }

 private:
  std::vector<Phase> phases_;
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
  /// Appends one phase, or firings.
  Schedule& run(const Phase& phase) { return repeat(1, {phase}); }
  Schedule& run(const Firings& firings) { return repeat(1, firings.phases()); }

  const std::vector<Segment>& segments() const { return segments_; }
  const std::vector<Phase>& phases() const { return phases_; }
  bool empty() const { return segments_.empty(); }

  /// Busy cycles of one frame without any wait: a lower bound for the frame's time in this stage.
  std::uint64_t cycles() const { return totals_.cycles; }
  /// Tokens through output port `port` in one frame.
  std::uint64_t produced(unsigned port) const { return port < kPorts ? totals_.produced[port] : 0; }
  /// Tokens through input port `port` in one frame.
  std::uint64_t consumed(unsigned port) const { return port < kPorts ? totals_.consumed[port] : 0; }

 private:
  static constexpr unsigned kPorts = 8;  // that a mask has
  struct Totals {  // of one frame; there may be many phases, and they are asked for often
    std::uint64_t cycles = 0;
    std::array<std::uint64_t, kPorts> consumed{};
    std::array<std::uint64_t, kPorts> produced{};
  };

  std::vector<Segment> segments_;
  std::vector<Phase> phases_;
  Totals totals_;
};

/// How a stage fires: by one schedule, or in two sides, each by a schedule of its own (Stage), so that a
/// frame can come in while the one before goes out.
struct StageSchedule {
  /// Ports, beside those of the stage, by which the sides are joined: the reading side writes them, the
  /// writing side reads them.
  static constexpr unsigned kHandedPort = 6;  ///< what is known to be read can be written, in the same cycle
  static constexpr unsigned kKeptPort = 7;  ///< places that the reading side takes and the writing side frees

  Schedule reading;        ///< of the only side, if `writing` is empty
  Schedule writing;        ///< of the writing side
  std::uint32_t kept = 0;  ///< places, if there are two sides
};

}  // namespace parallax
