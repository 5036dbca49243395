// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "traces/text_buffer.hpp"
#include "traces/trace_sink.hpp"

namespace parallax {

/// Writes a trace as one JSON object: the parts, then "events", one a line, each with its "table" and the columns of
/// CsvTrace; "waits" for a machine that is stuck.
class JsonTrace final : public TraceSink {
 public:
  explicit JsonTrace(ByteSink sink) : out_(std::move(sink)) {}

  void begin(const TraceParts& parts) override;
  void row(const StageRow& row) override { put(row); }
  void fifo(const FifoSpan& span) override { put(span); }
  void port_row(const PortRow& row) override { put(row); }
  void frame(const FrameRecord& record) override { put(record); }
  void firing(const StageFiring& firing) override { put(firing); }
  void token(const TokenTransfer& token) override { put(token); }
  void burst(const BurstTransfer& burst) override { put(burst); }
  void end(Picoseconds time, const std::vector<EndlessWait>& waits) override;

 private:
  template <class Event>
  void put(const Event& event);

  TextBuffer out_;
  TraceParts parts_;
  bool first_ = true;
};

}  // namespace parallax
