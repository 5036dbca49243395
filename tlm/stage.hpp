// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <systemc>
#include <utility>
#include <vector>

#include "tlm/clock_domain.hpp"
#include "tlm/dataflow.hpp"
#include "tlm/kept_records.hpp"
#include "tlm/leap_history.hpp"
#include "tlm/listeners.hpp"
#include "tlm/schedule.hpp"
#include "tlm/stage_activity.hpp"
#include "tlm/stream.hpp"
#include "tlm/units.hpp"

namespace parallax {

/// When one frame went through a stage, in cycles of its clock.
struct FrameDates {
  Cycles first_firing;
  Cycles last_firing;
  Cycles first_write{-1};  ///< -1: none yet
  Cycles last_write{-1};
  StageStatistics before;  ///< until first_firing: `before.total() == first_firing`
};

/// A hardware stage: an SC_MODULE that fires by a fixed schedule.
///
/// Firing k starts in the first cycle s(k) >= s(k-1) + interval in which every input it reads has a token and
/// the pipeline has room; it reads its inputs in s(k) and writes its outputs, all in the same cycle, in the
/// first cycle w(k) >= s(k) + latency, after the firing before it has written, in which every one of them has
/// room. The pipeline is `latency` registers with a handshake each: bubbles close up under back-pressure, and
/// a firing enters when the firing `latency` firings before it leaves, s(k) >= w(k - latency). Firings that
/// write nothing take no slot in the pipeline: k counts those that write. With latency 0 reading and writing
/// are one cycle.
///
/// A stage of two sides (StageSchedule) is two such machines on the same ports: the reading side, without a
/// pipeline, and the writing side, which has the latency; each port is used by one of them. What the reading
/// side hands over can be read in the cycle in which it is written; a place that is freed can be taken in
/// the same cycle. Reports have the writing side as a stage of its own, `<name>_writing`.
///
/// A subclass declares its ports (their order numbers the bits of PortMask), gives the schedule of one frame,
/// and hangs its kernel on the rows of its inputs (Stream::on_row). Frames follow one another without end. A
/// frame is once through the schedule here: who cuts an image into tiles has a stage go through one for each.
class Stage : public sc_core::sc_module, public Actor {
 public:
  static constexpr std::size_t kMaxPorts = 8;

  ~Stage() override;

  const ClockDomain& clock() const { return clock_; }
  std::uint32_t latency() const { return latency_; }
  const Schedule& schedule() const { return schedule_; }
  /// The other side of a stage of two, which is this one's reading side; else nullptr.
  const Stage* writing_side() const { return writing_side_.get(); }
  /// The stage stops after so many frames; 0 = never.
  std::uint64_t frame_limit() const { return frame_limit_; }
  const StageStatistics& statistics() const {
    dataflow_.bring_up_to_date();
    return statistics_;
  }
  /// One entry a frame whose first firing is known; the last one may be unfinished.
  const KeptRecords<FrameDates>& frames() const {
    dataflow_.bring_up_to_date();
    return frames_;
  }
  /// At least the first and the last `number` of these are kept; all, unless this is called.
  void keep_frames(std::size_t number) { frames_.keep(number); }
  /// Likewise the dates of frame `frame`, in place of the one that was pinned before.
  void pin_frame(std::size_t frame) {
    dataflow_.bring_up_to_date();
    frames_.pin(frame);
  }
  /// Notifies `listener` of the firings from here on, besides all others (Listeners::add).
  void add_listener(StageListener& listener) {
    dataflow_.bring_up_to_date();
    listeners_.add(listener);
  }
  /// Notifies it of what is known, and of nothing after that.
  void remove_listener(StageListener& listener) {
    dataflow_.bring_up_to_date();
    listeners_.remove(listener);
  }
  /// The streams at input (output) port `port`, in order of binding; after elaboration.
  std::vector<const StreamBase*> input_streams(unsigned port) const { return at_port(inputs_, port); }
  std::vector<const StreamBase*> output_streams(unsigned port) const { return at_port(outputs_, port); }

 protected:
  /// `clock` and `dataflow` must outlive the stage.
  Stage(const sc_core::sc_module_name& name, const ClockDomain& clock, Dataflow& dataflow,
        std::uint32_t latency);

  /// The schedule of one frame; to be called before the simulation starts.
  void set_schedule(Schedule schedule) { schedule_ = std::move(schedule); }
  /// The same; to be called from the constructor.
  void set_schedule(StageSchedule schedule);

  /// The stage stops after so many frames; 0 = never. For sources: a stage with inputs ends with its input.
  void set_frame_limit(std::uint64_t frames) { frame_limit_ = frames; }

  void end_of_elaboration() override;
  void start_of_simulation() override;
  void advance() override;

 private:
  // Leap compares the whole state of a stage with that of a period before, and moves all of it on at once:
  // the pipeline, the position, the statistics. Accessors would show every member and add nothing that holds.
  friend class Leap;
  class WritingSide;
  class BatchSide;
  static constexpr std::uint64_t kStartsKept = 2 * kLeapHistory;

  struct Firing {  // one that writes
    Cycles start;
    Cycles left;  // when it left the pipeline, once that is known
    PortMask produce = 0;
    StageActivity wait = StageActivity::kBlocked;  // what it waited for room as, before it left
    const StreamBase* room = nullptr;              // the stream that had room last, if it waited
    std::uint32_t frame = 0;
  };
  struct Streams {  // of one PortMask, as a piece of Ports::streams
    StreamBase** first = nullptr;
    StreamBase** last = nullptr;
    bool in_batches = false;  // fire_batch() can go through them
    bool at_memory = false;   // one of them is
    StreamBase** begin() const { return first; }
    StreamBase** end() const { return last; }
  };
  struct Ports {  // all one way
    std::size_t count = 0;
    std::vector<StreamBase*> streams;
    std::vector<Streams> of_mask;  // every mask below 2^count
  };
  struct Position {  // of the next firing in the schedule
    std::size_t segment = 0;
    std::uint32_t phase = 0;
    // Between `phase` and `count`: side by side they would be copied as one word right after one of them was
    // written, a store-forwarding stall (some 4 ns).
    std::uint64_t repetition = 0;
    std::uint32_t count = 0;

    bool is_start() const { return count == 0 && phase == 0 && repetition == 0 && segment == 0; }
  };

  // When the firing so many firings before the last one started.
  Cycles start_of_last(std::uint64_t before) const {
    return starts_[(statistics_.firings - 1 - before) % kStartsKept];
  }

  using StreamsOfPorts = std::vector<std::vector<StreamBase*>>;
  void bind_ports(const StreamsOfPorts& in, const StreamsOfPorts& out);
  void share_ports(StreamsOfPorts in, StreamsOfPorts out);
  static Ports gather(const StreamsOfPorts& ports);
  static bool fit_batches(const Streams& streams);
  static std::vector<const StreamBase*> at_port(const Ports& ports, unsigned port);

  enum class Batch {
    kNone,     // nothing that can be done at once
    kMoved,    // there may be more
    kStopped,  // until a date is known that the streams have been asked for
  };
  bool fire();
  Batch fire_batch();
  struct Alike {
    std::size_t firings = 0;
    Cycles cycles;  // that they keep the stage busy
  };
  Alike take_alike(std::uint64_t most, std::uint32_t* intervals);
  void note_writes(const Cycles* cycles, std::size_t count);
  Firing& enter_pipeline(Cycles start, PortMask produce) {
    Firing& firing = pipe_[entered_++ & pipe_mask_];
    firing.start = firing.left = start;
    firing.produce = produce;
    firing.wait = StageActivity::kBlocked;
    firing.room = nullptr;
    firing.frame = frame_number_;
    return firing;
  }
  bool can_fire() const;
  void drain();
  bool write(Firing& firing);
  void note_write(std::uint32_t frame, Cycles cycle);
  void begin_frame(Cycles cycle);
  void observe(const Phase& phase, Streams consumed);
  static StageActivity wait_for_token(const StreamBase& stream, Cycles date, Cycles wanted);
  static StageActivity wait_for_room(const StreamBase& stream, Cycles date, Cycles wanted);
  void step();
  bool next_phase(Position& position) const {
    position.count = 0;
    const Schedule::Segment& segment = schedule_.segments()[position.segment];
    if (++position.phase < segment.phase_count) return true;
    position.phase = 0;
    if (++position.repetition < segment.repeat) return true;
    position.repetition = 0;
    return ++position.segment != schedule_.segments().size();
  }
  const Phase& phase_at(const Position& position) const {
    return schedule_.phases()[schedule_.segments()[position.segment].first_phase + position.phase];
  }
  void skip(Position& position, std::uint64_t firings) const;

  const ClockDomain& clock_;
  Dataflow& dataflow_;
  std::uint32_t latency_;
  Schedule schedule_;
  std::unique_ptr<StreamBase> handed_, kept_;  // between two sides
  std::unique_ptr<Stage> writing_side_;
  std::uint64_t frame_limit_ = 0;
  Ports inputs_;
  Ports outputs_;

  Position next_;
  const Phase* phase_ = nullptr;                                          // at next_
  std::uint64_t fire_limit_ = std::numeric_limits<std::uint64_t>::max();  // set by Leap
  std::vector<FiringDates>* observed_ = nullptr;                          // by Leap
  Listeners<StageListener> listeners_;
  std::array<Cycles, kStartsKept> starts_{};  // of the last firings
  Cycles free_{0};                            // first cycle in which the stage can fire again
  std::vector<Firing> pipe_;                  // the last firings that write, by index & pipe_mask_
  std::uint64_t pipe_mask_;
  std::uint64_t entered_ = 0;  // firings that entered the pipeline
  std::uint64_t left_ = 0;     // of these, firings whose writing date is known
  Cycles last_write_{-1};
  StageStatistics statistics_;
  KeptRecords<FrameDates> frames_;
  FrameDates* frame_ = nullptr;     // the last of these
  std::uint32_t frame_number_ = 0;  // its number
};

}  // namespace parallax
