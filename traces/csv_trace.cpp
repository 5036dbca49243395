// SPDX-License-Identifier: Apache-2.0
#include "traces/csv_trace.hpp"

#include <fmt/format.h>

#include "traces/trace_columns.hpp"

namespace parallax {
namespace {

// One line. No name of a part has a comma or a quote.
class CsvLine {
 public:
  CsvLine(TextBuffer& out, DateText& dates) : out_(out), dates_(dates), at_(out.room(kMost)) {}
  ~CsvLine() {
    at_[-1] = '\n';  // over the last comma
    out_.added_until(at_);
  }
  CsvLine(const CsvLine&) = delete;
  CsvLine& operator=(const CsvLine&) = delete;

  void text(std::string_view, std::string_view value) { at_ = put(put(at_, value), ","); }
  void number(std::string_view, std::int64_t value) { at_ = put(put(at_, value), ","); }
  void date(std::string_view, Picoseconds value) { at_ = put(dates_.put(at_, value), ","); }
  void flag(std::string_view, bool value) { at_ = put(at_, value ? "1," : "0,"); }

 private:
  static constexpr std::size_t kMost = 2048;

  TextBuffer& out_;
  DateText& dates_;
  char* at_;
};

}  // namespace

template <class Event>
void CsvTrace::open_table() {
  TextBuffer& out = table<Event>().emplace(open_(std::string(trace_columns::table_of(Event{}))));
  out.add(fmt::format("{}\n", fmt::join(trace_columns::names<Event>(), ",")));
}

void CsvTrace::begin(const TraceParts& parts) {
  parts_ = parts;
  open_table<StageRow>();
  open_table<FifoSpan>();
  open_table<PortRow>();
  open_table<FrameRecord>();
  if (!parts.tokens) return;
  open_table<StageFiring>();
  open_table<TokenTransfer>();
  open_table<BurstTransfer>();
}

template <class Event>
void CsvTrace::put(const Event& event) {
  CsvLine line(*table<Event>(), dates_);
  trace_columns::put(line, parts_, event);
}

void CsvTrace::row(const StageRow& row) { put(row); }
void CsvTrace::fifo(const FifoSpan& span) { put(span); }
void CsvTrace::port_row(const PortRow& row) { put(row); }
void CsvTrace::frame(const FrameRecord& record) { put(record); }
void CsvTrace::firing(const StageFiring& firing) { put(firing); }
void CsvTrace::token(const TokenTransfer& token) { put(token); }
void CsvTrace::burst(const BurstTransfer& burst) { put(burst); }

void CsvTrace::end(Picoseconds, const std::vector<EndlessWait>&) {
  std::apply([](auto&... tables) { ((tables.out ? tables.out->write() : void()), ...); }, tables_);
}

}  // namespace parallax
