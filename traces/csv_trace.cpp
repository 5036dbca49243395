// SPDX-License-Identifier: Apache-2.0
#include "traces/csv_trace.hpp"

#include "traces/trace_columns.hpp"

namespace parallax {
namespace {

// The columns' names.
class Heading {
 public:
  explicit Heading(TextBuffer& out) : out_(out) {}
  void text(const char* name, std::string_view) { put(name); }
  void number(const char* name, std::int64_t) { put(name); }
  void flag(const char* name, bool) { put(name); }

 private:
  void put(const char* name) {
    if (!first_) out_.add(',');
    first_ = false;
    out_.add(std::string_view(name));
  }
  TextBuffer& out_;
  bool first_ = true;
};

// One line. No name of a part has a comma or a quote.
class Line {
 public:
  explicit Line(TextBuffer& out) : out_(out) {}
  void text(const char*, std::string_view value) {
    separate();
    out_.add(value);
  }
  void number(const char*, std::int64_t value) {
    separate();
    out_.add(value);
  }
  void flag(const char*, bool value) {
    separate();
    out_.add(value ? '1' : '0');
  }

 private:
  void separate() {
    if (!first_) out_.add(',');
    first_ = false;
  }
  TextBuffer& out_;
  bool first_ = true;
};

}  // namespace

template <class Event>
void CsvTrace::open_table() {
  const char* const table = trace_columns::table_of(Event{});
  TextBuffer& out = tables_.emplace(table, TextBuffer(open_(table))).first->second;
  // Names do not depend on values, but a part must have one.
  TraceParts parts;
  parts.stages.resize(1);
  parts.ports.resize(1);
  Event event{};
  if constexpr (std::is_same_v<Event, StageRow> || std::is_same_v<Event, StageFiring>) event.stage = 0;
  if constexpr (std::is_same_v<Event, PortRow> || std::is_same_v<Event, BurstTransfer>) event.port = 0;
  Heading heading(out);
  trace_columns::put(heading, parts, event);
  out.add('\n');
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
  TextBuffer& out = tables_.find(trace_columns::table_of(event))->second;
  Line line(out);
  trace_columns::put(line, parts_, event);
  out.add('\n');
  out.write_if_full();
}

void CsvTrace::end(Picoseconds, const std::vector<EndlessWait>&) {
  for (auto& [table, out] : tables_) out.write();
}

}  // namespace parallax
