// SPDX-License-Identifier: Apache-2.0
// The order of a raster stage's reads and writes, firing by firing, against loops written from its contract;
// and the dates of a stage whose frames overlap, by hand.
#include "modules/raster_schedule.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>
#include <vector>

#include "tests/timing/date_log.hpp"
#include "tests/timing/graph_thread.hpp"
#include "tests/timing/in_child.hpp"
#include "tlm/stage.hpp"

namespace parallax::test {
namespace raster_schedule_test {

struct Fired {
  unsigned reads;
  unsigned writes;
  std::uint32_t cycles;

  bool operator==(const Fired& other) const {
    return reads == other.reads && writes == other.writes && cycles == other.cycles;
  }
};

std::vector<Fired> firings(const Schedule& schedule) {
  std::vector<Fired> all;
  for (const Schedule::Segment& segment : schedule.segments()) {
    for (std::uint64_t i = 0; i < segment.repeat; ++i) {
      for (std::uint32_t p = 0; p < segment.phase_count; ++p) {
        const Phase& phase = schedule.phases()[segment.first_phase + p];
        for (std::uint32_t n = 0; n < phase.count; ++n)
          all.push_back({phase.consume, phase.produce, phase.interval});
      }
    }
  }
  return all;
}

// A schedule needs a place to be made in; nothing runs there.
const StageContext& nowhere() {
  static const ClockDomain clock("clock", Hertz(100'000'000));
  static Dataflow dataflow("dataflow");
  static const StageContext context{clock, dataflow, 4, 2};
  return context;
}

int draw(int low, int high) { return *rc::gen::inRange(low, high + 1); }

struct Case {
  StageContext context = nowhere();
  RasterSchedule raster;

  Case() {
    context.pixels_per_token = draw(1, 4);
    context.width = context.pixels_per_token * draw(1, 6);
    context.height = draw(1, 5);
    raster.groups = static_cast<std::uint32_t>(draw(1, 4));
    raster.step = raster.groups * static_cast<std::uint32_t>(draw(1, 3));
    raster.timing.interval = static_cast<std::uint32_t>(draw(1, 3));
    raster.last_interval = static_cast<std::uint32_t>(draw(1, 6));
    raster.timing.row_overhead = static_cast<std::uint32_t>(draw(0, 1) * draw(1, 4));
    raster.timing.frame_overhead = static_cast<std::uint32_t>(draw(0, 1) * draw(1, 4));
    raster.look_ahead = static_cast<std::uint64_t>(draw(0, static_cast<int>(context.tokens())));
    raster.reads.first = 0b1;
    raster.writes.every = 0b1;
  }
};

// A token's firings: in each of them it writes, in the first one it reads; after the last one of a step the
// stage rests.
void add_token(std::vector<Fired>& all, const RasterSchedule& raster, std::uint64_t token, unsigned reads,
               unsigned writes) {
  for (std::uint32_t g = 0; g < raster.groups; ++g) {
    const bool rests = (token * raster.groups + g + 1) % raster.step == 0;
    const std::uint32_t interval = raster.timing.interval;
    all.push_back({g == 0 ? reads : 0, writes,
                   rests && raster.last_interval > interval ? raster.last_interval : interval});
  }
}

RC_GTEST_PROP(RasterSchedule, ReadsAheadOfWhatItWritesAndEmptiesItself, ()) {
  const Case c;
  const StageSchedule schedule = make_schedule(c.context, c.raster);
  RC_ASSERT(schedule.writing.empty());
  const std::uint64_t tokens = c.context.tokens();
  const std::uint64_t ahead = c.raster.look_ahead;
  std::vector<Fired> want;
  for (std::uint64_t i = 0; i < tokens + ahead; ++i) {
    const std::uint64_t token = i < tokens ? i : i - ahead;  // whose place in a step counts
    add_token(want, c.raster, token, i < tokens ? 1 : 0, i >= ahead ? 1 : 0);
    const bool row_ends = (token + 1) % c.context.row_tokens() == 0;
    if (row_ends && (i < tokens || ahead == tokens) && c.raster.timing.row_overhead > 0)
      want.push_back({0, 0, c.raster.timing.row_overhead});
  }
  if (c.raster.timing.frame_overhead > 0) want.push_back({0, 0, c.raster.timing.frame_overhead});
  RC_ASSERT(firings(schedule.reading) == want);
}

RC_GTEST_PROP(RasterSchedule, TwoSidesMeetAtEachTokenThatIsWritten, ()) {
  Case c;
  c.raster.timing.overlap = FrameOverlap::kYes;
  const StageSchedule schedule = make_schedule(c.context, c.raster);
  const std::uint64_t tokens = c.context.tokens();
  if (c.raster.look_ahead == 0 || tokens == 1) {
    RC_ASSERT(schedule.writing.empty());
    return;
  }
  const std::uint64_t ahead = std::min(c.raster.look_ahead, tokens - 1);
  RC_ASSERT(schedule.kept == ahead);
  constexpr unsigned kHanded = 1u << StageSchedule::kHandedPort;
  constexpr unsigned kKept = 1u << StageSchedule::kKeptPort;
  std::vector<Fired> reading;
  std::vector<Fired> writing;
  for (std::uint64_t i = 0; i < tokens; ++i) {
    const std::size_t first = reading.size();
    add_token(reading, c.raster, i, 1, i < ahead ? 0 : kHanded);
    if (i < ahead) reading[first].writes = kKept;
    if ((i + 1) % c.context.row_tokens() == 0 && c.raster.timing.row_overhead > 0)
      reading.push_back({0, 0, c.raster.timing.row_overhead});
    const std::size_t out = writing.size();
    const bool held_back = i >= tokens - ahead;
    add_token(writing, c.raster, i, kKept, 1);
    if (!held_back) {  // the reading side sets the pace
      for (std::size_t f = out; f < writing.size(); ++f) {
        writing[f].reads = kHanded;
        writing[f].cycles = c.raster.timing.interval;
      }
    }
  }
  if (c.raster.timing.frame_overhead > 0) reading.push_back({0, 0, c.raster.timing.frame_overhead});
  RC_ASSERT(firings(schedule.reading) == reading);
  RC_ASSERT(firings(schedule.writing) == writing);
}

TEST(RasterSchedule, AStageThatWritesOncePerTokenMeetsOncePerToken) {
  RasterSchedule raster;  // as the consistency check: groups in, a disparity with the last one
  raster.groups = 2;
  raster.reads = {0b01, 0, 0b10};
  raster.writes.last = 0b1;
  raster.look_ahead = 1;
  raster.timing.overlap = FrameOverlap::kYes;
  StageContext three = nowhere();
  three.width = 3;
  three.height = 1;
  const StageSchedule schedule = make_schedule(three, raster);
  const auto handed = 1u << StageSchedule::kHandedPort;
  const auto kept = 1u << StageSchedule::kKeptPort;
  EXPECT_EQ(
      firings(schedule.reading),
      (std::vector<Fired>{
          {0b01, kept, 1}, {0b11, 0, 1}, {0b01, 0, 1}, {0b11, handed, 1}, {0b01, 0, 1}, {0b11, handed, 1}}));
  EXPECT_EQ(firings(schedule.writing), (std::vector<Fired>{{handed, 1, 1}, {handed, 1, 1}, {kept, 1, 1}}));
}

TEST(RasterSchedule, WhatNeedsAStoreDoesNotOverlap) {
  RasterSchedule raster;
  raster.reads.first = 0b1;
  raster.writes.every = 0b1;
  raster.look_ahead = 3;
  raster.timing.overlap = FrameOverlap::kYes;
  const StageContext& context = nowhere();
  EXPECT_FALSE(make_schedule(context, raster).writing.empty());
  RasterSchedule rows = raster;
  rows.first_pass.writes.last = 0b10;
  EXPECT_TRUE(make_schedule(context, rows).writing.empty());
  RasterSchedule second = raster;
  second.second_pass.reads.first = 0b10;
  EXPECT_TRUE(make_schedule(context, second).writing.empty());
  RasterSchedule frame = raster;
  frame.writes_early.last = 0b10;
  EXPECT_TRUE(make_schedule(context, frame).writing.empty());
}

TEST(RasterSchedule, OverlapIsThePipelinesUnlessTheStageSaysIt) {
  RasterSchedule raster;
  raster.reads.first = raster.writes.every = 0b1;
  raster.look_ahead = 1;
  for (const bool pipeline : {false, true}) {
    StageContext context = nowhere();
    context.overlap_frames = pipeline;
    const auto two_sides = [&](FrameOverlap overlap) {
      raster.timing.overlap = overlap;
      return !make_schedule(context, raster).writing.empty();
    };
    EXPECT_EQ(two_sides(FrameOverlap::kAsPipeline), pipeline);
    EXPECT_TRUE(two_sides(FrameOverlap::kYes));
    EXPECT_FALSE(two_sides(FrameOverlap::kNo));
  }
}

TEST(LookAhead, IsInWholeTokensAndAtMostTheFrame) {
  StageContext context = nowhere();
  context.width = 16;
  context.height = 8;
  EXPECT_EQ(look_ahead_tokens(context, 2, 3), 2u * 16 + 3);
  context.pixels_per_token = 4;
  EXPECT_EQ(look_ahead_tokens(context, 2, 3), 2u * 4 + 1);
  EXPECT_EQ(look_ahead_tokens(context, 2, 5), 2u * 4 + 2);
  EXPECT_EQ(look_ahead_tokens(context, 9, 0), 32u);
}

// A stage of latency 1 that looks two tokens ahead in frames of five, between a source and a sink.
class Window final : public Stage {
 public:
  StreamIn<std::uint8_t> in{"in"};
  StreamOut<std::uint8_t> out{"out"};

  Window(const sc_core::sc_module_name& name, const ClockDomain& clock, Dataflow& dataflow)
      : Stage(name, clock, dataflow, 1) {
    RasterSchedule raster;
    raster.reads.every = raster.writes.every = 0b1;
    raster.look_ahead = 2;
    raster.timing.overlap = FrameOverlap::kYes;
    set_schedule(make_schedule({clock, dataflow, 5, 1}, raster));
  }
};

// Cycles in which the stage reads and writes, "1 2 3 | 4 5": where the source and the sink wait so long
// before each token.
std::string dates(const std::vector<std::uint32_t>& before_write,
                  const std::vector<std::uint32_t>& before_read) {
  return in_child([&] {
    const ClockDomain clock("clock", Hertz(100'000'000));
    Dataflow dataflow("window_dataflow");
    const GraphNode from = source(before_write);
    const GraphNode to = sink(before_read);
    GraphThread<std::uint8_t> source("source", clock, from);
    Window window("window", clock, dataflow);
    GraphThread<std::uint8_t> sink("sink", clock, to);
    FifoConfig fifo;
    fifo.depth = 16;
    Stream<std::uint8_t> first("first", dataflow, clock, clock, fifo);
    fifo.depth = 2;
    Stream<std::uint8_t> second("second", dataflow, clock, clock, fifo);
    (*source.out)(first);
    window.in(first);
    window.out(second);
    (*sink.in)(second);
    EdgeDates in;
    EdgeDates out;
    DateLog read(in);
    DateLog written(out);
    first.add_listener(read);
    second.add_listener(written);
    sc_core::sc_start();
    std::string text;
    for (const std::int64_t date : in.read) text += std::to_string(date) + " ";
    text += "|";
    for (const std::int64_t date : out.written) text += " " + std::to_string(date);
    return text;
  });
}

TEST(OverlappingFrames, FollowOneAnotherWithoutAGap) {
  // Token 0 goes out when token 2 is in, a cycle later; the second frame comes in as the first one drains.
  EXPECT_EQ(dates(no_stalls(10), no_stalls(10)), "1 2 3 4 5 6 7 8 9 10 | 4 5 6 7 8 9 10 11 12 13");
}

TEST(OverlappingFrames, AFrameDrainsThoughNoneComesAfterIt) {
  EXPECT_EQ(dates({0, 0, 0, 0, 0, 14, 0, 0, 0, 0}, no_stalls(10)),
            "1 2 3 4 5 20 21 22 23 24 | 4 5 6 7 8 23 24 25 26 27");
}

TEST(OverlappingFrames, TheNextFrameTakesThePlacesThatThisOneLeaves) {
  // The sink comes in cycle 30: tokens 0 and 1 are in the FIFO by then, token 2 is in the register. Its slot
  // is free in cycle 31; then token 3 fires, whose place the next frame's first token takes in that cycle.
  const std::string text = dates(no_stalls(10), {30, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_EQ(text.substr(0, text.find(" |")), "1 2 3 4 5 31 32 33 34 35");
}

}  // namespace raster_schedule_test
}  // namespace parallax::test
