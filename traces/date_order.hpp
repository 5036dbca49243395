// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <limits>
#include <memory>
#include <vector>

#include "traces/date_queue.hpp"
#include "traces/trace_sink.hpp"

namespace parallax {

/// Puts what is told part by part into the order of the dates, for a sink that wants it so. Events are kept
/// until what is earlier is known; those of one date go in the order of the parts.
class DateOrder final : public TraceSink {
 public:
  explicit DateOrder(std::shared_ptr<TraceSink> sink) : sink_(std::move(sink)) {}

  void begin(const TraceParts& parts) override;
  void row_begins(const RowBegin& row) override { row_begins_[index(row.stage)]->push(row); }
  void row(const StageRow& row) override { rows_[index(row.stage)]->push(row); }
  void fifo(const FifoSpan& span) override { fifos_[index(span.stream)]->push(span); }
  void port_row(const PortRow& row) override { port_rows_[index(row.port)]->push(row); }
  void frame_step(std::int64_t frame, FrameStep step, Picoseconds time) override {
    steps_->push({frame, step, time});
  }
  void frame(const FrameRecord& record) override { frames_->push(record); }
  void firing(const StageFiring& firing) override { firings_[index(firing.stage)]->push(firing); }
  void token(const TokenTransfer& token) override { tokens_[index(token.stream)]->push(token); }
  void requests(const PortRequests& requests) override { requests_[index(requests.port)]->push(requests); }
  void burst(const BurstTransfer& burst) override { bursts_[index(burst.port)]->push(burst); }
  /// Tells the sink of all before `date`.
  void known_until(Picoseconds date) override;
  /// Tells the sink of all that is left.
  void end(Picoseconds time, const std::vector<EndlessWait>& waits) override;

 private:
  static constexpr Picoseconds kNever{std::numeric_limits<std::int64_t>::max()};

  struct Step {
    std::int64_t frame;
    FrameStep step;
    Picoseconds time;
  };

  // Events of one kind and part, in the order of their dates.
  class Lane {
   public:
    virtual ~Lane() = default;
    /// Date of the next event; kNever when there is none.
    virtual Picoseconds next() const = 0;
    /// Tells the events of that date, and returns the next one.
    virtual Picoseconds tell(TraceSink& sink) = 0;
  };
  template <class Event>
  class EventLane final : public Lane {
   public:
    void push(const Event& event) { events_.push(event); }
    Picoseconds next() const override { return events_.empty() ? kNever : events_.date(); }
    Picoseconds tell(TraceSink& sink) override;

   private:
    struct Date {
      Picoseconds operator()(const Event& event) const { return date_of(event); }
    };
    DateQueue<Event, Date> events_{Date{}};
  };
  template <class Event>
  using Lanes = std::vector<EventLane<Event>*>;  // by number of the part

  static Picoseconds date_of(const RowBegin& row) { return row.begin; }
  static Picoseconds date_of(const StageRow& row) { return row.end; }
  static Picoseconds date_of(const FifoSpan& span) { return span.end; }
  static Picoseconds date_of(const PortRow& row) { return row.end; }
  static Picoseconds date_of(const Step& step) { return step.time; }
  static Picoseconds date_of(const FrameRecord& record) { return record.at[index_of(FrameStep::kAtHost)]; }
  static Picoseconds date_of(const StageFiring& firing) { return firing.start; }
  static Picoseconds date_of(const TokenTransfer& token) { return token.begin; }
  static Picoseconds date_of(const PortRequests& requests) { return requests.time; }
  static Picoseconds date_of(const BurstTransfer& burst) { return burst.answered; }

  static void tell(TraceSink& sink, const RowBegin& row) { sink.row_begins(row); }
  static void tell(TraceSink& sink, const StageRow& row) { sink.row(row); }
  static void tell(TraceSink& sink, const FifoSpan& span) { sink.fifo(span); }
  static void tell(TraceSink& sink, const PortRow& row) { sink.port_row(row); }
  static void tell(TraceSink& sink, const Step& step) { sink.frame_step(step.frame, step.step, step.time); }
  static void tell(TraceSink& sink, const FrameRecord& record) { sink.frame(record); }
  static void tell(TraceSink& sink, const StageFiring& firing) { sink.firing(firing); }
  static void tell(TraceSink& sink, const TokenTransfer& token) { sink.token(token); }
  static void tell(TraceSink& sink, const PortRequests& requests) { sink.requests(requests); }
  static void tell(TraceSink& sink, const BurstTransfer& burst) { sink.burst(burst); }

  static std::size_t index(PartId part) { return part; }
  template <class Event>
  EventLane<Event>* add_lane();

  const std::shared_ptr<TraceSink> sink_;
  std::vector<std::unique_ptr<Lane>> lanes_;  // in the order in which those of one date go
  EventLane<Step>* steps_ = nullptr;
  EventLane<FrameRecord>* frames_ = nullptr;
  Lanes<RowBegin> row_begins_;
  Lanes<StageRow> rows_;
  Lanes<FifoSpan> fifos_;
  Lanes<PortRow> port_rows_;
  Lanes<StageFiring> firings_;
  Lanes<TokenTransfer> tokens_;
  Lanes<PortRequests> requests_;
  Lanes<BurstTransfer> bursts_;
};

}  // namespace parallax
