// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tlm/schedule.hpp"
#include "tlm/stream_base.hpp"

namespace parallax {

/// Which firings of some stages are possible at all, whenever they happen. Whether a graph of stages gets
/// stuck, and where, depends on the numbers of tokens alone: a stage fires by its schedule and waits for
/// everything that a firing needs, so the order in which the stages move changes no number (Kahn). So the
/// firings are counted without dates: runs of equal ones at once, and whatever repeats is counted once and
/// multiplied.
///
/// Copies go on independently.
class CountSimulation {
 public:
  /// What a stage does, as counts see it (stage.hpp).
  struct Participant {
    Schedule schedule;  ///< of one frame
    std::uint32_t latency = 0;
    std::uint64_t frame_limit = 0;                       ///< 0 = none
    std::vector<std::vector<const StreamBase*>> inputs;  ///< at each port
    std::vector<std::vector<const StreamBase*>> outputs;
  };

  /// Something that has to happen before something else can: a stage's next firing, or the first firing in
  /// its pipeline leaving it. In a graph that is stuck, a closed circle of these is a deadlock; nothing
  /// outside it can break it.
  struct Need {
    std::size_t from;  ///< node: 2 * stage for its next firing, + 1 for the first in its pipeline
    std::size_t to;    ///< node that has to move first
    std::size_t full;  ///< index of the stream that needs room; kNone where it is a token or the pipeline
  };
  static constexpr std::size_t kNone = ~std::size_t{0};

  /// `streams` are looked at, with the depths that they have; each is written by one of `stages` and read by
  /// one. All other streams of the stages always bring a token and take one. Starts with all streams empty.
  CountSimulation(const std::vector<Participant>& stages, const std::vector<const StreamBase*>& streams);

  /// Goes on until nothing can move, or until it is clear that every stage can complete `frames` frames, or
  /// as many as it does at all. Returns whether they do.
  bool run(std::uint64_t frames);

  /// What each node waits for, after run() returned false.
  std::vector<Need> needs() const;

  /// Lets the stream hold so many tokens; no fewer than it holds now.
  void set_depth(std::size_t stream, std::uint32_t depth);
  std::uint32_t depth(std::size_t stream) const { return fifos_[stream].depth; }

 private:
  struct Action {  // what a firing does: streams, as ranges of lists_
    std::size_t consume, consume_end;
    std::size_t produce, produce_end;
    bool enters;  // takes a slot in the pipeline
  };
  struct Run {  // firings in a row that do the same
    std::uint64_t count;
    std::size_t action;
  };
  struct Segment {
    std::uint64_t repeat;  // where it is one run, all its firings
    std::size_t first;
    std::size_t runs;
  };
  struct Program {  // one frame of a stage, without idle time
    std::vector<Run> runs;
    std::vector<Segment> segments;
    std::uint64_t latency;
    std::uint64_t frame_limit;
  };
  struct Position {  // of a stage
    std::size_t segment = 0;
    std::uint64_t repetition = 0;
    std::size_t run = 0;
    std::uint64_t done = 0;  // of the run
    std::uint64_t frames = 0;
    std::vector<Run> pipe;  // firings that have not written, the oldest first
    std::uint64_t piped = 0;
  };
  struct Fifo {
    std::uint32_t depth;
    std::uint64_t held = 0;
    std::size_t writer = 0;  // stages
    std::size_t reader = 0;
  };
  struct Recurrence {  // tells that a state has come back: keeps one, which gets ever older (Brent)
    std::vector<std::uint64_t> kept;
    std::vector<Position> positions;  // of the stages, then
    std::uint64_t age = 0;
    std::uint64_t oldest = 1;
  };
  enum class Within { kSegments, kFrames };

  void add(const Participant& stage, const std::vector<const StreamBase*>& streams);
  void load(const Schedule& schedule, const std::vector<std::size_t>& action_of_phase);

  bool advance(std::size_t stage);
  bool fire(std::size_t stage);
  bool drain(std::size_t stage);
  void step(std::size_t stage, std::uint64_t firings);
  std::uint64_t room(const Action& action) const;
  bool ended(std::size_t stage) const;
  bool complete(std::uint64_t frames) const;

  bool returns(Recurrence& recurrence, Within within);
  bool repeats_for_ever();
  void leap();

  std::vector<Program> programs_;
  std::vector<Action> actions_;
  std::vector<std::size_t> lists_;
  std::vector<Position> positions_;
  std::vector<Fifo> fifos_;

  Recurrence in_segments_;  // while no stage begins a new one
  Recurrence in_frames_;    // where the first stage begins a new one
  std::uint64_t segments_begun_ = 0;
  std::uint64_t segments_seen_ = 0;
  std::uint64_t frames_seen_ = 0;
  std::vector<std::uint64_t> state_;  // scratch
};

}  // namespace parallax
