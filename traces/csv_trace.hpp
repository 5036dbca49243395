// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <tuple>

#include "traces/date_text.hpp"
#include "traces/text_buffer.hpp"
#include "traces/trace_sink.hpp"

namespace parallax {

/// Writes a trace as tables, a file each, one line an event (trace_columns.hpp): rows, fifos, ports, frames;
/// of a trace of tokens also firings, tokens, bursts. A table without an event has its heading only.
class CsvTrace final : public TraceSink {
 public:
  /// `open` is called with the name of each table.
  explicit CsvTrace(std::function<ByteSink(const std::string& table)> open) : open_(std::move(open)) {}

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
  struct Table {
    std::optional<TextBuffer> out;
  };
  template <class Event>
  std::optional<TextBuffer>& table() {
    return std::get<Table<Event>>(tables_).out;
  }
  template <class Event>
  void put(const Event& event);
  template <class Event>
  void open_table();

  std::function<ByteSink(const std::string&)> open_;
  TraceParts parts_;
  DateText dates_;
  std::tuple<Table<StageRow>, Table<FifoSpan>, Table<PortRow>, Table<FrameRecord>, Table<StageFiring>,
             Table<TokenTransfer>, Table<BurstTransfer>>
      tables_;
};

}  // namespace parallax
