// SPDX-License-Identifier: Apache-2.0
// What is found of a FIFO equals what a simulation, cycle by cycle, was told to be, and one cycle that
// differs leaves no description.
#include "platform/cosim/fifo_description.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <random>

namespace parallax {
namespace fifo_description_test {

struct Stalls {
  unsigned seed = 1;
  int cycles = 4000;
  std::vector<int> write_percent{100, 3, 60, 100, 0};  // by turns
  std::vector<int> read_percent{0, 3, 100, 60, 100, 0, 3};
  int turn = 90;  // cycles
};

// By the definition of the offsets: a list of the dates at which each token was written and read, in time.
class SimulatedFifo {
 public:
  explicit SimulatedFifo(const FifoDescription& fifo) : fifo_(fifo) {}

  FifoCapture run(const Stalls& stalls, std::int64_t write_period = 10, std::int64_t read_period = 10) const {
    FifoCapture capture;
    capture.file = "waves";
    capture.two_clocks = fifo_.two_clocks;
    std::minstd_rand random(stalls.seed);
    std::vector<std::int64_t> written, read;  // times
    const auto count_edges = [](std::int64_t after, std::int64_t until, std::int64_t period) {
      std::int64_t edges = 0;
      for (std::int64_t t = after + 1; t <= until; ++t) edges += t % period == 0 ? 1 : 0;
      return edges;
    };
    const auto wants = [&](const std::vector<int>& percent, std::int64_t cycle) {
      return static_cast<int>(random() % 100) <
             percent[static_cast<std::size_t>(cycle / stalls.turn) % percent.size()];
    };
    bool offered = false;
    for (std::int64_t time = 0; time < stalls.cycles * write_period; ++time) {
      const bool write_edge = time % write_period == 0;
      const bool read_edge = time % read_period == 0;
      if (!write_edge && !read_edge) continue;
      if (write_edge && !offered) offered = wants(stalls.write_percent, time / write_period);
      const bool read_wanted = read_edge && wants(stalls.read_percent, time / read_period);
      const auto has_room = [&] {
        if (time / write_period < fifo_.not_ready_cycles) return false;
        const auto token = static_cast<std::int64_t>(written.size()) - fifo_.depth;
        if (token < 0) return true;
        return token < static_cast<std::int64_t>(read.size()) &&
               count_edges(read[static_cast<std::size_t>(token)], time, write_period) >= fifo_.read_to_write;
      };
      const auto has_token = [&] {
        return read.size() < written.size() &&
               count_edges(written[read.size()], time, read_period) >= fifo_.write_to_read;
      };
      // What passes in a cycle settles: a token that comes may be read, a slot that is read be taken.
      bool takes = false, reads = false, room = false, token = false;
      for (int pass = 0; pass < 3; ++pass) {
        if (write_edge && !takes) {
          room = has_room();
          if (room && offered) {
            takes = true;
            written.push_back(time);
          }
        }
        if (read_edge && !reads) {
          token = has_token();
          if (token && read_wanted) {
            reads = true;
            read.push_back(time);
          }
        }
      }
      if (write_edge) note(capture.write, time, room, offered);
      if (read_edge) note(capture.read, time, token, read_wanted);
      if (takes) offered = false;
    }
    return capture;
  }

 private:
  static void note(FifoSide& side, std::int64_t time, bool granted, bool wanted) {
    side.edges.push_back(time);
    side.granted.push_back(granted);
    side.wanted.push_back(wanted);
  }

  const FifoDescription fifo_;
};

FifoDescription fifo(std::int64_t write_to_read, std::int64_t read_to_write, std::int64_t depth,
                     std::int64_t not_ready = 0) {
  return {false, write_to_read, read_to_write, depth, not_ready};
}

void expect_found(const FifoFinding& finding, const FifoDescription& expected) {
  ASSERT_TRUE(finding.description) << finding.reason;
  EXPECT_EQ(finding.description->two_clocks, expected.two_clocks);
  EXPECT_EQ(finding.description->write_to_read, expected.write_to_read);
  EXPECT_EQ(finding.description->read_to_write, expected.read_to_write);
  EXPECT_EQ(finding.description->depth, expected.depth);
  EXPECT_EQ(finding.description->not_ready_cycles, expected.not_ready_cycles);
}

TEST(FifoDescription, IsWhatWasSimulated) {
  std::minstd_rand random(5);
  for (unsigned i = 0; i < 60; ++i) {
    const auto below = [&](unsigned most) { return static_cast<std::int64_t>(random() % most); };
    const FifoDescription expected =
        fifo(below(7), below(7), 1 + below(i % 2 == 0 ? 6 : 60), below(3) * below(5));
    SCOPED_TRACE(testing::Message() << expected.write_to_read << ", " << expected.read_to_write << ", depth "
                                    << expected.depth << ", " << expected.not_ready_cycles);
    Stalls stalls;
    stalls.seed = i + 1;
    expect_found(describe_fifo({SimulatedFifo(expected).run(stalls)}), expected);
  }
}

TEST(FifoDescription, IsWhatWasSimulatedBetweenTwoClocks) {
  std::minstd_rand random(6);
  const std::vector<std::pair<std::int64_t, std::int64_t>> periods{
      {4, 10}, {10, 4}, {6, 5}, {15, 16}, {5, 5}};
  for (unsigned i = 0; i < 40; ++i) {
    const auto below = [&](unsigned most) { return static_cast<std::int64_t>(random() % most); };
    FifoDescription expected =
        fifo(1 + below(7), 1 + below(7), 1 + below(i % 2 == 0 ? 6 : 40), below(3) * below(5));
    expected.two_clocks = true;
    const auto [write_period, read_period] = periods[i % periods.size()];
    SCOPED_TRACE(testing::Message() << expected.write_to_read << ", " << expected.read_to_write << ", depth "
                                    << expected.depth << ", periods " << write_period << ", " << read_period);
    Stalls stalls;
    stalls.seed = i + 1;
    stalls.turn = 150;
    expect_found(describe_fifo({SimulatedFifo(expected).run(stalls, write_period, read_period)}), expected);
  }
}

// In each cycle, of either side, in which the FIFO could have said otherwise.
TEST(FifoDescription, NotWithOneCycleOtherwise) {
  const FifoDescription expected = fifo(2, 1, 4, 2);
  Stalls stalls;
  stalls.cycles = 900;
  const FifoCapture capture = SimulatedFifo(expected).run(stalls);
  expect_found(describe_fifo({capture}), expected);
  for (std::size_t cycle = 0; cycle < capture.write.edges.size(); ++cycle) {
    for (FifoSide FifoCapture::*side : {&FifoCapture::write, &FifoCapture::read}) {
      FifoCapture other = capture;
      other.file = "other";
      (other.*side).granted[cycle] = !(other.*side).granted[cycle];
      const FifoFinding finding = describe_fifo({capture, other});
      EXPECT_FALSE(finding.description) << cycle;
      EXPECT_FALSE(finding.needs_stalls) << cycle;
    }
  }
}

FifoCapture capture_of(const std::string& write, const std::string& read) {
  FifoCapture capture;
  capture.file = "waves";
  // Of each cycle: '.' neither, 'g' granted, 'w' wanted, 'm' moves.
  const auto fill = [](FifoSide& side, const std::string& cycles) {
    for (const char c : cycles) {
      side.edges.push_back(static_cast<std::int64_t>(side.edges.size()));
      side.granted.push_back(c == 'g' || c == 'm');
      side.wanted.push_back(c == 'w' || c == 'm');
    }
  };
  fill(capture.write, write);
  fill(capture.read, read);
  return capture;
}

std::string reason(const std::vector<FifoCapture>& captures) {
  const FifoFinding finding = describe_fifo(captures);
  EXPECT_FALSE(finding.description);
  return (finding.needs_stalls ? "stalls: " : "") + finding.reason;
}

TEST(FifoDescription, SaysWhichStallIsMissing) {
  EXPECT_EQ(reason({capture_of("wwww", "....")}), "stalls: waves: the FIFO never takes a token");
  EXPECT_EQ(reason({capture_of("gggg", "....")}),
            "stalls: no token is ever awaited: the FIFO must run empty, so that it shows when the next token "
            "can be read; "
            "let the writer rest now and then");
  // The second slot is freed by the read before it, or by that three cycles earlier.
  EXPECT_EQ(reason({capture_of("mgmm.gg", ".m.gmgg")}),
            "stalls: depth and read_to_write cannot be told apart: depth 2 with 1 edge, or depth 3 with 4 "
            "edges; let the "
            "reader rest for 5 cycles while the FIFO is full, then read one token and rest again");
}

TEST(FifoDescription, SaysWhenNoTokenComesOut) {
  EXPECT_EQ(
      reason({capture_of("mmm.", "....")}),
      "stalls: of 3 tokens that were written none could ever be read: is the reset over (its polarity), or "
      "does the FIFO wait for an input that nothing drives, as the end of a packet");
}

// Of one full FIFO many descriptions are right.
TEST(FifoDescription, IsNotFoundInWhatIsSeenTwice) {
  std::string writes, reads;
  for (int i = 0; i < 2; ++i) {
    writes += "mw";
    reads += ".m";
  }
  EXPECT_EQ(
      reason({capture_of(writes + "m", reads + ".")}),
      "stalls: the reader awaited 2 tokens of the empty FIFO, the writer 2 slots of the full one: 3 are "
      "needed of each; let both rest more often");
  EXPECT_TRUE(describe_fifo({capture_of(writes + "mwm", reads + ".m.")}).description);
}

TEST(FifoDescription, SaysWhenARefusedSlotIsNotConstant) {
  const FifoFinding finding = describe_fifo({capture_of("m.m..g", ".m.m..")});
  EXPECT_EQ(finding.reason,
            "when a slot can be written again is not a constant time after a read: depth 1 with 1 edge holds "
            "longest, up "
            "to token 2, which can be written in cycle 5");
  ASSERT_TRUE(finding.place);
  EXPECT_EQ(finding.place->token, 2U);
  EXPECT_EQ(finding.place->cycle, 5);
  EXPECT_EQ(reason({capture_of("m.m...", ".m.m..")}),
            "when a slot can be written again is not a constant time after a read: depth 1 with 1 edge holds "
            "longest, up "
            "to token 2, which can be written no more");
}

TEST(FifoDescription, SaysWhatNoStreamHas) {
  const std::string pause(69, '.');
  EXPECT_EQ(reason({capture_of("m" + pause + "gg", "." + pause + "gg")}),
            "a token takes 70 edges to the reader, 64 are the most that a stream has");
  EXPECT_EQ(reason({capture_of("m" + pause + "gg", ".m" + pause + ".")}),
            "a slot is free more than 64 edges after it was read, the most that a stream has");
}

TEST(FifoDescription, SaysWhatDiffersBetweenRuns) {
  FifoCapture other = capture_of(".ggg", "....");
  other.file = "other";
  EXPECT_EQ(reason({capture_of("gggg", "...."), other}),
            "after reset it is not ready for 0 cycles in waves, for 1 in other");
  other.two_clocks = true;
  EXPECT_EQ(reason({capture_of("gggg", "...."), other}), "other has two clocks, waves one");
}

TEST(FifoDescription, SaysWhereAFifoIsNone) {
  EXPECT_EQ(reason({capture_of("g.gg", "....")}), "it takes back that it can be written, without a write");
  EXPECT_EQ(reason({capture_of("mggg", ".g.g")}),
            "it takes back a token that can be read, before it is read");
  EXPECT_EQ(reason({capture_of("gggg", ".ggg")}), "it has a token to be read that nobody has written");
}

TEST(FifoDescription, SaysWhenTheDelayIsNotConstant) {
  const FifoFinding finding = describe_fifo({capture_of("mggggmgggg", ".mwwwwwmww")});
  EXPECT_EQ(finding.reason,
            "how long a token takes to the reader is not constant: token 0 can be read 1 edge after it is "
            "written, token "
            "1 after 2 edges");
  ASSERT_TRUE(finding.place);
  EXPECT_EQ(finding.place->file, "waves");
  EXPECT_EQ(finding.place->token, 1U);
  EXPECT_EQ(finding.place->cycle, 7);
  EXPECT_EQ(finding.place->fill, 1U);
}

}  // namespace fifo_description_test
}  // namespace parallax
