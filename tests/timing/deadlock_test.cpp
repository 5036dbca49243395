// SPDX-License-Identifier: Apache-2.0
// Who waits for whom when a graph is stuck.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>

#include "tests/paths.hpp"
#include "tests/timing/model_simulation.hpp"
#include "tlm/deadlock.hpp"

namespace parallax::test {
namespace deadlock_test {

// A fork whose branches meet again: a window of 10 tokens on one, a FIFO on the other.
//   0 source -> 1 fork -> 2 window -> 3 join -> 4 sink
//                      \------------/
Graph fork_and_join(std::uint32_t shortcut_depth) {
  Graph graph;
  graph.nodes = {source(no_stalls(20)), copying(1, 20),
                 stage(1)
                     .times(10, {fires().reads(1)})
                     .times(10, {fires().reads(1).writes(1)})
                     .times(10, {fires().writes(1)}),
                 stage(1).times(20, {fires().reads(0b11).writes(1)}), sink(no_stalls(20))};
  graph.edges = {link(0, 1).deep(2), link(1, 2).deep(2), link(1, 3).into(1).deep(shortcut_depth),
                 link(2, 3).deep(2), link(3, 4).deep(2)};
  return graph;
}

TEST(Deadlock, NamesTheCircleOfWaits) {
  ModelSimulation model(fork_and_join(4), ~0ull);
  model.run();
  const std::vector<Wait> circle = model.dataflow().deadlock();
  ASSERT_EQ(circle.size(), 3u);
  for (std::size_t i = 0; i < circle.size(); ++i) {
    EXPECT_EQ(circle[i].other, circle[(i + 1) % circle.size()].waiter);
    const Wait& wait = circle[i];
    if (wait.waiter == "n1") {
      EXPECT_EQ(wait.stream, &model.stream(2));
      EXPECT_TRUE(wait.on_full);
      EXPECT_EQ(wait.stream->depth(), 4u);
      EXPECT_EQ(wait.other, "n3");
    } else if (wait.waiter == "n2") {
      EXPECT_EQ(wait.stream, &model.stream(1));
      EXPECT_FALSE(wait.on_full);
    } else {
      EXPECT_EQ(wait.waiter, "n3");
      EXPECT_EQ(wait.stream, &model.stream(3));
      EXPECT_FALSE(wait.on_full);
      EXPECT_EQ(wait.other, "n2");
    }
  }
  const std::string text = describe(circle);
  EXPECT_NE(text.find("n1 waits on stream s2 (full, depth 4) for n3\n"), std::string::npos) << text;
  EXPECT_NE(text.find("n2 waits on stream s1 (empty, depth 2) for n1\n"), std::string::npos) << text;
  EXPECT_NE(text.find("n3 waits on stream s3 (empty, depth 2) for n2\n"), std::string::npos) << text;
}

// Node 1 forks to the join 3 and to 4, and has in its pipeline the token that the join waits for, since 4
// waits for the join before it reads. That node 1's next firing waits for the source, which waits for 2,
// which waits for the join, closes a circle too, but holds nothing up.
TEST(Deadlock, NamesNoWaitOfAStageThatNoneWaitsFor) {
  Graph graph;
  graph.nodes = {source(no_stalls(10)),
                 copying(1, 10),
                 copying(0, 10),
                 stage(0)
                     .times(3, {fires().reads(0b01)})
                     .times(7, {fires().reads(0b10).writes(1), fires().reads(0b01)})
                     .times(3, {fires().reads(0b10).writes(1)}),
                 stage(0).times(10, {fires().reads(0b11).writes(1)}),
                 sink(no_stalls(10))};
  graph.edges = {link(0, 1).deep(9), link(0, 2).deep(2), link(2, 3).into(1).deep(1),
                 link(1, 3).deep(9), link(3, 4).deep(9), link(1, 4).into(1).deep(2),
                 link(4, 5).deep(9)};
  ModelSimulation model(graph, ~0ull);
  model.run();
  const std::string text = describe(model.dataflow().waits());
  ASSERT_NE(text.find("n1 waits on stream s0 (empty, depth 9) for n0\n"), std::string::npos) << text;
  ASSERT_NE(text.find("n0 (in kernel time) waits on stream s1 (full, depth 2) for n2\n"), std::string::npos)
      << text;
  ASSERT_NE(text.find("n2 waits on stream s2 (full, depth 1) for n3\n"), std::string::npos) << text;
  const std::vector<Wait> circle = model.dataflow().deadlock();
  EXPECT_EQ(circle.size(), 3u);
  for (const Wait& wait : circle) EXPECT_NE(wait.other, "n0") << describe(circle);
  const Remedy remedy = smallest_remedy(model.dataflow(), 1);
  ASSERT_EQ(remedy.depths.size(), 1u) << remedy.obstacle;
  EXPECT_EQ(remedy.depths[0].stream, &model.stream(5));
  EXPECT_EQ(remedy.depths[0].tokens, 3u);
}

// A block in kernel time between two stages: when it reads and writes is not known.
class Unknown final : public sc_core::sc_module {
 public:
  StreamIn<int> in{"in"};
  StreamOut<int> out{"out"};
  explicit Unknown(const sc_core::sc_module_name& name) : sc_module(name) {
    SC_HAS_PROCESS(Unknown);
    SC_THREAD(run);
  }

 private:
  void run() {
    for (int i = 0;; ++i) {
      in->wait_readable();
      in->release();
      if (i < 8) continue;
      out[0]->wait_writable();
      out[0]->commit();
    }
  }
};

class Copy final : public Stage {
 public:
  StreamIn<int> in_a{"in_a"};
  StreamIn<int> in_b{"in_b"};
  StreamOut<int> out{"out"};
  Copy(const sc_core::sc_module_name& name, const ClockDomain& clock, Dataflow& dataflow)
      : Stage(name, clock, dataflow, 1) {
    set_schedule(Schedule().run(fires().reads(0b11).writes(0b1)));
  }
};

TEST(Deadlock, SaysThatItKnowsNoDepthWhereABlockInKernelTimeTakesPart) {
  const GraphNode first = source(no_stalls(20));
  const ClockDomain clock("clock", Hertz(1000));
  Dataflow dataflow("dataflow");
  GraphThread<int> source("source", clock, first);
  Unknown unknown("unknown");
  Copy join("join", clock, dataflow);
  Stream<int> to_unknown("to_unknown", dataflow, clock, clock, {});
  Stream<int> to_join("to_join", dataflow, clock, clock, {});
  Stream<int> from_unknown("from_unknown", dataflow, clock, clock, {});
  Stream<int> result("result", dataflow, clock, clock, {});
  (*source.out)(to_unknown);
  (*source.out)(to_join);
  unknown.in(to_unknown);
  unknown.out(from_unknown);
  join.in_a(from_unknown);
  join.in_b(to_join);
  join.out(result);
  const GraphNode end = sink(no_stalls(20));
  GraphThread<int> last("last", clock, end);
  (*last.in)(result);
  sc_core::sc_start();
  EXPECT_EQ(dataflow.deadlock().size(), 3u);
  const Remedy remedy = smallest_remedy(dataflow, 1);
  EXPECT_TRUE(remedy.depths.empty());
  EXPECT_EQ(remedy.obstacle, "unknown takes part, and no schedule says what it reads and writes");
}

TEST(Deadlock, NoneWhenTheShortcutIsDeepEnough) {
  ModelSimulation model(fork_and_join(12), ~0ull);
  const auto dates = model.run();
  EXPECT_EQ(dates[4].read.size(), 20u);
  EXPECT_TRUE(model.dataflow().deadlock().empty());
}

TEST(Deadlock, ASourceThatEndsIsNone) {
  Graph graph = fork_and_join(12);
  graph.nodes[0] = source(no_stalls(15));
  ModelSimulation model(graph, ~0ull);
  EXPECT_EQ(model.run()[4].read.size(), 5u);
  EXPECT_TRUE(model.dataflow().deadlock().empty());
  EXPECT_FALSE(model.dataflow().waits().empty());  // but somebody waits
}

TEST(Deadlock, ASinkThatEndsIsNone) {
  Graph graph = fork_and_join(12);
  graph.nodes[4] = sink(no_stalls(5));
  ModelSimulation model(graph, ~0ull);
  model.run();
  EXPECT_TRUE(model.dataflow().deadlock().empty());
  EXPECT_FALSE(model.dataflow().waits().empty());
}

struct Ended {
  int status = -1;
  std::string text;
};

Ended run_program(const std::string& options) {
  Ended ended;
  const std::string command = program_path() + " run " + options + " 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 4096> buffer{};
  while (fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr) ended.text += buffer.data();
  const int status = pclose(pipe);
  ended.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return ended;
}

// The consistency check is 127 pixels behind, and the texture filter waits for it.
TEST(Deadlock, TheProgramNamesItAndFails) {
  const Ended ended = run_program("--size 160x48 --frames 1 --set streams.left_texture.depth=64");
  EXPECT_EQ(ended.status, 1);
  EXPECT_NE(ended.text.find("parallax: error: the machine is deadlocked"), std::string::npos) << ended.text;
  EXPECT_NE(ended.text.find("machine.core.pipeline.rectification waits on stream "
                            "machine.core.pipeline.left_texture (full, depth 64) "
                            "for machine.core.pipeline.texture\n"),
            std::string::npos)
      << ended.text;
  EXPECT_NE(ended.text.find("\n  streams.left_texture.depth = 128 would free it (now 64)\n"),
            std::string::npos)
      << ended.text;
  EXPECT_EQ(ended.text.find("frames/s"), std::string::npos) << "results of a run that failed";
}

TEST(Deadlock, TheProgramNamesSeveralDepths) {
  const Ended ended = run_program(
      "--size 160x48 --frames 1 --set streams.left_texture.depth=64 --set streams.left_output.depth=1");
  EXPECT_EQ(ended.status, 1);
  EXPECT_NE(
      ended.text.find("\n  streams.left_output.depth = 3175 (now 1) and streams.left_texture.depth = 128 "
                      "(now 64) would free it together, none of them alone\n"),
      std::string::npos)
      << ended.text;
}

TEST(Deadlock, TheProgramSucceedsWithAutomaticDepths) {
  const Ended ended = run_program("--size 96x48 --frames 1 --set matching.iterations=1");
  EXPECT_EQ(ended.status, 0) << ended.text;
}

// The texture filter looks two rows and more ahead on the image alone, further than the disparities are
// behind.
TEST(Deadlock, NoneWhereTheImageIsAheadOfTheDisparities) {
  const Ended ended = run_program(
      "--size 96x48 --frames 1 --set matching.iterations=1 --set census.window_height=1 --set "
      "texture.window=9");
  EXPECT_EQ(ended.status, 0) << ended.text;
}

}  // namespace deadlock_test
}  // namespace parallax::test
