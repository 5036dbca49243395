// SPDX-License-Identifier: Apache-2.0
// What a comparison says of dumps whose frames differ in different ways.
#include "platform/cosim/frame_patterns.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/platform/altered_dump.hpp"

namespace parallax {
namespace frame_patterns_test {

using test::codes;
using test::Words;

class Frames : public test::AlteredDump {
 protected:
  static constexpr std::size_t kFrame = 40 * 30;
  void SetUp() override { make(codes(40, 24), 40, 30, 2); }
  Words late(std::size_t by) const {
    Words got = words_;
    for (std::size_t i = 0; i < got.size(); ++i) {
      const std::size_t in_frame = i % kFrame;
      got[i] = in_frame < by ? std::vector<std::uint64_t>{7} : words_[i - by];
    }
    return got;
  }
};

TEST_F(Frames, ADelayThatBeginsAnewInEach) {
  EXPECT_EQ(first_pattern(late(2)), "constant_latency");
  EXPECT_EQ(said(late(2)), "all tokens are 2 tokens late, in each frame anew");
}

TEST_F(Frames, OneIsEqual) {
  Words got = late(2);
  std::copy(words_.begin(), words_.begin() + kFrame, got.begin());
  const TokenComparison comparison = compare(got);
  ASSERT_EQ(comparison.patterns.size(), 2U) << text(comparison);
  EXPECT_EQ(comparison.patterns[0].name, "frames_after_first");
  EXPECT_EQ(comparison.patterns[1].name, "constant_latency");
  EXPECT_EQ(comparison.patterns[1].text, "frame 1: all tokens are 2 tokens late");
}

TEST_F(Frames, EachWithAnotherFault) {
  Words got = late(2);
  for (std::size_t i = kFrame; i < 2 * kFrame; ++i) got[i] = {~words_[i][0] & 0xFFFFFF};
  const TokenComparison comparison = compare(got);
  EXPECT_EQ(said(got), "frame 0: all tokens are 2 tokens late; frame 1: all bits are inverted");
  EXPECT_EQ(to_json(comparison).at("patterns").at(1).at("frame"), 1);
  // A place is told in the stream of all frames.
  for (std::size_t i = kFrame; i < 2 * kFrame; ++i) got[i] = words_[i < kFrame + 500 ? i : i - 1];
  EXPECT_EQ(
      said(got),
      "frame 0: all tokens are 2 tokens late; frame 1: a token comes twice before token 1700 (frame 1, row "
      "12, column 20), all others are there");
  // One that nothing explains comes last.
  for (std::size_t i = 0; i < kFrame; i += 7) got[i] = {words_[i][0] ^ (1 + i % 5)};
  for (std::size_t i = 0; i < kFrame; ++i) {
    if (i % 7 != 0) got[i] = words_[i];
  }
  EXPECT_EQ(said(got).substr(0, 30), "frame 1: a token comes twice b");
}

TEST_F(Frames, OneThatDidNotComeIsNotEqual) {
  Words got = late(2);
  got.resize(kFrame);
  EXPECT_EQ(said(got), "all tokens are 2 tokens late");
  for (std::size_t i = 0; i < kFrame; ++i) got[i] = i % 13 == 5 ? std::vector<std::uint64_t>{i} : words_[i];
  EXPECT_EQ(said(got), "none of those known: scattered over the image");
}

}  // namespace frame_patterns_test
}  // namespace parallax
