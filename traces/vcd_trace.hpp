// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "traces/date_queue.hpp"
#include "traces/text_buffer.hpp"
#include "traces/trace_sink.hpp"

namespace parallax {

/// Writes a trace as a value change dump (IEEE 1364), in ps from the same zero as the model, so that it lies
/// beside the waves of RTL. For each stage whether it is at work, for what it waited before (that is known
/// when the wait is over), frame and row; for each stream whether a token is written and read in the cycle
/// (valid and ready both high) and the level of its FIFO; for each memory port its row and the requests under
/// way; and how many frames have come to each step that has a date of the kernel. Of a trace of rows, a stage
/// is at work from a row's first firing until that of the row after, write and read are 1 when tokens have
/// passed in the row's time before, and levels are those at its end.
class VcdTrace final : public TraceSink {
 public:
  explicit VcdTrace(ByteSink sink) : out_(std::move(sink)) {}

  void begin(const TraceParts& parts) override;
  void row_begins(const RowBegin& row) override;
  void row(const StageRow& row) override;
  void fifo(const FifoSpan& span) override;
  void port_row(const PortRow& row) override;
  void frame_step(std::int64_t frame, FrameStep step, Picoseconds time) override;
  void firing(const StageFiring& firing) override;
  void token(const TokenTransfer& token) override;
  void requests(const PortRequests& requests) override;
  void end(Picoseconds time, const std::vector<EndlessWait>& waits) override;

 private:
  struct Signal {
    std::string code;
    std::int32_t width = 1;
    std::int64_t value = 0;   // as it will be at time_
    std::int64_t dumped = 0;  // as it was before
    bool changed = false;     // at time_
  };
  using SignalId = std::size_t;
  struct Later {  // a change that comes by itself
    std::int64_t time;
    SignalId signal;
    std::int64_t value;
  };
  struct LaterDate {
    std::int64_t operator()(const Later& later) const { return later.time; }
  };
  struct StageSignals {
    SignalId state, waited, frame, row;
  };
  struct StreamSignals {
    SignalId write, read, level;
  };
  struct PortSignals {
    SignalId row, requests;
  };

  SignalId declare(const std::string& scope, const std::string& name, std::int32_t width);
  void change(Picoseconds time, SignalId signal, std::int64_t value);
  void change_later(Picoseconds time, SignalId signal, std::int64_t value);
  void set(SignalId signal, std::int64_t value);
  void advance(std::int64_t time);
  void dump();
  void append(const Signal& signal);

  TextBuffer out_;
  TraceParts parts_;
  std::vector<Signal> signals_;
  std::vector<std::pair<std::string, std::string>> declarations_;  // scope, $var line
  std::vector<StageSignals> stages_;
  std::vector<StreamSignals> streams_;
  std::vector<PortSignals> ports_;
  std::array<SignalId, kFrameSteps> steps_{};
  std::int64_t time_ = 0;
  std::vector<SignalId> changed_;  // at time_
  DateQueue<Later, LaterDate> later_{LaterDate{}};
};

}  // namespace parallax
