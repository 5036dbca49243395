// SPDX-License-Identifier: Apache-2.0
// What a stage declares and when it then fires, by dates worked out by hand.
#include "tlm/stage.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <sstream>
#include <stdexcept>

#include "tests/timing/firing_log.hpp"
#include "tests/timing/in_child.hpp"
#include "tests/timing/model_simulation.hpp"
#include "tests/timing/statistics_text.hpp"

namespace parallax::test {
namespace stage_test {

using Dates = std::vector<std::int64_t>;
constexpr std::uint64_t kThreads = ~0ull;

// source 0 -> stage 1 -> sink 2; edge 0 into the stage, edge 1 out of it.
Graph chain(const std::vector<std::uint32_t>& in, const GraphNode& middle,
            const std::vector<std::uint32_t>& out, std::uint32_t out_depth = 16) {
  Graph graph;
  graph.nodes = {source(in), middle, sink(out)};
  graph.edges = {link(0, 1).deep(16), link(1, 2).deep(out_depth)};
  return graph;
}

TEST(Stage, CombinationalReadsAndWritesInOneCycle) {
  ModelSimulation model(chain(no_stalls(4), copying(0, 4), no_stalls(4)), kThreads);
  const auto dates = model.run();
  EXPECT_EQ(dates[0].read, Dates({1, 2, 3, 4}));
  EXPECT_EQ(dates[1].written, Dates({1, 2, 3, 4}));
}

TEST(Stage, CombinationalCountsWhatAFullFifoCosts) {
  // The FIFO of one token is free again in cycle 11, and every second cycle from there.
  ModelSimulation model(chain(no_stalls(4), copying(0, 4), {10, 0, 0, 0}, 1), kThreads);
  EXPECT_EQ(model.run()[1].written, Dates({1, 11, 13, 15}));
  EXPECT_EQ(model.stream(1).statistics().blocked_on_full.count(), 9 + 1 + 1);
  EXPECT_EQ(model.stage(1).statistics().blocked.count(), 9 + 1 + 1);
}

TEST(Stage, FiresOnceAnInterval) {
  ModelSimulation model(chain(no_stalls(4), copying(0, 4, 3), no_stalls(4)), kThreads);
  EXPECT_EQ(model.run()[1].written, Dates({1, 4, 7, 10}));
}

TEST(Stage, AWaitForInputDoesNotShortenTheInterval) {
  // Tokens are readable in 1, 2 and 10: the third firing is late, the fourth three cycles after it.
  ModelSimulation model(chain({0, 0, 7, 0}, copying(0, 4, 3), no_stalls(4)), kThreads);
  EXPECT_EQ(model.run()[0].read, Dates({1, 4, 10, 13}));
}

TEST(Stage, WritesLatencyCyclesAfterReading) {
  ModelSimulation model(chain(no_stalls(3), copying(5, 3), no_stalls(3)), kThreads);
  const auto dates = model.run();
  EXPECT_EQ(dates[0].read, Dates({1, 2, 3}));
  EXPECT_EQ(dates[1].written, Dates({6, 7, 8}));
  EXPECT_EQ(dates[1].read, Dates({7, 8, 9}));
}

TEST(Stage, ThePipelineHoldsLatencyFiringsUnderBackPressure) {
  // The sink comes in cycle 20. Firing 0 is in the FIFO, firings 1 to 3 in the three registers; firing 4
  // enters when firing 1 leaves, one cycle after the read.
  ModelSimulation model(chain(no_stalls(6), copying(3, 6), {20, 0, 0, 0, 0, 0}, 1), kThreads);
  const auto dates = model.run();
  EXPECT_EQ(dates[0].read, Dates({1, 2, 3, 4, 21, 23}));
  EXPECT_EQ(dates[1].written, Dates({4, 21, 23, 25, 27, 29}));
  EXPECT_EQ(dates[1].read, Dates({20, 22, 24, 26, 28, 30}));
}

TEST(Stage, CombinationalHoldsNothingUnderBackPressure) {
  ModelSimulation model(chain(no_stalls(3), copying(0, 3), {20, 0, 0}, 1), kThreads);
  EXPECT_EQ(model.run()[0].read, Dates({1, 21, 23}));
}

TEST(Stage, LookAheadReadsBeforeItWritesAndFlushesAfterwards) {
  // Two pixels ahead, five in all.
  const GraphNode window = stage(1)
                               .times(2, {fires().reads(1)})
                               .times(3, {fires().reads(1).writes(1)})
                               .times(2, {fires().writes(1)});
  ModelSimulation model(chain(no_stalls(5), window, no_stalls(5)), kThreads);
  const auto dates = model.run();
  EXPECT_EQ(dates[0].read, Dates({1, 2, 3, 4, 5}));
  EXPECT_EQ(dates[1].written, Dates({4, 5, 6, 7, 8}));
}

TEST(Stage, FramesFollowWithoutAGap) {
  const GraphNode window = stage(1)
                               .times(1, {fires().reads(1)})
                               .times(1, {fires().reads(1).writes(1)})
                               .times(1, {fires().writes(1)});
  ModelSimulation model(chain(no_stalls(4), window, no_stalls(4)), kThreads);
  const auto dates = model.run();
  EXPECT_EQ(dates[0].read, Dates({1, 2, 4, 5}));
  EXPECT_EQ(dates[1].written, Dates({3, 4, 6, 7}));
  const KeptRecords<FrameDates>& frames = model.stage(1).frames();
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].first_firing.count(), 1);
  EXPECT_EQ(frames[0].last_firing.count(), 3);
  EXPECT_EQ(frames[0].first_write.count(), 3);
  EXPECT_EQ(frames[0].last_write.count(), 4);
  EXPECT_EQ(frames[1].first_firing.count(), 4);
  EXPECT_EQ(frames[1].last_write.count(), 7);
}

TEST(Stage, OverheadsKeepItBusyAfterRowsAndFrames) {
  // Rows of two pixels, 5 idle cycles after each, 100 after the frame of two rows.
  const GraphNode rows = stage(0).times(2, {fires(2).reads(1).writes(1), idles(5)}).times(1, {idles(100)});
  ModelSimulation model(chain(no_stalls(6), rows, no_stalls(6)), kThreads);
  EXPECT_EQ(model.run()[0].read, Dates({1, 2, 8, 9, 115, 116}));
  EXPECT_EQ(model.stage(1).statistics().blanking.count(), 5 * 3 + 100);
}

TEST(Stage, AForkWritesBothOrNeither) {
  Graph graph;
  graph.nodes = {source(no_stalls(4)), copying(0, 4), sink(no_stalls(4)), sink({10, 0, 0, 0})};
  graph.edges = {link(0, 1).deep(16), link(1, 2).deep(16), link(1, 3).deep(2)};
  ModelSimulation model(graph, kThreads);
  const auto dates = model.run();
  EXPECT_EQ(dates[1].written, Dates({1, 2, 11, 12}));  // the slow branch holds two
  EXPECT_EQ(dates[2].written, dates[1].written);
  EXPECT_EQ(model.stream(1).statistics().blocked_on_full.count(), 0);
  EXPECT_EQ(model.stage(1).statistics().blocked.count(), 11 - 3);
}

// Firings that only write are gone through in one go where they write one stream, and one by one where they
// write two: with a second one that never holds anything back, all is the same.
RC_GTEST_PROP(StageWriters, InOneGoAsOneByOne, ()) {
  const auto number = [](std::uint32_t from, std::uint32_t to) {
    return *rc::gen::inRange<std::uint32_t>(from, to + 1);
  };
  const std::uint32_t frames = number(1, 6);
  const std::uint32_t first = number(0, 1);  // whether the firing that reads writes, too
  const std::uint32_t words = number(1, 12);
  const std::uint32_t others = number(0, 3);
  const GraphNode burst = stage(0)
                              .times(1, {fires().reads(1).writes(first).every(number(1, 3)),
                                         fires(words).writes(1).every(number(1, 3))})
                              .times(others, {idles(2), fires(2).writes(1)});
  std::vector<std::uint32_t> in, out;
  for (std::uint32_t i = 0; i < frames; ++i) in.push_back(number(0, 9));
  for (std::uint32_t i = 0; i < frames * (first + words + 2 * others); ++i) {
    out.push_back(number(0, 3) == 0 ? number(0, 30) : number(0, 2));
  }
  Graph one = chain(in, burst, out, number(1, 8));
  Graph two = one;
  two.nodes.push_back(sink(no_stalls(out.size())));
  two.edges.push_back(link(1, 3).deep(1024));
  const auto run = [](const Graph& graph) {
    return in_child([&graph] {
      ModelSimulation model(graph, kThreads, 0);
      const std::vector<EdgeDates> dates = model.run();
      std::ostringstream text;
      for (const std::int64_t date : dates[1].written) text << date << " ";
      return text.str() + statistics_text(model.stage(1)) + statistics_text(model.stream(1));
    });
  };
  RC_ASSERT(run(one) == run(two));
}

TEST(Stage, TwoOutputsOfDifferentRates) {
  // Port 0 in each of three beats, port 1 in the last one; the input in the first one.
  Graph graph;
  graph.nodes = {source(no_stalls(2)),
                 stage(2).times(2, {fires().reads(1).writes(1), fires().writes(1), fires().writes(3)}),
                 sink(no_stalls(6)), sink(no_stalls(2))};
  graph.edges = {link(0, 1).deep(4), link(1, 2).deep(4), link(1, 3).out_of(1).deep(4)};
  ModelSimulation model(graph, kThreads);
  const auto dates = model.run();
  EXPECT_EQ(dates[0].read, Dates({1, 4}));
  EXPECT_EQ(dates[1].written, Dates({3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(dates[2].written, Dates({5, 8}));
}

TEST(Stage, AJoinWaitsForTheLaterInput) {
  Graph graph;
  graph.nodes = {source(no_stalls(2)), source({6, 0}), stage(0).times(2, {fires().reads(3).writes(1)}),
                 sink(no_stalls(2))};
  graph.edges = {link(0, 2).deep(4), link(1, 2).into(1).deep(4), link(2, 3).deep(4)};
  ModelSimulation model(graph, kThreads);
  const auto dates = model.run();
  EXPECT_EQ(dates[0].read, Dates({7, 8}));
  EXPECT_EQ(dates[1].read, Dates({7, 8}));
  // The delay is the later input's alone.
  EXPECT_EQ(model.stream(0).statistics().starved_on_empty.count(), 0);
  EXPECT_EQ(model.stream(1).statistics().starved_on_empty.count(), 7);
}

TEST(Stage, AFrameLimitEndsASource) {
  Graph graph;
  graph.nodes = {source({2, 3, 0}), sink(no_stalls(3))};
  graph.edges = {link(0, 1).deep(4)};
  ModelSimulation model(graph, 0);  // source and sink as stages, of one frame each
  EXPECT_EQ(model.run()[0].written, Dates({2, 6, 7}));
  EXPECT_EQ(model.stage(0).frames().size(), 1u);
}

TEST(Stage, ItsTimeIsAccountedFor) {
  // Readable in 1..4; the sink frees the only slot in 10, 12, ...
  ModelSimulation model(chain(no_stalls(4), copying(0, 4, 2), {10, 0, 0, 0}, 1), kThreads);
  const auto dates = model.run();
  EXPECT_EQ(dates[0].read, Dates({1, 11, 13, 15}));
  const StageStatistics& s = model.stage(1).statistics();
  EXPECT_EQ(s.firings, 4u);
  EXPECT_EQ(s.starved.count(), 1);  // from 0 to 1
  EXPECT_EQ(s.blocked.count(), 11 - 3);
  EXPECT_EQ(s.busy.count(), 4 * 2);
  EXPECT_EQ(s.blanking.count(), 0);
  // Every cycle up to the end of the last firing is one of these.
  EXPECT_EQ((s.starved + s.blocked + s.busy + s.blanking).count(), 15 + 2);
}

TEST(Stage, WaitsForASynchroniserAreTheirOwn) {
  // Written in 0 and 4, readable two synchroniser stages after the next edge, in 3 and 7; ready in 0 and 5.
  Graph in = chain({0, 3}, copying(0, 2, 2), no_stalls(2));
  in.edges[0].of_kind(FifoKind::kAsynchronous);
  ModelSimulation model(in, kThreads);
  EXPECT_EQ(model.run()[0].read, Dates({3, 7}));
  const StageStatistics& s = model.stage(1).statistics();
  EXPECT_EQ(s.starved.count(), 3);       // it was not written yet when the stage was ready
  EXPECT_EQ(s.synchroniser.count(), 2);  // it was
  EXPECT_EQ(s.total().count(), 3 + 2 + 2 + 2);
}

TEST(Stage, WaitsForAFifoThatIsNotReadyAreNone) {
  Graph out = chain(no_stalls(8), copying(0, 8), no_stalls(8), 4);
  out.edges[1].of_kind(FifoKind::kAsynchronous).ready_after(4);
  ModelSimulation model(out, kThreads);
  EXPECT_EQ(model.run()[1].written, Dates({4, 5, 6, 7, 10, 11, 12, 13}));
  const StageStatistics& s = model.stage(1).statistics();
  EXPECT_EQ(s.synchroniser.count(), 2);
  EXPECT_EQ(s.blocked.count(), 3);
}

TEST(Stage, WaitsForASlotBehindASynchroniserAreToo) {
  // Written in 1, 2, 3, 4, read in 4, 5, ..., so there is room in 7; the stage would have written in 5.
  Graph out = chain(no_stalls(8), copying(0, 8), no_stalls(8), 4);
  out.edges[1].of_kind(FifoKind::kAsynchronous);
  ModelSimulation model(out, kThreads);
  EXPECT_EQ(model.run()[1].written, Dates({1, 2, 3, 4, 7, 8, 9, 10}));
  const StageStatistics& s = model.stage(1).statistics();
  EXPECT_EQ(s.synchroniser.count(), 2);
  EXPECT_EQ(s.blocked.count(), 0);
}

TEST(Stage, ItsFiringsAreTold) {
  // As above: ready in 0, 3, 13, 15; a token in 1, 2, 3, 4; room in 0, 11, 13, 15.
  ModelSimulation model(chain(no_stalls(4), copying(0, 4, 2), {10, 0, 0, 0}, 1), kThreads);
  FiringLog log(*model.dataflow().stages()[0]);
  model.run();
  EXPECT_EQ(text_of(log.sums), text_of(model.stage(1).statistics()));
  EXPECT_NE(log.text().find(": 0 1 1 +2 busy starved s0; 3 3 11 +2 busy blocked s1; 13 13 13 +2 busy; "
                            "15 15 15 +2 busy; \n"),
            std::string::npos)
      << log.text();
}

TEST(Stage, ItsPortsCanBeLookedUp) {
  Graph graph;
  graph.nodes = {source(no_stalls(1)), copying(0, 1), sink(no_stalls(1)), sink(no_stalls(1))};
  graph.edges = {link(0, 1).deep(16), link(1, 2).deep(16), link(1, 3).deep(2)};
  ModelSimulation model(graph, kThreads);
  model.run();
  using Streams = std::vector<const StreamBase*>;
  EXPECT_EQ(model.stage(1).input_streams(0), Streams({&model.stream(0)}));
  EXPECT_EQ(model.stage(1).output_streams(0), Streams({&model.stream(1), &model.stream(2)}));
  EXPECT_EQ(model.stage(1).input_streams(1), Streams());
}

TEST(Stage, AScheduleOfPortsThatDoNotExistIsRefused) {
  ModelSimulation model(chain(no_stalls(1), stage(0).times(1, {fires().reads(0b10).writes(1)}), no_stalls(1)),
                        kThreads);
  EXPECT_THROW(model.run(), std::logic_error);
}

}  // namespace stage_test
}  // namespace parallax::test
