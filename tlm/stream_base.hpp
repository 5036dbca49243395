// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <systemc>
#include <utility>
#include <vector>

#include "tlm/clock_domain.hpp"
#include "tlm/dataflow.hpp"
#include "tlm/fifo_kind.hpp"
#include "tlm/leap_history.hpp"
#include "tlm/listeners.hpp"
#include "tlm/occupancy.hpp"
#include "tlm/units.hpp"

namespace parallax {

/// A bounded FIFO between two stages.
struct FifoConfig {
  std::uint32_t depth = 2;  ///< tokens in all, output registers included; 1 to 2^24
  Bits width{8};            ///< of one token
  /// For kind kFree, 1 for others (they have their own): edges of the reader's clock from the writing edge
  /// until the token can be read. 1 = registered; 0 = in the same cycle, where both sides have one clock.
  std::uint32_t write_to_read = 1;
  /// For kind kFree, 1 for others: edges of the writer's clock from the reading edge until the freed slot
  /// can be written. 1 = registered; 0 = in the same cycle, where both sides have one clock.
  std::uint32_t read_to_write = 1;
  FifoKind kind = FifoKind::kFree;           ///< which circuit; fifo_kind.hpp states the rule of each
  SynchroniserStages synchroniser_stages{};  ///< for kind kAsynchronous
  /// Cycles of the writer's clock, from 0 on, in which it takes nothing yet: those after its reset.
  std::uint32_t not_ready_cycles = 0;
  /// One end is a memory port: who waits here waits for the memory (StageStatistics::memory).
  bool at_memory = false;
  /// It joins the two sides of a stage (Stage): no FIFO of the machine, reports leave it out.
  bool inside_stage = false;
};

/// What happened on a stream, in tokens and in cycles of the side that waited.
struct StreamStatistics {
  std::uint64_t written = 0;
  std::uint64_t read = 0;
  std::uint64_t high_water = 0;  ///< largest number of tokens held at the end of a cycle
  // Of a writer or reader that waits for several streams, the wait counts where it ended: at the last of
  // them.
  Cycles blocked_on_full;   ///< writer's cycles of waiting for room here
  Cycles starved_on_empty;  ///< reader's cycles of waiting for a token here
};

/// How full a FIFO has been until a date, as its writer sees it: what a slot counts, see
/// StreamBase::occupancy().
struct FifoFill {
  Cycles until;                    ///< of the writer's clock; nothing before it can change
  std::uint64_t written = 0;       ///< tokens by then
  std::uint64_t freed = 0;         ///< of these, tokens whose slot can be written again
  std::uint64_t token_cycles = 0;  ///< tokens held, summed over the cycles until then
  std::uint64_t full_cycles = 0;   ///< without a free slot
  std::uint64_t empty_cycles = 0;  ///< without a token

  std::uint64_t level() const { return written - freed; }  ///< tokens held then
};

class StreamBase;

/// Notified of every date as it becomes known, in the order of the stream's tokens on each side.
class StreamListener {
 public:
  virtual ~StreamListener() = default;
  virtual void written(const StreamBase& stream, Cycles cycle) = 0;
  virtual void read(const StreamBase& stream, Cycles cycle) = 0;
  /// Writes (reads) in the cycles `period` again, `times` times: the first time `every` cycles later, each
  /// further time `every` cycles after the one before. Who needs only some of them need not go through all.
  virtual void written_again(const StreamBase& stream, const std::vector<Cycles>& period, Cycles every,
                             std::uint64_t times) {
    go_through(period, every, times, [&](Cycles cycle) { written(stream, cycle); });
  }
  virtual void read_again(const StreamBase& stream, const std::vector<Cycles>& period, Cycles every,
                          std::uint64_t times) {
    go_through(period, every, times, [&](Cycles cycle) { read(stream, cycle); });
  }

 protected:
  template <class Action>
  static void go_through(const std::vector<Cycles>& period, Cycles every, std::uint64_t times,
                         const Action& action) {
    Cycles later(0);
    for (std::uint64_t i = 0; i < times; ++i) {
      later += every;
      for (const Cycles cycle : period) action(cycle + later);
    }
  }
};

/// The time side of a stream: when token i was written and read.
///
/// Contract: token i cannot be read before `write_to_read` reader edges after the edge that wrote it, nor
/// written before `read_to_write` writer edges after the edge that read token i - depth; both follow from the
/// kind of FIFO (fifo_kind.hpp). No token before cycle `not_ready_cycles` of the writer's clock, and one a
/// cycle each way. Dates are handed in once, in order, as soon as they are known, which may be long before
/// kernel time gets there.
class StreamBase : public sc_core::sc_prim_channel, public virtual sc_core::sc_interface {
 public:
  static constexpr std::uint32_t kLargestDepth = 1u << 24;  // tokens
  static constexpr const char* kUnbound = "nobody";         // reader_name(), writer_name() of an open end

  /// Throws UserError, naming the stream, when a number is out of its range, when a kind for one clock is put
  /// between two, or an offset of 0 is, or when offsets are given to a kind that has its own. Clocks are two
  /// when they are two objects, of whatever frequencies.
  StreamBase(const char* name, Dataflow& dataflow, const ClockDomain& writer_clock,
             const ClockDomain& reader_clock, const FifoConfig& config);
  StreamBase(const StreamBase&) = delete;
  StreamBase& operator=(const StreamBase&) = delete;

  const char* kind() const override { return "parallax::Stream"; }

  /// As built: the offsets are those of the kind.
  const FifoConfig& config() const { return config_; }
  std::uint32_t depth() const { return config_.depth; }
  Bits width() const { return config_.width; }
  Bits storage() const { return config_.width * config_.depth; }
  /// Throws UserError, naming the stream, when it is narrower than its tokens, which have so many bits.
  void require_width(Bits tokens) const;
  /// Whether the next token, which is there in cycle `date` of the reader's clock and was wanted in cycle
  /// `wanted`, had been written by then, so that it was the synchroniser alone that kept it back.
  bool token_behind_synchroniser(Cycles date, Cycles wanted) const {
    return config_.kind == FifoKind::kAsynchronous &&
           date - Cycles(config_.synchroniser_stages.to_reader) <= wanted;
  }
  /// Likewise whether the slot of the next token, of the writer's clock, had been read.
  bool slot_behind_synchroniser(Cycles date, Cycles wanted) const {
    return config_.kind == FifoKind::kAsynchronous && statistics_.written >= config_.depth &&
           date - Cycles(config_.synchroniser_stages.to_writer) <= wanted;
  }
  /// Whether waits at this stream may count as different things, so that each is to be asked.
  bool waits_differ() const { return config_.kind == FifoKind::kAsynchronous; }
  const ClockDomain& writer_clock() const { return writer_clock_; }
  const ClockDomain& reader_clock() const { return reader_clock_; }
  bool at_memory() const { return config_.at_memory; }
  bool inside_stage() const { return config_.inside_stage; }
  const StreamStatistics& statistics() const {
    dataflow_.bring_up_to_date();
    settle();
    return statistics_;
  }
  /// How full the FIFO was, as its writer sees it: a slot counts from the write on until it can be written
  /// again.
  const Occupancy& occupancy() const {
    dataflow_.bring_up_to_date();
    settle();
    return occupancy_;
  }
  /// The same in short into `fill`, as far as it is known without going through a leap that is under way:
  /// cheap to ask for often.
  void fill(FifoFill& fill) const;
  Dataflow& dataflow() const { return dataflow_; }
  /// Notifies `listener` of the dates from here on, besides all others (Listeners::add). The next token that
  /// it sees written (read) is number statistics().written (read).
  void add_listener(StreamListener& listener) {
    dataflow_.bring_up_to_date();
    listeners_.add(listener);
  }
  /// Notifies it of what is known, and of nothing after that.
  void remove_listener(StreamListener& listener) {
    dataflow_.bring_up_to_date();
    listeners_.remove(listener);
  }

  /// Called by the ports: the innermost module on each side is the endpoint.
  void attach_writer(const std::string& module, Actor* actor);
  void attach_reader(const std::string& module, Actor* actor);
  const std::string& writer_name() const { return writer_name_; }
  const std::string& reader_name() const { return reader_name_; }
  /// nullptr for a thread in kernel time.
  const Actor* writer() const { return writer_; }
  const Actor* reader() const { return reader_; }

  // Reading, in cycles of the reader's clock.

  /// Whether the date of the token `ahead` tokens after the next one to read is known.
  bool read_date_known(std::uint64_t ahead = 0) const {
    return statistics_.read + ahead < statistics_.written;
  }
  /// First cycle in which that token can be read. Needs read_date_known(ahead).
  Cycles readable_at(std::uint64_t ahead = 0) const {
    return forward(write_dates_[(statistics_.read + ahead) & mask_]);
  }
  /// The next token is read in `cycle`, having held its reader back by `starved` cycles.
  void mark_read(Cycles cycle, Cycles starved) {
    read_dates_[statistics_.read & mask_] = cycle;
    statistics_.starved_on_empty += starved;
    ++statistics_.read;
    last_read_ = cycle;
    if (listeners_.any()) notify_read(cycle);
    if (statistics_.read % kSettleInterval == 0) settle();
    if (writer_waits_) wake_writer();
  }
  /// The reading actor stops here until the next token's date is known.
  void wait_for_token() { reader_waits_ = true; }

  // Writing, in cycles of the writer's clock.

  /// Whether it is known when there is room for the token `ahead` tokens after the next one to write.
  bool write_date_known(std::uint64_t ahead = 0) const {
    return statistics_.written + ahead < statistics_.read + config_.depth;
  }
  /// First cycle in which that token can be written. Needs write_date_known(ahead).
  Cycles writable_at(std::uint64_t ahead = 0) const {
    const std::uint64_t index = statistics_.written + ahead;
    return index < config_.depth ? Cycles(config_.not_ready_cycles)
                                 : backward(read_dates_[(index - config_.depth) & mask_]);
  }
  /// The next token is written in `cycle`, its writer having been held back by `blocked` cycles.
  void mark_written(Cycles cycle, Cycles blocked) {
    write_dates_[statistics_.written & mask_] = cycle;
    statistics_.blocked_on_full += blocked;
    ++statistics_.written;
    last_write_ = cycle;
    if (listeners_.any()) notify_written(cycle);
    if (reader_waits_) wake_reader();
  }
  /// The writing actor stops here until there is known to be room.
  void wait_for_room() { writer_waits_ = true; }

  // For a Stage that goes through many tokens, or slots, at once (stage_batch.cpp): as above one by one.

  static constexpr std::size_t kLargestBatch = 32;

  /// Tokens whose dates are known, slots of which it is known when they are free.
  std::uint64_t tokens_known() const { return statistics_.written - statistics_.read; }
  std::uint64_t slots_known() const { return statistics_.read + config_.depth - statistics_.written; }
  /// When each of the next `count` tokens can be read (slots be written); they must be known.
  void readable_at(std::size_t count, Cycles* dates) const;
  void writable_at(std::size_t count, Cycles* dates) const;
  /// The next `count` tokens, 1 to kLargestBatch, are read (written) in these cycles, having held their
  /// reader (writer) back by so many cycles in all.
  void mark_read(const Cycles* cycles, std::size_t count, Cycles starved);
  void mark_written(const Cycles* cycles, std::size_t count, Cycles blocked);

  // For a Stage: its firing, when it is not mark_written() that says so.

  /// The next token to write had its writer wait for so many cycles.
  void count_blocked(Cycles cycles) const { statistics_.blocked_on_full += cycles; }
  /// Notes for Leap that the reader (writer) was ready for the next token in cycle `ready`.
  void watch_read(Cycles ready) { note(read_watch_, ready, readable_at()); }
  void watch_write(Cycles ready) { note(write_watch_, ready, writable_at()); }

  /// When the last token was read (written), as far as leaps under way are in the numbers; -1: none was.
  Cycles last_read() const { return last_read_; }
  Cycles last_written() const { return last_write_; }

  bool reader_waits() const { return reader_waits_; }
  bool writer_waits() const { return writer_waits_; }

  // For threads in kernel time: block until the present cycle allows it.

  /// Whether the next token can be read, or written, in the present cycle. What a block in kernel time, or a
  /// circuit, does in the same cycle counts once it has done it.
  bool can_read() const { return can_read(reader_clock_.now()); }
  bool can_write() const { return can_write(writer_clock_.now()); }
  /// The same of a cycle of the reader's (writer's) clock, for who counts cycles himself: present is the one
  /// that begins next or now, so a while behind an edge its cycle has passed already.
  bool can_read(Cycles cycle) const {
    return read_date_known() && readable_at() <= cycle && last_read_ < cycle;
  }
  bool can_write(Cycles cycle) const {
    return write_date_known() && writable_at() <= cycle && last_write_ < cycle;
  }
  /// Returns in the first cycle, not before the present one, in which the next token can be read.
  void wait_readable();
  /// Marks the next token as read in the present cycle; call after wait_readable().
  void release();
  /// Returns in the first cycle, not before the present one, with room for the token `ahead` tokens after the
  /// next.
  void wait_writable(std::uint64_t ahead = 0);
  /// Marks the next token as written in the first cycle not before `time` (the present or later), one cycle
  /// after the token before at the earliest; call after wait_writable().
  void commit(const sc_core::sc_time& time = sc_core::sc_time_stamp());

 private:
  // Leap compares the dates and counts of a stream with those of a period before, and moves all of them on at
  // once. Accessors would show every member and add nothing that holds.
  friend class Leap;
  struct Ahead {  // a leap under way over this stream, periods that are not in its numbers yet
    const std::uint64_t* periods_gone = nullptr;   // through in all
    const std::uint64_t* periods_added = nullptr;  // of these, in the numbers
    Cycles period;
    std::uint64_t tokens = 0, token_cycles = 0, full_cycles = 0, empty_cycles = 0;  // of one
  };
  struct Watch {         // what Leap wants to know of one period
    bool binds = false;  // a date of this stream held its reader (writer) back
    std::vector<Cycles>
        ready;  // when the reader (writer) was ready for each token, whatever this stream's date
    void reset() {
      binds = false;
      ready.clear();
    }
  };
  static void note(Watch& watch, Cycles ready, Cycles date) {
    watch.ready.push_back(ready);
    watch.binds = watch.binds || date > ready;
  }
  Cycles write_date(std::uint64_t token) const { return write_dates_[token & mask_]; }
  Cycles read_date(std::uint64_t token) const { return read_dates_[token & mask_]; }
  std::uint64_t history() const { return mask_ + 1; }

  Cycles forward(Cycles written) const {
    if (same_frequency_) return written + Cycles(config_.write_to_read);
    return reader_clock_.first_edge_after(writer_clock_, written) + Cycles(config_.write_to_read - 1);
  }
  Cycles backward(Cycles read) const {
    if (same_frequency_) return read + Cycles(config_.read_to_write);
    return writer_clock_.first_edge_after(reader_clock_, read) + Cycles(config_.read_to_write - 1);
  }
  void settle() const;
  template <class Rise, class Fall>
  void go_through_levels(Rise rise, Fall fall) const;
  void settle_one_by_one() const;
  void notify_read(Cycles cycle);
  void notify_written(Cycles cycle);
  void wake_reader();
  void wake_writer();

  // Reads between two counts of the occupancy; the rings hold the dates until then, and those of a batch.
  static constexpr std::uint64_t kSettleInterval = 16;
  static_assert(kSettleInterval + kLargestBatch <= kLeapHistory);

  const FifoConfig config_;
  Dataflow& dataflow_;
  const ClockDomain& writer_clock_;
  const ClockDomain& reader_clock_;
  const bool same_frequency_;
  const std::uint64_t mask_;
  std::vector<Cycles> write_dates_;  // of the last tokens, by index & mask_
  std::vector<Cycles> read_dates_;
  // The occupancy is counted a little after the dates, or when the statistics are read.
  mutable StreamStatistics statistics_;
  mutable Occupancy occupancy_;
  mutable std::uint64_t settled_writes_ = 0;  // writes and
  mutable std::uint64_t freed_ = 0;           // reads whose effect on the occupancy has been counted
  mutable Cycles settled_until_{0};           // the occupancy has been counted up to here
  bool reader_waits_ = false;
  bool writer_waits_ = false;
  Listeners<StreamListener> listeners_;
  Actor* writer_ = nullptr;
  Actor* reader_ = nullptr;
  std::string writer_name_ = kUnbound;
  std::string reader_name_ = kUnbound;
  sc_core::sc_event written_;
  sc_core::sc_event read_;
  Watch read_watch_;
  Watch write_watch_;
  std::vector<std::pair<std::uint64_t, std::uint64_t>>* counted_ =
      nullptr;  // Leap's copy of what occupancy_ adds
  Ahead ahead_;
  Cycles last_read_{-1};
  Cycles last_write_{-1};
  Cycles read_wait_began_{0};
  Cycles write_wait_began_{0};
};

}  // namespace parallax
