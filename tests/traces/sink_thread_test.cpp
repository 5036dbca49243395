// SPDX-License-Identifier: Apache-2.0
// A sink in a thread of its own is told the same, in the same order, and its faults come out.
#include "traces/sink_thread.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace parallax::test {
namespace sink_thread_test {

// Keeps what it is told, as text.
class Listener final : public TraceSink {
 public:
  explicit Listener(std::vector<std::string>& told, std::size_t fails_at = 0)
      : told_(told), fails_at_(fails_at) {}
  void begin(const TraceParts& parts) override { note("begin", parts.frames); }
  void row_begins(const RowBegin& row) override { note("row_begins", row.stage); }
  void row(const StageRow& row) override { note("row", row.begin.count()); }
  void fifo(const FifoSpan& span) override { note("fifo", static_cast<std::int64_t>(span.written)); }
  void port_row(const PortRow& row) override { note("port_row", static_cast<std::int64_t>(row.bytes)); }
  void frame_step(std::int64_t frame, FrameStep step, Picoseconds time) override {
    note("frame_step", frame * 1000 + static_cast<std::int64_t>(step) * 100 + time.count());
  }
  void frame(const FrameRecord& record) override { note("frame", record.frame); }
  void firing(const StageFiring& firing) override { note("firing", firing.start.count()); }
  void token(const TokenTransfer& token) override { note("token", token.begin.count()); }
  void requests(const PortRequests& requests) override { note("requests", requests.port); }
  void burst(const BurstTransfer& burst) override { note("burst", static_cast<std::int64_t>(burst.address)); }
  void known_until(Picoseconds date) override { note("known_until", date.count()); }
  void end(Picoseconds time, const std::vector<EndlessWait>& waits) override {
    note("end", time.count() + static_cast<std::int64_t>(waits.size()));
  }

 private:
  void note(const char* what, std::int64_t number) {
    told_.push_back(what + (" " + std::to_string(number)));
    if (told_.size() == fails_at_) throw std::runtime_error("the disk is full");
  }
  std::vector<std::string>& told_;
  const std::size_t fails_at_;
};

// Every kind of event, many times; `events` of them.
void tell(TraceSink& sink, std::int64_t events) {
  TraceParts parts;
  parts.frames = 3;
  sink.begin(parts);
  for (std::int64_t i = 0; i < events; ++i) {
    StageRow row;
    row.stage = 2;
    row.begin = Picoseconds(i);
    FifoSpan span;
    span.written = static_cast<std::uint64_t>(i);
    PortRow port;
    port.bytes = static_cast<std::uint64_t>(i);
    FrameRecord record;
    record.frame = i;
    StageFiring firing{};
    firing.start = Picoseconds(i);
    TokenTransfer token{};
    token.begin = Picoseconds(i);
    PortRequests requests{};
    requests.port = 4;
    BurstTransfer burst{};
    burst.address = static_cast<std::uint64_t>(i);
    switch (i % 11) {
      case 0:
        sink.row_begins(row);
        break;
      case 1:
        sink.row(row);
        break;
      case 2:
        sink.fifo(span);
        break;
      case 3:
        sink.port_row(port);
        break;
      case 4:
        sink.frame_step(i, FrameStep::kAtHost, Picoseconds(i));
        break;
      case 5:
        sink.frame(record);
        break;
      case 6:
        sink.firing(firing);
        break;
      case 7:
        sink.token(token);
        break;
      case 8:
        sink.requests(requests);
        break;
      case 9:
        sink.known_until(Picoseconds(i));
        break;
      default:
        sink.burst(burst);
    }
  }
}

TEST(SinkThread, TellsTheSameInTheSameOrder) {
  for (const std::int64_t events : {0, 7, 100'000}) {
    std::vector<std::string> plain, threaded;
    Listener direct(plain);
    tell(direct, events);
    direct.end(Picoseconds(99), {});
    SinkThread thread(std::make_unique<Listener>(threaded), [] { FAIL() << "nothing has failed"; });
    tell(thread, events);
    thread.end(Picoseconds(99), {});
    EXPECT_EQ(threaded, plain) << events;
  }
}

TEST(SinkThread, AFaultIsToldOnceAndThrownAtTheEnd) {
  std::vector<std::string> told;
  int failures = 0;
  SinkThread thread(std::make_unique<Listener>(told, 1000), [&] { ++failures; });
  tell(thread, 1'000'000);  // many batches: the caller does not wait for a sink that has failed
  EXPECT_EQ(failures, 1);
  EXPECT_THROW(thread.end(Picoseconds(0), {}), std::runtime_error);
  EXPECT_THROW(thread.check(), std::runtime_error);
  EXPECT_EQ(told.size(), 1000U);
}

TEST(SinkThread, AFaultInTheLastBatchIsThrownToo) {
  std::vector<std::string> told;
  SinkThread thread(std::make_unique<Listener>(told, 5), [] {});
  tell(thread, 10);
  EXPECT_THROW(thread.end(Picoseconds(0), {}), std::runtime_error);
}

TEST(SinkThread, IsLeftInTheMidst) {
  std::vector<std::string> told;
  {
    SinkThread thread(std::make_unique<Listener>(told), [] {});
    tell(thread, 100'000);
  }
  EXPECT_EQ(told.front(), "begin 3");
  EXPECT_EQ(std::find(told.begin(), told.end(), "end 0"), told.end());
}

// The caller waits, and nothing is lost, when the sink is slow.
TEST(SinkThread, ASlowSinkIsWaitedFor) {
  class Slow final : public TraceSink {
   public:
    explicit Slow(int& rows) : rows_(rows) {}
    void row(const StageRow&) override {
      if (++rows_ % 1000 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }

   private:
    int& rows_;
  };
  int rows = 0;
  SinkThread thread(std::make_unique<Slow>(rows), [] {});
  thread.begin({});
  for (int i = 0; i < 50'000; ++i) thread.row({});
  thread.end(Picoseconds(0), {});
  EXPECT_EQ(rows, 50'000);
}

}  // namespace sink_thread_test
}  // namespace parallax::test
