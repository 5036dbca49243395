// SPDX-License-Identifier: Apache-2.0
// Who waits for whom when a graph is stuck.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>

#include "tests/timing/model_simulation.hpp"

namespace parallax::test {
namespace {

GraphNode end(GraphNode::Kind kind, std::size_t tokens) {
  GraphNode node;
  node.kind = kind;
  node.stalls.assign(tokens, 0);
  return node;
}

// A fork whose branches meet again: a window of 10 tokens on one, a FIFO on the other.
//   0 source -> 1 fork -> 2 window -> 3 join -> 4 sink
//                      \------------/
Graph fork_and_join(std::uint32_t shortcut_depth) {
  Graph graph;
  GraphNode fork;
  fork.parts = {{20, {{1, 1, 1, 1}}}};
  GraphNode window;
  window.parts = {{10, {{1, 1, 1, 0}}}, {10, {{1, 1, 1, 1}}}, {10, {{1, 1, 0, 1}}}};
  GraphNode join;
  join.parts = {{20, {{1, 1, 0b11, 1}}}};
  graph.nodes = {end(GraphNode::Kind::kSource, 20), fork, window, join, end(GraphNode::Kind::kSink, 20)};
  graph.edges = {
      {0, 0, 1, 0, 2}, {1, 0, 2, 0, 2}, {1, 0, 3, 1, shortcut_depth}, {2, 0, 3, 0, 2}, {3, 0, 4, 0, 2}};
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

TEST(Deadlock, NoneWhenTheShortcutIsDeepEnough) {
  ModelSimulation model(fork_and_join(12), ~0ull);
  const auto dates = model.run();
  EXPECT_EQ(dates[4].read.size(), 20u);
  EXPECT_TRUE(model.dataflow().deadlock().empty());
}

TEST(Deadlock, ASourceThatEndsIsNone) {
  Graph graph = fork_and_join(12);
  graph.nodes[0] = end(GraphNode::Kind::kSource, 15);
  ModelSimulation model(graph, ~0ull);
  EXPECT_EQ(model.run()[4].read.size(), 5u);
  EXPECT_TRUE(model.dataflow().deadlock().empty());
  EXPECT_FALSE(model.dataflow().waits().empty());  // but somebody waits
}

TEST(Deadlock, ASinkThatEndsIsNone) {
  Graph graph = fork_and_join(12);
  graph.nodes[4] = end(GraphNode::Kind::kSink, 5);
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
  const std::string command = std::string(PARALLAX_PROGRAM) + " run " + options + " 2>&1";
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
  EXPECT_NE(
      ended.text.find(
          "machine.pipeline.rectification waits on stream machine.pipeline.left_texture (full, depth 64) "
          "for machine.pipeline.texture\n"),
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

}  // namespace
}  // namespace parallax::test
