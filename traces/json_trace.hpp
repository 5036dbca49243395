// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "traces/date_text.hpp"
#include "traces/text_buffer.hpp"
#include "traces/trace_sink.hpp"

namespace parallax {

/// Writes a trace as one JSON object: the parts, the columns of each table, which are those of CsvTrace, then
/// "events", one a line: the table, and what is in its columns. "waits" are those of a machine that is stuck.
class JsonTrace final : public TraceSink {
 public:
  explicit JsonTrace(ByteSink sink) : out_(std::move(sink)) {}

  void begin(const TraceParts& parts) override;
  void row(const StageRow& row) override;
  void fifo(const FifoSpan& span) override;
  void port_row(const PortRow& row) override;
  void frame(const FrameRecord& record) override;
  void firing(const StageFiring& firing) override;
  void token(const TokenTransfer& token) override;
  void burst(const BurstTransfer& burst) override;
  void end(Picoseconds time, const std::vector<EndlessWait>& waits) override;

 private:
  template <class Event>
  void put(const Event& event);

  TextBuffer out_;
  TraceParts parts_;
  DateText dates_;
  bool first_ = true;
};

}  // namespace parallax
