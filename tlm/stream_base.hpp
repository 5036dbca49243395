// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <systemc>
#include <vector>

#include "tlm/clock_domain.hpp"
#include "tlm/dataflow.hpp"
#include "tlm/units.hpp"

namespace parallax {

/// A bounded FIFO between two stages.
struct FifoConfig {
  std::uint32_t depth = 2;  ///< tokens, 1 to 2^24
  Bits width{8};            ///< of one token
  /// Edges of the reader's clock after the writing edge until the token can be read; 1 = registered FIFO. A
  /// clock crossing adds its synchroniser stages.
  std::uint32_t write_to_read = 1;
  /// Edges of the writer's clock after the reading edge until the freed place can be written; 1 = registered
  /// FIFO.
  std::uint32_t read_to_write = 1;
};

/// What happened on a stream, in tokens and in cycles of the side that waited.
struct StreamStatistics {
  std::uint64_t written = 0;
  std::uint64_t read = 0;
  std::uint64_t high_water = 0;  ///< largest number of tokens held at the end of a cycle
  Cycles blocked_on_full;        ///< writer's cycles in which only this stream's lack of room held it back
  Cycles starved_on_empty;       ///< reader's cycles in which only this stream's lack of a token held it back
};

class StreamBase;

/// Told of every date as it becomes known, in the order of the stream's tokens on each side.
class StreamListener {
 public:
  virtual ~StreamListener() = default;
  virtual void written(const StreamBase& stream, Cycles cycle) = 0;
  virtual void read(const StreamBase& stream, Cycles cycle) = 0;
};

/// The time side of a stream: when token i was written and read.
///
/// Contract: token i cannot be read before `write_to_read` reader edges after the edge that wrote it, nor
/// written before `read_to_write` writer edges after the edge that read token i - depth. One token a cycle
/// each way. Dates are handed in once, in order, as soon as they are known, which may be long before kernel
/// time gets there.
class StreamBase : public sc_core::sc_prim_channel, public virtual sc_core::sc_interface {
 public:
  static constexpr std::uint32_t kLargestDepth = 1u << 24;  // tokens

  StreamBase(const char* name, Dataflow& dataflow, const ClockDomain& writer_clock,
             const ClockDomain& reader_clock, const FifoConfig& config);
  StreamBase(const StreamBase&) = delete;
  StreamBase& operator=(const StreamBase&) = delete;

  const char* kind() const override { return "parallax::Stream"; }

  std::uint32_t depth() const { return config_.depth; }
  Bits width() const { return config_.width; }
  Bits storage() const { return config_.width * config_.depth; }
  const ClockDomain& writer_clock() const { return writer_clock_; }
  const ClockDomain& reader_clock() const { return reader_clock_; }
  const StreamStatistics& statistics() const { return statistics_; }
  Dataflow& dataflow() const { return dataflow_; }
  /// At most one listener; nullptr for none. It must outlive the simulation.
  void listen(StreamListener* listener) { listener_ = listener; }

  /// Called by the ports: the innermost module on each side is the endpoint.
  void attach_writer(const std::string& module, Actor* actor);
  void attach_reader(const std::string& module, Actor* actor);
  const std::string& writer_name() const { return writer_name_; }
  const std::string& reader_name() const { return reader_name_; }
  /// nullptr for a thread in kernel time.
  const Actor* writer() const { return writer_; }
  const Actor* reader() const { return reader_; }

  // Reading, in cycles of the reader's clock.

  /// Whether the date of the next token to read is known.
  bool read_date_known() const { return statistics_.read < statistics_.written; }
  /// First cycle in which the next token can be read. Needs read_date_known().
  Cycles readable_at() const { return forward(write_dates_[statistics_.read & mask_]); }
  /// The next token is read in `cycle`, having held its reader back by `starved` cycles.
  void mark_read(Cycles cycle, Cycles starved);
  /// The reading actor stops here until the next token's date is known.
  void wait_for_token() { reader_waits_ = true; }

  // Writing, in cycles of the writer's clock.

  /// Whether it is known when there is room for the token `ahead` places after the next one to write.
  bool write_date_known(std::uint64_t ahead = 0) const {
    return statistics_.written + ahead < statistics_.read + config_.depth;
  }
  /// First cycle in which that token can be written. Needs write_date_known(ahead).
  Cycles writable_at(std::uint64_t ahead = 0) const {
    const std::uint64_t index = statistics_.written + ahead;
    return index < config_.depth ? Cycles(0) : backward(read_dates_[(index - config_.depth) & mask_]);
  }
  /// The next token is written in `cycle`, its writer having been held back by `blocked` cycles.
  void mark_written(Cycles cycle, Cycles blocked);
  /// The writing actor stops here until there is known to be room.
  void wait_for_room() { writer_waits_ = true; }

  bool reader_waits() const { return reader_waits_; }
  bool writer_waits() const { return writer_waits_; }

  // For threads in kernel time: block until the present cycle allows it.

  /// Returns in the first cycle, not before the present one, in which the next token can be read.
  void wait_readable();
  /// Marks the next token as read in the present cycle; call after wait_readable().
  void release();
  /// Returns in the first cycle, not before the present one, with room for the token `ahead` places after the
  /// next.
  void wait_writable(std::uint64_t ahead = 0);
  /// Marks the next token as written in the first cycle not before `time` (the present or later), one cycle
  /// after the token before at the earliest; call after wait_writable().
  void commit(const sc_core::sc_time& time = sc_core::sc_time_stamp());

 private:
  Cycles forward(Cycles written) const {
    if (same_clock_) return written + Cycles(config_.write_to_read);
    return reader_clock_.first_edge_after(writer_clock_, written) + Cycles(config_.write_to_read - 1);
  }
  Cycles backward(Cycles read) const {
    if (same_clock_) return read + Cycles(config_.read_to_write);
    return writer_clock_.first_edge_after(reader_clock_, read) + Cycles(config_.read_to_write - 1);
  }
  void settle_occupancy();

  const FifoConfig config_;
  Dataflow& dataflow_;
  const ClockDomain& writer_clock_;
  const ClockDomain& reader_clock_;
  const bool same_clock_;
  const std::uint64_t mask_;
  std::vector<Cycles> write_dates_;  // of the last tokens, by index & mask_
  std::vector<Cycles> read_dates_;
  StreamStatistics statistics_;
  std::uint64_t settled_writes_ = 0;  // writes whose occupancy has been counted
  std::uint64_t freed_ = 0;           // reads that made room before the first unsettled write
  bool reader_waits_ = false;
  bool writer_waits_ = false;
  StreamListener* listener_ = nullptr;
  Actor* writer_ = nullptr;
  Actor* reader_ = nullptr;
  std::string writer_name_ = "nobody";
  std::string reader_name_ = "nobody";
  sc_core::sc_event written_;
  sc_core::sc_event read_;
  Cycles last_read_{-1};
  Cycles last_write_{-1};
  Cycles read_wait_began_{0};
  Cycles write_wait_began_{0};
};

}  // namespace parallax
