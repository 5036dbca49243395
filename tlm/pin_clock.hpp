// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <systemc>
#include <vector>

#include "tlm/clock_domain.hpp"
#include "tlm/pin_end.hpp"
#include "tlm/pin_port.hpp"
#include "tlm/units.hpp"

namespace parallax {

struct PinClockConfig {
  /// Edges in reset, 0 to PinClock::kMostReset. They lie before cycle 0, in the first picoseconds.
  std::uint32_t reset_cycles = 8;
  bool reset_is_low = false;  ///< the reset pin is active low
  /// The clock stands after so many cycles in which nothing has passed, until there is a token or room that
  /// there was not; 0: it never does, and sc_start() without a time does not end by itself. More than what
  /// the circuit ever works without any token passing.
  std::uint64_t rest_after = 0;
  /// Of circuits on one chain of streams, upstream first; 0 to PinClock::kMostOrder. It matters only where a
  /// stream hands on a token in the cycle of its writing.
  std::uint32_t order = 0;
};

/// Clock and reset of a circuit at pin level, and of all its ends: what happens when.
///
/// Cycle n begins with edge n of the clock domain. A few picoseconds later the ends drive their pins by what
/// their streams have in cycle n; another picosecond later, when all combinational paths have settled, a
/// token passes where valid and ready are 1, with n as its date; at edge n + 1 the clock rises, and the
/// circuit's registers take what is on the pins. So the circuit meets the FIFOs and nothing else: no
/// register, no place and no cycle is added. The circuit's logic must have no delays in time.
///
/// What can be neither withheld nor refused, as no pin says so, has the clock stand: there is no edge, or,
/// where the pin `enable` is bound, it is 0 at the edge.
///
/// A stage sees these dates as any others. A neighbour that is a thread sees them a few picoseconds behind
/// the edge, so that over a FIFO with an offset of 0 it reads (writes) a cycle later.
class PinClock final : public sc_core::sc_module {
 public:
  static constexpr std::uint32_t kMostReset = 64;
  static constexpr std::uint32_t kMostOrder = 31;
  static constexpr std::int64_t kShortest = 512;  ///< ps, of the clock's period

  OptionalOut<bool> clock{"clock"};    ///< rises at the edges, falls half a period later
  OptionalOut<bool> reset{"reset"};    ///< active before cycle 0
  OptionalOut<bool> enable{"enable"};  ///< 0 at the edges at which the circuit must stand still

  /// Throws UserError, naming the module, when a number is out of its range.
  PinClock(const sc_core::sc_module_name& name, const ClockDomain& domain, const PinClockConfig& config = {});

  const ClockDomain& domain() const { return domain_; }
  /// Cycles in which the circuit has had an edge and was not held by `enable`.
  std::uint64_t steps() const { return steps_; }
  std::uint64_t cycles() const { return cycles_; }  ///< in which it was looked at, standing or not

  /// Of the ends, in whatever order; `end` must outlive the simulation.
  void add(PinEnd& end) { ends_.push_back(&end); }
  /// A date has become known that an end rests for.
  void wake();

 private:
  enum class Phase { kReset, kEdge, kDrive, kPass, kFall, kRest };

  void start_of_simulation() override;
  void go();
  void at(Phase phase, const sc_core::sc_time& date);
  void reset_edge();
  void edge();
  void drive();
  void pass();
  void fall();
  void rest();
  void end_cycle();
  bool may_rest() const;
  std::optional<Cycles> news() const;
  sc_core::sc_time drive_date(Cycles cycle) const;

  const ClockDomain& domain_;
  const PinClockConfig config_;
  std::vector<PinEnd*> ends_;
  bool with_all_ = false;
  Phase phase_ = Phase::kReset;
  std::uint32_t reset_edges_ = 0;  // rises and falls that are behind
  Cycles cycle_{0};
  Cycles moved_{0};        // the last cycle in which a token passed, or the first one after a rest
  bool edge_due_ = false;  // the circuit's registers have not taken what is on the pins
  bool rests_ = false;
  std::uint64_t steps_ = 0;
  std::uint64_t cycles_ = 0;
  sc_core::sc_event next_;
};

}  // namespace parallax
