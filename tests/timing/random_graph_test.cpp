// SPDX-License-Identifier: Apache-2.0
// Every date of the model equals the reference's, cycle for cycle, on random graphs.
// PARALLAX_GRAPHS sets how many (default 1000; a full run takes 10000).
#include "tests/timing/random_graph.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>

#include "tests/timing/model_simulation.hpp"
#include "tests/timing/reference_simulation.hpp"

namespace parallax::test {
namespace {

std::string differences(const Graph& graph, std::uint64_t threads) {
  const std::vector<EdgeDates> expected = ReferenceSimulation(graph).run();
  const std::vector<EdgeDates> actual = ModelSimulation(graph, threads).run();
  std::ostringstream out;
  const auto compare = [&](std::size_t e, const char* side, const auto& want, const auto& have) {
    if (want == have) return;
    const std::size_t shared = std::min(want.size(), have.size());
    std::size_t i = 0;
    while (i < shared && want[i] == have[i]) ++i;
    out << "edge " << e << " " << side << " token " << i << ": expected ";
    i < want.size() ? out << want[i] : out << "nothing";
    out << ", have ";
    i < have.size() ? out << have[i] : out << "nothing";
    out << "\n";
  };
  for (std::size_t e = 0; e < expected.size(); ++e) {
    compare(e, "written", expected[e].written, actual[e].written);
    compare(e, "read", expected[e].read, actual[e].read);
    // Tokens that nobody came for are not settled; where all were read the high-water mark is final.
    if (expected[e].written.size() == expected[e].read.size() &&
        expected[e].high_water != actual[e].high_water) {
      out << "edge " << e << " high water: expected " << expected[e].high_water << ", have "
          << actual[e].high_water << "\n";
    }
  }
  return out.str();
}

// A process holds one simulation, so each graph gets its own.
std::string differences_in_child(const Graph& graph, std::uint64_t threads) {
  int channel[2];
  if (pipe(channel) != 0) return "no pipe";
  const pid_t child = fork();
  if (child == 0) {
    close(channel[0]);
    std::string text;
    try {
      text = differences(graph, threads);
    } catch (const std::exception& e) {
      text = e.what();
    }
    const ssize_t sent = write(channel[1], text.data(), text.size());
    _exit(sent == static_cast<ssize_t>(text.size()) ? 0 : 1);
  }
  close(channel[1]);
  std::string text;
  char buffer[4096];
  for (ssize_t n; (n = read(channel[0], buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(n));
  close(channel[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) text += "the simulation ended abnormally\n";
  return text;
}

TEST(RandomGraph, EveryDateEqualsTheReference) {
  const char* asked = std::getenv("PARALLAX_GRAPHS");
  const int graphs = asked != nullptr ? std::atoi(asked) : 1000;
  rc::detail::TestParams params = rc::detail::configuration().testParams;
  params.maxSuccess = graphs;
  params.maxSize = 100;
  const auto result = rc::detail::checkTestable(
      [] {
        const Graph graph = RandomGraph::make();
        const auto threads = *rc::gen::arbitrary<std::uint64_t>();
        const std::string text = differences_in_child(graph, threads);
        if (!text.empty())
          RC_FAIL(text + "threads " + std::to_string(threads) + [&] {
            std::ostringstream s;
            s << graph;
            return s.str();
          }());
      },
      rc::detail::TestMetadata{}, params);
  std::ostringstream report;
  rc::detail::printResultMessage(result, report);
  std::cout << report.str() << std::endl;
  EXPECT_TRUE(result.template is<rc::detail::SuccessResult>()) << report.str();
}

}  // namespace
}  // namespace parallax::test
