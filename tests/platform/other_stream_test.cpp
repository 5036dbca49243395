// SPDX-License-Identifier: Apache-2.0
// Outputs that are exchanged, and inputs that pass, as a comparison says it.
#include "platform/cosim/other_stream.hpp"

#include <gtest/gtest.h>

#include "tests/platform/altered_dump.hpp"

namespace parallax {
namespace other_stream_test {

using test::Words;

// Three streams that are alike, an input and two outputs, each with random values of its own.
class Streams : public test::AlteredDump {
 protected:
  Streams() {
    for (const char* const name : {"pixels", "left", "right"}) {
      const std::size_t number = all_.size();
      make(test::image_of(gray_format(), 40), 40, 30);
      for (auto& word : words_) word[0] = (word[0] * (2 * number + 1) + number) & 0xFF;
      all_.push_back(words_);
      names_.push_back(name);
    }
    const VectorStream like = stream();
    manifest_.streams.assign(3, like);
    for (std::size_t i = 0; i < 3; ++i) {
      manifest_.streams[i].name = names_[i];
      manifest_.streams[i].is_input = i == 0;
    }
  }
  std::string said(const Words& got, std::size_t of = 1) const {
    std::vector<TokenWords> words;
    for (const Words& each : all_) words.push_back(test::packed(manifest_.streams[0], each));
    const VectorStream& stream = manifest_.streams[of];
    const TokenComparison comparison =
        compare_tokens(manifest_, stream, words[of], {test::packed(stream, got), {}},
                       [&](const VectorStream& other) { return &words[&other - manifest_.streams.data()]; });
    const DifferencePattern first =
        comparison.patterns.empty() ? DifferencePattern{"", ""} : comparison.patterns.front();
    return first.name + ": " + first.text;
  }

  std::vector<Words> all_;
  std::vector<std::string> names_;
};

TEST_F(Streams, AreExchangedOrPassed) {
  const std::string end = ": the two are exchanged, or that one is there twice";
  EXPECT_EQ(said(all_[2]), "exchanged_streams: all its tokens are those of right" + end);
  EXPECT_EQ(said(all_[1], 2), "exchanged_streams: all its tokens are those of left" + end);
  EXPECT_EQ(said(all_[0]), "input_unchanged: all its tokens are those of the input pixels, unchanged");
  EXPECT_EQ(said(all_[1]), ": ");
  // Of an output that is as the input, too.
  all_[0] = all_[2];
  EXPECT_EQ(said(all_[2]), "exchanged_streams: all its tokens are those of right" + end);
  // Of fewer tokens it is still true.
  Words cut(all_[2].begin(), all_[2].begin() + 700);
  EXPECT_EQ(said(cut), "exchanged_streams: all its tokens are those of right" + end);
}

TEST_F(Streams, OneTokenThatIsAnotherIsNotThat) {
  Words got = all_[2];
  got[1100][0] ^= 1;
  EXPECT_EQ(said(got), "none: none of those known: scattered over the image");
  // Nor are tokens that are all the same: many a broken circuit has them.
  all_[2].assign(all_[2].size(), {9});
  EXPECT_EQ(said(all_[2]), "constant: all its tokens are the same");
  // Nor is another kind of token.
  got = all_[0];
  manifest_.streams[0].shape.format = census_code_format(8);
  EXPECT_EQ(said(got), "none: none of those known: scattered over the image");
}

}  // namespace other_stream_test
}  // namespace parallax
