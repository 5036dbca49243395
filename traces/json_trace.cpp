// SPDX-License-Identifier: Apache-2.0
#include "traces/json_trace.hpp"

#include <nlohmann/json.hpp>
#include <type_traits>

#include "traces/json_text.hpp"
#include "traces/trace_columns.hpp"

namespace parallax {
namespace {

// One event: its table, then what is in the columns. No name of a part needs to be escaped.
class JsonLine {
 public:
  JsonLine(TextBuffer& out, DateText& dates, bool first, std::string_view table)
      : out_(out), dates_(dates), at_(out.room(kMost)) {
    at_ = put(put(put(at_, first ? "\n[\"" : ",\n[\""), table), "\"");
  }
  ~JsonLine() { out_.added_until(put(at_, "]")); }
  JsonLine(const JsonLine&) = delete;
  JsonLine& operator=(const JsonLine&) = delete;

  void text(std::string_view, std::string_view value) { at_ = put(put(put(at_, ",\""), value), "\""); }
  void number(std::string_view, std::int64_t value) { at_ = put(put(at_, ","), value); }
  void date(std::string_view, Picoseconds value) { at_ = dates_.put(put(at_, ","), value); }
  void flag(std::string_view, bool value) { at_ = put(at_, value ? ",true" : ",false"); }

 private:
  static constexpr std::size_t kMost = 2048;

  TextBuffer& out_;
  DateText& dates_;
  char* at_;
};

}  // namespace

void JsonTrace::begin(const TraceParts& parts) {
  parts_ = parts;
  auto stages = nlohmann::ordered_json::array();
  for (const TraceParts::StagePart& stage : parts.stages)
    stages.push_back({{"name", stage.name}, {"path", stage.path}});
  auto streams = nlohmann::ordered_json::array();
  for (const TraceParts::StreamPart& stream : parts.streams) {
    streams.push_back({{"name", stream.name},
                       {"path", stream.path},
                       {"depth_tokens", stream.depth},
                       {"width_bits", stream.width},
                       {"writer", stream.writer},
                       {"reader", stream.reader}});
  }
  auto ports = nlohmann::ordered_json::array();
  for (const TraceParts::PortPart& port : parts.ports)
    ports.push_back({{"name", port.name}, {"path", port.path}});
  nlohmann::ordered_json columns;
  const auto add_columns = [&columns](const auto& event) {
    columns[std::string(trace_columns::table_of(event))] =
        trace_columns::names<std::decay_t<decltype(event)>>();
  };
  add_columns(StageRow{});
  add_columns(FifoSpan{});
  add_columns(PortRow{});
  add_columns(FrameRecord{});
  add_columns(StageFiring{});
  add_columns(TokenTransfer{});
  add_columns(BurstTransfer{});
  const nlohmann::ordered_json head{{"time_unit", "ps"},    {"frames", parts.frames}, {"rows", parts.rows},
                                    {"tiles", parts.tiles}, {"stages", stages},       {"streams", streams},
                                    {"ports", ports},       {"columns", columns}};
  std::string text = json_text(head, 1);
  text.erase(text.rfind('\n'));
  out_.add(text);
  out_.add(std::string_view(",\n \"events\": ["));
}

template <class Event>
void JsonTrace::put(const Event& event) {
  JsonLine line(out_, dates_, first_, trace_columns::table_of(event));
  first_ = false;
  trace_columns::put(line, parts_, event);
}

void JsonTrace::row(const StageRow& row) { put(row); }
void JsonTrace::fifo(const FifoSpan& span) { put(span); }
void JsonTrace::port_row(const PortRow& row) { put(row); }
void JsonTrace::frame(const FrameRecord& record) { put(record); }
void JsonTrace::firing(const StageFiring& firing) { put(firing); }
void JsonTrace::token(const TokenTransfer& token) { put(token); }
void JsonTrace::burst(const BurstTransfer& burst) { put(burst); }

void JsonTrace::end(Picoseconds time, const std::vector<EndlessWait>& waits) {
  auto list = nlohmann::ordered_json::array();
  for (const EndlessWait& wait : waits) {
    list.push_back({{"waiter", wait.waiter},
                    {"stream", wait.stream},
                    {"state", wait.on_full ? "full" : "empty"},
                    {"depth_tokens", wait.depth}});
  }
  out_.add(std::string_view("\n],\n \"end_ps\": "));
  out_.add(time.count());
  out_.add(std::string_view(",\n \"waits\": "));
  out_.add(json_text(list));
  out_.add(std::string_view("\n}\n"));
  out_.write();
}

}  // namespace parallax
