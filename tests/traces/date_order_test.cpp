// SPDX-License-Identifier: Apache-2.0
// What parts tell one by one comes out in the order of the dates, and not before all that is earlier is
// known.
#include "traces/date_order.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace parallax::test {
namespace date_order_test {

using Told = std::vector<std::string>;

class Listener final : public TraceSink {
 public:
  explicit Listener(Told& told) : told_(told) {}
  void begin(const TraceParts&) override { told_.emplace_back("begin"); }
  void row_begins(const RowBegin& row) override { note("row_begins", row.stage, row.begin); }
  void row(const StageRow& row) override { note("row", row.stage, row.end); }
  void fifo(const FifoSpan& span) override { note("fifo", span.stream, span.end); }
  void port_row(const PortRow& row) override { note("port_row", row.port, row.end); }
  void frame_step(std::int64_t frame, FrameStep, Picoseconds time) override {
    note("frame_step", static_cast<PartId>(frame), time);
  }
  void frame(const FrameRecord& record) override {
    note("frame", static_cast<PartId>(record.frame), record.at[static_cast<std::size_t>(FrameStep::kAtHost)]);
  }
  void firing(const StageFiring& firing) override { note("firing", firing.stage, firing.start); }
  void token(const TokenTransfer& token) override { note("token", token.stream, token.begin); }
  void requests(const PortRequests& requests) override { note("requests", requests.port, requests.time); }
  void burst(const BurstTransfer& burst) override { note("burst", burst.port, burst.answered); }
  void known_until(Picoseconds date) override { told_.push_back("until " + std::to_string(date.count())); }
  void end(Picoseconds time, const std::vector<EndlessWait>&) override {
    told_.push_back("end " + std::to_string(time.count()));
  }

 private:
  void note(const std::string& what, PartId part, Picoseconds date) {
    told_.push_back(what + " " + std::to_string(part) + " " + std::to_string(date.count()));
  }
  Told& told_;
};

TraceParts parts(int of_each, bool tokens) {
  TraceParts all;
  all.stages.resize(static_cast<std::size_t>(of_each));
  all.streams.resize(static_cast<std::size_t>(of_each));
  all.ports.resize(static_cast<std::size_t>(of_each));
  all.tokens = tokens;
  return all;
}

StageRow row(PartId stage, std::int64_t begin, std::int64_t end) {
  StageRow row;
  row.stage = stage;
  row.begin = Picoseconds(begin);
  row.end = Picoseconds(end);
  return row;
}

FifoSpan span(PartId stream, std::int64_t end) {
  FifoSpan span;
  span.stream = stream;
  span.end = Picoseconds(end);
  return span;
}

TEST(DateOrder, PutsPartsThatAreAheadOfEachOtherInOrder) {
  Told told;
  DateOrder order(std::make_unique<Listener>(told));
  order.begin(parts(20, false));
  for (const std::int64_t begin : {0, 10, 20, 30}) {  // the one stage is far ahead
    order.row_begins(row(17, begin, 0));
    order.row(row(17, begin, begin + 10));
  }
  order.row_begins(row(3, 5, 0));
  order.fifo(span(9, 10));
  order.known_until(Picoseconds(11));
  EXPECT_EQ(told, (Told{"begin", "row_begins 17 0", "row_begins 3 5", "fifo 9 10", "row 17 10",
                        "row_begins 17 10", "until 11"}));
  told.clear();
  order.row(row(3, 5, 20));
  order.fifo(span(9, 8));  // late: at once
  order.known_until(Picoseconds(20));
  EXPECT_EQ(told, (Told{"fifo 9 8", "until 20"}));
  told.clear();
  order.end(Picoseconds(50), {});
  EXPECT_EQ(told.front(), "row 3 20");
  EXPECT_EQ(told[told.size() - 3], "row 17 40");
  EXPECT_EQ(told.back(), "end 50");
  EXPECT_EQ(told.size(), 8u);
}

TEST(DateOrder, EveryKindOfEventGoesByItsDate) {
  Told told;
  DateOrder order(std::make_unique<Listener>(told));
  order.begin(parts(2, true));
  BurstTransfer burst;
  burst.port = 1;
  for (const std::int64_t answered : {12, 10, 11}) {  // a memory answers in an order of its own
    burst.answered = Picoseconds(answered);
    order.burst(burst);
  }
  order.requests({1, Picoseconds(9), 4});
  PortRow port_row;
  port_row.port = 0;
  port_row.end = Picoseconds(8);
  order.port_row(port_row);
  StageFiring firing;
  firing.stage = 1;
  firing.start = Picoseconds(7);
  order.firing(firing);
  order.row_begins(row(1, 6, 0));
  order.row(row(0, 0, 5));
  TokenTransfer token;
  token.stream = 1;
  token.begin = Picoseconds(4);
  order.token(token);
  order.fifo(span(0, 3));
  FrameRecord record;
  record.at[static_cast<std::size_t>(FrameStep::kAtHost)] = Picoseconds(2);
  order.frame(record);
  order.frame_step(5, FrameStep::kExposed, Picoseconds(1));
  order.end(Picoseconds(13), {});
  told.erase(told.end() - 2);  // until for ever
  EXPECT_EQ(told, (Told{"begin", "frame_step 5 1", "frame 0 2", "fifo 0 3", "token 1 4", "row 0 5",
                        "row_begins 1 6", "firing 1 7", "port_row 0 8", "requests 1 9", "burst 1 10",
                        "burst 1 11", "burst 1 12", "end 13"}));
}

}  // namespace date_order_test
}  // namespace parallax::test
