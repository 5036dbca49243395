// SPDX-License-Identifier: Apache-2.0
// A tap's tokens: the values that were sent, with the dates of the reference.
#include "tlm/tap.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>
#include <sstream>

#include "tests/timing/in_child.hpp"
#include "tests/timing/model_simulation.hpp"
#include "tests/timing/random_graph.hpp"
#include "tests/timing/reference_simulation.hpp"
#include "tests/tlm/thread.hpp"

namespace parallax::test {
namespace tap_test {

int value_of(std::size_t edge, std::size_t index) {
  return static_cast<int>((edge * 7919 + index) * 2654435761U % 1000003U);
}

// How the values of one stream are told apart and handed over.
struct Handing {
  TapConfig tap;
  std::size_t tokens = 0;  // that have values
  std::uint32_t seed = 1;  // of the sizes in which they are sent

  // Values of tokens 0 to `number`.
  std::size_t values_until(std::size_t number) const {
    if (tap.values_per_piece == 0) return number * tap.values_per_token;
    const std::size_t tokens_per_piece =
        (tap.values_per_piece + tap.values_per_token - 1) / tap.values_per_token;
    return number / tokens_per_piece * tap.values_per_piece +
           number % tokens_per_piece * tap.values_per_token;
  }
};

// Sends the values of an edge: all at once in pieces, or bit by bit in the course of the simulation.
class Sender final : public sc_core::sc_module {
 public:
  Sender(const sc_core::sc_module_name& name, Stream<int>& stream, std::size_t edge, const Handing& handing)
      : sc_module(name), stream_(stream), random_(handing.seed) {
    const std::size_t values = handing.values_until(handing.tokens);
    for (std::size_t i = 0; i < values; ++i) values_.push_back(value_of(edge, i));
    SC_HAS_PROCESS(Sender);
    if (handing.tap.dates_wait) {
      SC_THREAD(send_late);
    }
    late_ = handing.tap.dates_wait;
  }

 private:
  void start_of_simulation() override {
    while (!late_ && at_ < values_.size()) send();
  }
  void send_late() {
    while (at_ < values_.size()) {
      sc_core::wait(sc_core::sc_time(static_cast<double>(random_() % 20), sc_core::SC_NS));
      send();
    }
  }
  void send() {
    const std::size_t size = std::min<std::size_t>(1 + random_() % 50, values_.size() - at_);
    stream_.send_row(values_.data() + at_, size);
    at_ += size;
  }

  Stream<int>& stream_;
  std::mt19937 random_;
  std::vector<int> values_;
  std::size_t at_ = 0;
  bool late_ = false;
};

// What a tap tells, as text; the same from the dates of the reference.
void note(std::ostream& out, std::uint64_t number, std::int64_t date, const int* values, std::size_t size) {
  out << number << "@" << date;
  for (std::size_t i = 0; i < size; ++i) out << " " << values[i];
  out << "\n";
}

std::string expected_tokens(std::size_t edge, const std::vector<std::int64_t>& dates,
                            const Handing& handing) {
  std::ostringstream out;
  for (std::size_t token = 0; token < dates.size(); ++token) {
    std::vector<int> values;
    const std::size_t end = token < handing.tokens ? handing.values_until(token + 1) : 0;
    for (std::size_t i = handing.values_until(token); i < end; ++i) values.push_back(value_of(edge, i));
    note(out, token, dates[token], values.data(), values.size());
  }
  return out.str();
}

class Taps {
 public:
  Taps(ModelSimulation& simulation, const std::vector<Handing>& handings) {
    const std::vector<StreamBase*>& streams = simulation.dataflow().streams();
    for (std::size_t e = 0; e < streams.size(); ++e) {
      auto& stream = dynamic_cast<Stream<int>&>(*streams[e]);
      std::ostringstream& text = texts_.emplace_back();
      taps_.emplace_back(stream, handings[e].tap, [&text](const TappedToken<int>& token) {
        note(text, token.number, token.date.count(), token.values, token.size);
      });
      senders_.emplace_back(fmt::format("sender_{}", e).c_str(), stream, e, handings[e]);
    }
  }
  std::string text(std::size_t edge) const { return texts_[edge].str(); }

 private:
  std::deque<std::ostringstream> texts_;
  std::deque<Tap<int>> taps_;
  std::deque<Sender> senders_;
};

// Where taps and reference differ.
std::string differences(const Graph& graph, std::uint64_t threads, std::uint64_t leap_interval,
                        const std::vector<Handing>& handings) {
  return in_child([&] {
    const std::vector<EdgeDates> dates = ReferenceSimulation(graph).run();
    ModelSimulation simulation(graph, threads, leap_interval);
    Taps taps(simulation, handings);
    simulation.run();
    std::string found;
    for (std::size_t e = 0; e < dates.size(); ++e) {
      const bool writes = handings[e].tap.side == TapConfig::Side::kWrites;
      const std::string expected = expected_tokens(e, writes ? dates[e].written : dates[e].read, handings[e]);
      if (taps.text(e) != expected) {
        found += fmt::format("edge {}:\n{}instead of\n{}\n", e, taps.text(e), expected);
      }
    }
    return found;
  });
}

Handing random_handing() {
  const auto number = [](std::size_t low, std::size_t high) { return *rc::gen::inRange(low, high + 1); };
  Handing handing;
  handing.tap.values_per_token = number(1, 4);
  if (number(0, 2) == 0) handing.tap.values_per_piece = number(1, 11);
  handing.tap.side = number(0, 1) == 0 ? TapConfig::Side::kWrites : TapConfig::Side::kReads;
  handing.tap.dates_wait = number(0, 3) == 0;
  handing.tokens = handing.tap.dates_wait || number(0, 1) == 0 ? 5000 : number(0, 300);
  handing.seed = static_cast<std::uint32_t>(number(1, 1000));
  return handing;
}

RC_GTEST_PROP(Tap, TellsValuesAndDatesOfRandomGraphs, ()) {
  const Graph graph = RandomGraph::make();
  std::vector<Handing> handings;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) handings.push_back(random_handing());
  const auto threads = *rc::gen::arbitrary<std::uint64_t>();
  const auto leap_interval = *rc::gen::element<std::uint64_t>(1, 10, 40);
  const std::string found = differences(graph, threads, leap_interval, handings);
  if (!found.empty()) {
    std::ostringstream description;
    description << found << "threads " << threads << " leap interval " << leap_interval << graph;
    RC_FAIL(description.str());
  }
}

TEST(Tap, TellsValuesAndDatesOfEveryKindOfFifo) {
  for (const FifoKind kind : {FifoKind::kRegistered, FifoKind::kFirstWordFallThrough, FifoKind::kBlockRam,
                              FifoKind::kAsynchronous}) {
    Graph graph;
    graph.nodes = {source({0, 0, 3, 0, 0, 0, 1, 0}), sink({5, 0, 0, 0, 0, 7, 0, 0})};
    graph.edges = {link(0, 1).deep(3).of_kind(kind)};
    Handing handing;
    handing.tap.values_per_token = 2;
    handing.tokens = 8;
    for (const TapConfig::Side side : {TapConfig::Side::kWrites, TapConfig::Side::kReads}) {
      handing.tap.side = side;
      EXPECT_EQ(differences(graph, 0, Dataflow::kLeapInterval, {handing}), "") << name_of(kind);
    }
  }
}

// A stream whose tokens are written in cycles 0, 1, 2, ...
struct Bench {
  ClockDomain clock{"clock", Hertz(1'000'000)};
  Dataflow dataflow{"dataflow"};
  Stream<int> stream{"stream", dataflow, clock, clock, FifoConfig{64}};
  std::string text;

  Tap<int> tap(const TapConfig& config) {
    return {stream, config, [this](const TappedToken<int>& token) {
              text += fmt::format("{}@{}", token.number, token.date.count());
              for (std::size_t i = 0; i < token.size; ++i) text += fmt::format(" {}", token.values[i]);
              text += ";";
            }};
  }
  void send(const std::vector<int>& values) { stream.send_row(values.data(), values.size()); }
  void dates(int number) {
    for (int i = 0; i < number; ++i) {
      stream.mark_written(Cycles(static_cast<std::int64_t>(stream.statistics().written)), Cycles(0));
    }
  }
};

TEST(Tap, CutsBeatsOfSeveralValues) {
  Bench bench;
  const Tap<int> tap = bench.tap({3});
  bench.send({1, 2, 3, 4});
  bench.send({5, 6});
  bench.dates(2);
  EXPECT_EQ(bench.text, "0@0 1 2 3;1@1 4 5 6;");
}

TEST(Tap, CutsBurstsOfWhichThePiecesLastIsShorter) {
  Bench bench;
  const Tap<int> tap = bench.tap({3, 5});
  bench.send({1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
  bench.dates(4);
  EXPECT_EQ(bench.text, "0@0 1 2 3;1@1 4 5;2@2 6 7 8;3@3 9 10;");
}

TEST(Tap, TellsDatesAloneWhereThereAreNoValues) {
  Bench bench;
  const Tap<int> tap = bench.tap({2});
  bench.send({1, 2});
  bench.dates(3);
  EXPECT_EQ(bench.text, "0@0 1 2;1@1;2@2;");
}

TEST(Tap, LetsDatesWaitForValuesWhenAsked) {
  Bench bench;
  TapConfig config;
  config.dates_wait = true;
  const Tap<int> tap = bench.tap(config);
  bench.dates(2);
  EXPECT_EQ(bench.text, "");
  bench.send({7, 8, 9});
  EXPECT_EQ(bench.text, "0@0 7;1@1 8;");
  bench.dates(2);
  bench.send({10});
  EXPECT_EQ(bench.text, "0@0 7;1@1 8;2@2 9;3@3 10;");
}

TEST(Tap, TellsNothingOnceItIsStopped) {
  Bench bench;
  Tap<int> stopped = bench.tap({});
  std::string other;
  const Tap<int> stays(bench.stream, {}, [&](const TappedToken<int>& token) {
    other += fmt::format("{}@{} {};", token.number, token.date.count(), *token.values);
  });
  bench.send({1, 2});
  bench.dates(1);
  stopped.stop();
  bench.dates(1);
  EXPECT_EQ(bench.text, "0@0 1;");
  EXPECT_EQ(other, "0@0 1;1@1 2;");
}

TEST(Tap, ReportsValuesThatAreCutOtherwise) {
  Bench bench;
  const Tap<int> tap = bench.tap({2});
  bench.send({1});
  try {
    bench.dates(1);
    FAIL() << "half a token has passed";
  } catch (const sc_core::sc_report& report) {
    EXPECT_STREQ(report.get_msg_type(), "/parallax/stream/tap");
  }
}

}  // namespace tap_test
}  // namespace parallax::test
