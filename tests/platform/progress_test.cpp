// SPDX-License-Identifier: Apache-2.0
#include "platform/results/progress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <vector>

namespace parallax {
namespace progress_test {

using std::chrono::seconds;

TEST(Progress, ShowsShareAndTimeLeft) {
  EXPECT_EQ(Progress::line("frames", 0, 100, seconds(0)), "[                        ] 0/100 frames");
  EXPECT_EQ(Progress::line("frames", 50, 100, seconds(3)),
            "[============            ] 50/100 frames, 3 s left");
  EXPECT_EQ(Progress::line("frames", 1, 100, seconds(1)),
            "[                        ] 1/100 frames, 1 min 39 s left");
  EXPECT_EQ(Progress::line("frames", 1, 3, seconds(3600)),
            "[========                ] 1/3 frames, 2 h 00 min left");
  EXPECT_EQ(Progress::line("frames", 3, 3, seconds(1)), "[========================] 3/3 frames");
  EXPECT_EQ(Progress::line("frames", 0, 0, seconds(1)), "[                        ] 0/0 frames");
}

TEST(Progress, PrintsNothingInAPipe) {
  std::ostringstream out;
  {
    Progress progress(out, false, "frames", 2);
    progress.advance();
    progress.advance();
  }
  EXPECT_EQ(out.str(), "");
}

TEST(Progress, DrawsAtMostTenTimesASecondAndWipesTheLine) {
  std::ostringstream out;
  const auto start = Progress::Clock::now();
  {
    Progress progress(out, true, "frames", 1000);
    for (int i = 0; i < 999; ++i) progress.advance(1, start + std::chrono::milliseconds(i));
    progress.advance(1, start + seconds(1));
  }
  const std::string text = out.str();
  const auto lines = std::count(text.begin(), text.end(), '[') - std::count(text.begin(), text.end(), '\033');
  EXPECT_GE(lines, 9);
  EXPECT_LE(lines, 12);
  EXPECT_NE(text.find("1000/1000 frames"), std::string::npos);
  EXPECT_EQ(text.substr(text.size() - 4), "\r\033[K");
}

TEST(Progress, SaysWhenThereMayBeMore) {
  std::ostringstream out;
  const auto start = Progress::Clock::now();
  Progress progress(out, true, "frames", 3);
  progress.may_go_on_to(20);
  for (int i = 1; i <= 3; ++i) progress.advance(1, start + seconds(i));
  EXPECT_NE(out.str().find("3/3 frames"), std::string::npos) << out.str();
  EXPECT_EQ(out.str().find("at most"), std::string::npos) << out.str();
  progress.advance(1, start + seconds(4));
  EXPECT_NE(out.str().find("4/20 frames at most, 16 s left"), std::string::npos) << out.str();
}

TEST(Progress, SaysOnceHowManyMinutesAreToGo) {
  std::ostringstream out;
  std::vector<std::string> notes;
  const auto note = [&notes](const std::string& line) { notes.push_back(line); };
  Progress progress(out, false, "frames", 1000, note);
  const auto start = Progress::Clock::now();
  progress.advance(1, start + seconds(0));
  progress.advance(1, start + seconds(1));
  EXPECT_TRUE(notes.empty()) << "too early to say";
  progress.advance(1, start + seconds(5));  // two in 5 s: 997 in 2492 s
  progress.advance(1, start + seconds(9));
  EXPECT_EQ(notes,
            std::vector<std::string>{"about 42 minutes to go, 3 of 1000 frames are done; Ctrl-C ends it and "
                                     "keeps what is complete"});
  notes.clear();
  Progress slow(out, false, "frames", 100, note);
  slow.reached(0.01, start + seconds(4));
  EXPECT_TRUE(notes.empty());
  slow.reached(0.01, start + seconds(25));  // 99 times 25 s
  EXPECT_EQ(notes,
            std::vector<std::string>{"about 41 minutes to go, 0 of 100 frames are done; Ctrl-C ends it and "
                                     "keeps what is complete"});
  notes.clear();
  Progress soon(out, false, "frames", 100, note);
  for (int i = 1; i <= 100; ++i) soon.advance(1, start + seconds(i));
  EXPECT_TRUE(notes.empty()) << "not worth a note";
  EXPECT_EQ(out.str(), "");
}

}  // namespace progress_test
}  // namespace parallax
