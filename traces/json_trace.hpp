// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "traces/text_buffer.hpp"
#include "traces/trace_sink.hpp"

namespace parallax {

/// Writes a trace as one JSON object: the parts, then "events", one a line, each with its "table" and the
/// columns of CsvTrace; "waits" for a machine that is stuck.
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
  bool first_ = true;
};

}  // namespace parallax
