// SPDX-License-Identifier: Apache-2.0
#include "tlm/dram_controller.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>

#include "tests/tlm/naive_dram.hpp"

namespace parallax::test {
namespace dram_controller_test {

class Log final : public DramListener {
 public:
  void command(std::int64_t clock, DramCommand command, std::uint32_t bank, std::uint32_t row) override {
    commands.push_back({clock, command, bank, row});
  }
  std::vector<LoggedCommand> commands;
};

std::string text(const std::vector<LoggedCommand>& log, std::size_t from) {
  std::string lines;
  for (std::size_t i = from; i < std::min(log.size(), from + 10); ++i) {
    lines += fmt::format("{}: {} bank {} row {}\n", log[i].clock, static_cast<int>(log[i].command),
                         log[i].bank, log[i].row);
  }
  return lines;
}

// Where the logs part, up to clock `end`; empty when they do not.
std::string difference(std::vector<LoggedCommand> a, std::vector<LoggedCommand> b, std::int64_t end) {
  const auto cut = [end](std::vector<LoggedCommand>& log) {
    while (!log.empty() && log.back().clock >= end) log.pop_back();
  };
  cut(a);
  cut(b);
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    if (i < a.size() && i < b.size() && a[i] == b[i]) continue;
    const std::size_t from = i < 6 ? 0 : i - 6;
    return fmt::format("command {}:\n{}but\n{}", i, text(a, from), text(b, from));
  }
  return "";
}

DramTiming random_timing(std::mt19937& random) {
  const auto number = [&random](int low, int high) {
    return low + static_cast<std::int64_t>(random() % static_cast<unsigned>(high - low + 1));
  };
  DramTiming t;
  t.bank_groups = 1 << number(0, 2);
  t.banks = t.bank_groups << number(0, 2);
  t.burst_length = 4 << number(0, 2);
  t.ccd = t.burst_clocks() + number(0, 1);
  t.ccd_group = t.ccd + number(0, 3);
  t.cl = number(3, 20);
  t.cwl = number(2, 15);
  t.rcd = number(2, 15);
  t.rp = number(2, 15);
  t.rp_all = t.rp + number(0, 4);
  t.ras = t.rcd + number(2, 20);
  t.rc = t.ras + t.rp + number(0, 2);
  t.rrd = number(1, 8);
  t.rrd_group = t.rrd + number(0, 3);
  t.faw = number(0, 40);
  t.wr = number(1, 15);
  t.wtr = number(1, 8);
  t.wtr_group = t.wtr + number(0, 5);
  t.rtp = number(1, 10);
  t.rtw = number(3, 15);
  t.rfc = number(20, 200);
  t.refi = number(0, 3) == 0 ? 0 : number(400, 3000);
  return t;
}

RC_GTEST_PROP(DramController, EveryCommandIsThatOfTheClockByClockReference, (std::uint32_t seed)) {
  std::mt19937 random(seed);
  const DramTiming timing = random_timing(random);
  const auto draw = [&random] { return static_cast<unsigned>(random()); };
  DramPolicy policy;
  policy.read_queue = 1 + draw() % 32;
  policy.write_queue = 2 + draw() % 31;
  policy.high_watermark = 1 + draw() % policy.write_queue;
  policy.low_watermark = draw() % policy.high_watermark;
  policy.longest_batch = 1 + draw() % 40;
  DramController controller(timing, policy);
  Log log;
  controller.add_listener(log);
  NaiveDram naive(timing, policy);
  const unsigned rows = 1 + draw() % 3;
  const unsigned load = 1 + draw() % 12;  // an arrival in so many clocks
  const unsigned writes = draw() % 101;   // percent
  std::vector<DramController::Done> done;
  constexpr std::int64_t kEnd = 4000;
  std::uint64_t submitted = 0;
  for (std::int64_t clock = 0; clock < kEnd; ++clock) {
    std::vector<DramController::Burst> arrivals;
    const bool burst_of_traffic = clock / 500 % 2 == 0;
    controller.run_until(clock, done);
    if (burst_of_traffic && draw() % load == 0) {
      DramController::Burst burst;
      burst.location = {static_cast<std::uint32_t>(draw() % static_cast<unsigned>(timing.banks)),
                        static_cast<std::uint32_t>(draw() % rows)};
      burst.write = draw() % 100 < writes;
      burst.tag = submitted;
      const bool room = controller.room(burst.write);
      if (room != naive.room(burst.write)) RC_FAIL(difference(naive.log(), log.commands, clock));
      if (room) arrivals.push_back(burst);
    }
    naive.tick(clock, arrivals);
    if (!arrivals.empty()) {
      controller.run_until(clock + 1, done);
      controller.submit(arrivals[0], clock);
      ++submitted;
    }
  }
  controller.run_until(kEnd, done);
  const std::string text = difference(naive.log(), log.commands, kEnd);
  if (!text.empty()) RC_FAIL(text);
  const DramStatistics& statistics = controller.statistics();
  RC_ASSERT(done.size() == statistics.reads + statistics.writes);
  RC_CLASSIFY(submitted > 100);
}

// Clocks from entry to the last beat of one read.
std::int64_t latency(DramController& controller, const DramLocation& location, std::int64_t clock) {
  std::vector<DramController::Done> done;
  controller.run_until(clock + 1, done);
  controller.submit({location, 0, false}, clock);
  controller.run_until(clock + 200, done);
  return done.back().data_end - clock;
}

TEST(DramController, ReadsOfAClosedBankAnOpenRowAndAnotherRow) {
  DramController controller({}, {});  // 7-7-7, a burst of four clocks
  EXPECT_EQ(latency(controller, {0, 5}, 0), 1 + 7 + 7 + 4);
  EXPECT_EQ(latency(controller, {0, 5}, 300), 1 + 7 + 4);
  EXPECT_EQ(latency(controller, {0, 6}, 600), 1 + 7 + 7 + 7 + 4);
}

// Writes that come as fast as they are written: the queue never falls to the low watermark.
TEST(DramController, AStreamOfWritesKeepsNoReadWaitingToItsEnd) {
  DramTiming timing;
  timing.refi = 0;
  for (const std::size_t batch : {16u, 64u, 1024u}) {
    DramPolicy policy;
    policy.longest_batch = batch;
    DramController controller(timing, policy);
    std::vector<DramController::Done> done;
    for (std::int64_t clock = 0; controller.statistics().writes < 2000; ++clock) {
      controller.run_until(clock + 1, done);
      if (clock == 200) controller.submit({{1, 0}, 1, false}, clock);
      if (clock != 200 && controller.room(true)) controller.submit({{0, 0}, 0, true}, clock);
    }
    const auto read = std::find_if(done.begin(), done.end(), [](const auto& d) { return !d.write; });
    ASSERT_NE(read, done.end()) << batch;
    // A write takes the bus for four clocks. Some forty have gone when the read comes.
    const auto waited = static_cast<std::size_t>(read - done.begin()) - 200 / 4;
    EXPECT_NEAR(static_cast<double>(waited), static_cast<double>(batch), 12) << batch;
  }
}

TEST(DramController, EfficiencyStretchesTheColumnCommands) {
  DramTiming timing;
  timing.refi = 0;
  DramPolicy policy;
  policy.efficiency = 80;  // a burst of four clocks takes five
  DramController controller(timing, policy);
  std::vector<DramController::Done> done;
  for (std::int64_t clock = 0; done.size() < 1000; ++clock) {
    controller.run_until(clock + 1, done);
    if (controller.room(false)) controller.submit({{0, 0}, 0, false}, clock);
  }
  EXPECT_EQ(done[999].data_end - done[0].data_end, 999 * 5);
}

TEST(DramController, WaitsForNothingButRefreshesWhenIdle) {
  DramController controller({}, {});
  EXPECT_EQ(controller.next_command(), DramController::kNever);
  std::vector<DramController::Done> done;
  controller.run_until(4160 * 10, done);
  EXPECT_EQ(controller.statistics().refreshes, 9u);
  controller.run_until(4160 * 10 + 1, done);
  EXPECT_EQ(controller.statistics().refreshes, 10u);
}

// Long pauses are gone over at once, with the refreshes that fall in them.
TEST(DramController, RefreshesWithoutWorkAreCountedNotGoneThrough) {
  const DramTiming timing;
  std::vector<DramController::Done> one, other;
  DramController stepped(timing, {}), leapt(timing, {});
  struct Listener final : DramListener {  // who listens is told of each
    void command(std::int64_t, DramCommand, std::uint32_t, std::uint32_t) override {}
  } listener;
  stepped.add_listener(listener);
  for (DramController* controller : {&stepped, &leapt}) {
    std::vector<DramController::Done>& done = controller == &stepped ? one : other;
    for (const DramController::Clock at : {10, 5000, 1'000'000, 1'004'160}) {
      controller->run_until(at, done);
      controller->submit({{3, 7}, 1, at % 20 == 0}, at);
    }
    controller->run_until(2'000'000, done);
  }
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].data_end, other[i].data_end);
  EXPECT_EQ(stepped.statistics().refreshes, leapt.statistics().refreshes);
  EXPECT_EQ(stepped.statistics().refreshes, 480u);
  leapt.run_until(1'000'000'000'000'000, other);  // at once, or this test takes days
  EXPECT_EQ(leapt.statistics().refreshes, 1'000'000'000'000'000 / 4160u);
}

}  // namespace dram_controller_test
}  // namespace parallax::test
