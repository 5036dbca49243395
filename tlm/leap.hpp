// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <systemc>
#include <utility>
#include <vector>

#include "tlm/ring.hpp"
#include "tlm/stage.hpp"

namespace parallax {

/// Leaps over periodic motion: when all stages of one clock repeat themselves, cycle for cycle, with a period
/// of T cycles, n periods are added to their state at once instead of being gone through token by token.
///
/// Why every date stays exact. The dates follow from a state: what a stage still has to do, the dates in its
/// pipeline, and the dates of the tokens and free slots in the streams. observe() lets every stage go
/// through one period, firing by firing as always, and compares the state with the one before: if all that
/// can still make a difference is the same but T cycles later, then the next period is this one, T cycles
/// later, as long as the schedules go on alike. A date that cannot make a difference (a token that was there
/// long before it is read, a slot that was free long before it is written) may differ; it is looked at, one
/// by one, before it is used.
///
/// What is not periodic takes part one by one: streams from or to kernel time or another clock, and those
/// that a schedule reads or writes at irregular firings (bursts, words of the map). Their dates must not hold
/// any stage back; a leap ends before the firing at which one would.
///
/// In the order of what happens: leap_search.cpp finds which stages are *active* (have moved lately), which
/// of their streams (a *link*) both ends use in every *unit* of their schedule, which makes it *core*, else
/// *loose*, and a period that they may have; leap_observe.cpp goes through one; leap.cpp goes on from it, as
/// far as schedules, core links (*open* until all their tokens are certain) and the *events* of loose links
/// allow; leap_state.cpp puts the stages and streams where they have come to.
class Leap {
 public:
  Leap(Dataflow& dataflow, const ClockDomain& clock) : dataflow_(dataflow), clock_(clock) {}
  Leap(const Leap&) = delete;
  Leap& operator=(const Leap&) = delete;

  const ClockDomain& clock() const { return clock_; }
  /// Takes in the stages of this clock; when all are bound.
  void build(const std::vector<Stage*>& stages);

  enum class Found {
    kPeriod,   ///< there is periodic motion: the stages are held; from here on they move by go_on() only
    kNothing,  ///< there is none now
    kUnknown,  ///< not all stages could go through a period: what they wait for is not known yet
  };
  /// Looks for periodic motion.
  Found attempt();
  /// Whether any stage could fire now; without, there is nothing to look at.
  bool can_move() const;
  bool holding() const { return holding_; }
  /// Moves the held stages as far as is known, when `eager` or when the kernel's time has come to what they
  /// did not compute yet; lets go of them where periodic motion ends. Whether anything moved.
  bool go_on(bool eager);
  /// The date before which go_on() must be called again. Everything before it is known.
  const sc_core::sc_time& due() const { return due_; }
  /// Brings the state of stages and streams up to where the leap has come.
  void materialize();
  /// A stage that took no part could go on now: the leap ends.
  void ask_for_release() { release_asked_ = true; }
  /// Firings gone over so far.
  std::uint64_t leaped_firings() const { return leaped_firings_; }

 private:
  struct Link {
    StreamBase* stream;
    bool written = false;  // by a stage of this clock,
    bool read = false;     // likewise
    PortMask writer_port = 0;
    PortMask reader_port = 0;
    bool core = false;  // takes part in the periodic motion
    // One period:
    std::uint64_t writes = 0, reads = 0;
    Cycles blocked, starved;
    std::vector<std::pair<std::uint64_t, std::uint64_t>> levels;  // (level, cycles) counted
    // What the stream's ends can do without asking: tokens before `sure_reads` are there, and slots before
    // `sure_writes` free, in time or as in the period before.
    bool reads_bind = false, writes_bind = false;
    std::uint64_t base_read = 0, base_written = 0;  // at the end of the period observed
    std::uint64_t sure_reads = 0, sure_writes = 0;
    // Of a stream that is not core: tokens of checked events.
    std::uint64_t claimed_reads = 0, claimed_writes = 0;
    StreamStatistics before;
    std::uint64_t settled_before = 0, freed_before = 0;
    Cycles settled_until_before;
  };
  enum class Check { kInTime, kLate, kUnknown };
  struct Event {  // a firing that reads or writes a stream that is not core
    std::uint64_t firing;
    PortMask consume, produce;
    bool pending;  // it is not known when there is room for what it writes
    Stage::Position position;
    Cycles start;  // once it is checked
  };
  struct Member {
    Stage* stage;
    std::vector<std::size_t> in, out;        // links
    std::vector<Link*> loose_in, loose_out;  // of these, those that are not core
    bool takes_part = false;                 // has a core port
    bool active = false;
    std::uint64_t seen_firings = 0;  // at the last look
    int looks_still = 0;             // looks in a row since it moved
    // The pattern: firings of a unit, and what all of them have in common.
    std::uint64_t unit = 1;
    PortMask core_in = 0, core_out = 0;
    Phase common;
    // One period:
    std::uint64_t firings = 0, writes = 0;
    StageStatistics delta;
    std::vector<FiringDates> observed;
    // Progress:
    std::uint64_t base = 0, done = 0;   // firings at the end of the period observed, and since
    std::vector<std::uint64_t> untold;  // periods since, that each listener of the stage has yet to know of
    std::uint64_t sure_periods = 0;     // periods since, that nothing but streams can hold back
    Stage::Position cursor;             // of firing `scanned`
    std::uint64_t scanned = 0;
    bool ended = false;  // the pattern ends at `scanned`
    Ring<Event> events;
    std::size_t checked = 0;            // of the events, from the front: known to be in time
    Stage::Position position;           // in the schedule of the last event gone over,
    std::uint64_t position_firing = 0;  // which was this firing; 0: none
    StageStatistics before;
    std::uint64_t entered_before = 0, left_before = 0;
    Cycles free_before, last_write_before;
    std::size_t frames_before = 0;
    Cycles last_event_write{-1};        // of the checked events whose date is known
    std::uint64_t claimed_pending = 0;  // checked events that will wait in the pipeline
  };

  bool classify();
  bool find_unit(Member& member, PortMask& mixed_in, PortMask& mixed_out);
  bool find_period();
  Found observe();
  void snapshot();
  bool repeats(Member& member) const;
  bool repeats(Link& link) const;
  bool reads_repeat(Link& link) const;
  bool writes_repeat(Link& link) const;

  bool extend();
  void scan(Member& member);
  std::uint64_t possible_firings(Member& member, bool& outside);
  Check check(Member& member, Event& event);
  bool write_pending(Member& member);
  std::uint64_t possible_periods(Link& link, std::uint64_t wanted);
  static bool is_sure(const Link& link);
  enum class Notify { kImpatient, kAll };
  void notify_listeners(Member& member, std::uint64_t periods, Notify whom);
  void commit_events(Member& member, std::uint64_t until);
  Cycles start_of(const Member& member, std::uint64_t firing) const;
  std::pair<std::size_t, Cycles> in_period(const Member& member, std::uint64_t firing) const;

  void materialize(Member& member, std::uint64_t periods);
  void materialize(Link& link, std::uint64_t periods);
  void announce();
  void release();
  void set_limits(bool limited, bool with_period);
  sc_core::sc_time find_due() const;

  Dataflow& dataflow_;
  const ClockDomain& clock_;
  std::vector<Member> members_;
  std::vector<Link> links_;
  std::vector<Member*> irregular_, regular_;  // active members that take part: with and without loose links
  std::vector<Link*> open_;                   // core links that may still hold a stage back
  std::vector<Cycles> model_;                 // dates of one period; a member for its memory only
  bool holding_ = false;
  bool wide_ = false;
  bool release_asked_ = false;
  sc_core::sc_time due_;
  bool waits_outside_ = false;  // the last extend() stopped at something that is not known yet
  std::int64_t period_ = 0;     // T, in cycles
  std::uint64_t periods_ = 0;   // gone through since observe()
  std::uint64_t materialized_ = 0;
  std::uint64_t leaped_firings_ = 0;
};

}  // namespace parallax
