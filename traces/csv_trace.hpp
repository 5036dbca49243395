// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <string>

#include "traces/text_buffer.hpp"
#include "traces/trace_sink.hpp"

namespace parallax {

/// Writes a trace as tables, a file each, one line an event (trace_columns.hpp): rows, fifos, ports, frames; of a trace
/// of tokens also firings, tokens, bursts. A table without an event has its heading only.
class CsvTrace final : public TraceSink {
 public:
  /// `open` is called with the name of each table.
  explicit CsvTrace(std::function<ByteSink(const std::string& table)> open) : open_(std::move(open)) {}

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
  template <class Event>
  void open_table();

  std::function<ByteSink(const std::string&)> open_;
  TraceParts parts_;
  std::map<const char*, TextBuffer> tables_;  // by the name that trace_columns gives, the same pointer each time
};

}  // namespace parallax
