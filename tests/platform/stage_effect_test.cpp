// SPDX-License-Identifier: Apache-2.0
// How much a stage changes of its input, as a comparison says it.
#include "platform/cosim/stage_effect.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/platform/altered_dump.hpp"

namespace parallax {
namespace stage_effect_test {

using test::Words;

// A filter of disparities, with an input of grey values beside them.
class Filter : public ::testing::Test {
 protected:
  Filter() {
    manifest_ = test::image_manifest(test::image_of(disparity_format(), kWidth), kWidth, kHeight, 1);
    manifest_.streams.front().name = "smoothed";
    manifest_.streams.front().port = "out_disparity";
    add_input("left_delayed", "in_left", gray_format());
    add_input("interpolated", "in_disparity", disparity_format());
    for (std::uint64_t i = 0; i < kWidth * kHeight; ++i) out_.push_back({i * 37 % 4096});
    in_ = out_;
  }

  void add_input(const std::string& name, const std::string& port, const TokenFormat& format) {
    VectorStream input = manifest_.streams.front();
    input.name = name;
    input.port = port;
    input.is_input = true;
    input.shape.format = format;
    manifest_.streams.push_back(input);
  }

  // Compares `got` where the streams after the output have these words.
  TokenComparison compare(const Words& got, const std::vector<Words>& inputs) const {
    const VectorStream& output = manifest_.streams.front();
    std::vector<TokenWords> words;
    for (std::size_t i = 0; i < inputs.size(); ++i)
      words.push_back(test::packed(manifest_.streams[i + 1], inputs[i]));
    return compare_tokens(manifest_, output, test::packed(output, out_), {test::packed(output, got), {}},
                          [&](const VectorStream& stream) -> const TokenWords* {
                            const auto at = static_cast<std::size_t>(&stream - &output);
                            return at == 0 || at > words.size() ? nullptr : &words[at - 1];
                          });
  }
  TokenComparison compare(const Words& got) const { return compare(got, {Words(out_.size(), {7}), in_}); }

  static constexpr int kWidth = 40, kHeight = 30;
  VectorManifest manifest_;
  Words in_, out_;
};

TEST_F(Filter, SaysHowManyTokensItChanges) {
  const std::string equal = "smoothed: equal, 1200 tokens\n";
  const auto line = [](int changed) {
    return fmt::format("equal says little   the stage changes {} of 1200 tokens of interpolated\n", changed);
  };
  EXPECT_EQ(text(compare(out_)), equal + line(0));
  for (std::uint64_t i = 0; i < 11; ++i) in_[i * 100][0] ^= 1;
  EXPECT_EQ(text(compare(out_)), equal + line(11));
  in_[1150][0] ^= 1;  // 1 in 100
  EXPECT_EQ(text(compare(out_)), equal);
  EXPECT_EQ(to_json(compare(out_)).at("changed_tokens"), 12);
  EXPECT_EQ(to_json(compare(out_)).at("input_stream"), "interpolated");
  Words other = out_;
  other[5][0] ^= 1;
  EXPECT_EQ(to_json(compare(other)).at("changed_tokens"), 12) << "of the model, whatever the circuit does";
}

TEST_F(Filter, SaysNothingWhereItsInputIsNotAtHand) {
  EXPECT_EQ(to_json(compare(out_, {})).count("changed_tokens"), 0U);
  EXPECT_EQ(text(compare(out_, {})), "smoothed: equal, 1200 tokens\n");
  manifest_.streams.pop_back();  // grey values are no disparities
  EXPECT_EQ(to_json(compare(out_, {out_})).count("changed_tokens"), 0U);
}

TEST_F(Filter, OfSeveralInputsTheOneOfItsSideIsMeant) {
  add_input("other_side", "in_right", disparity_format());
  manifest_.streams[0].port = "out_right";
  const auto changed = [this] {
    const auto tree = to_json(compare(out_, {Words(out_.size(), {7}), Words(out_.size(), {7}), out_}));
    return tree.value("changed_tokens", -1);
  };
  EXPECT_EQ(changed(), 0);
  manifest_.streams[0].port = "out_disparity";
  EXPECT_EQ(changed(), 1199) << "one of them is 7";
  manifest_.streams[0].port = "out";
  EXPECT_EQ(changed(), -1) << "which one, nothing says";
}

TEST_F(Filter, SaysThatAllValuesAreTheSame) {
  out_.assign(out_.size(), {4095});
  EXPECT_EQ(text(compare(out_)),
            "smoothed: equal, 1200 tokens\nequal says little   all values of the model are 4095\n");
  EXPECT_EQ(to_json(compare(out_)).at("only_value"), 4095);
  in_ = out_;
  EXPECT_EQ(text(compare(out_)),
            "smoothed: equal, 1200 tokens\nequal says little   all values of the model are 4095, the stage "
            "changes 0 of 1200 tokens of interpolated\n");
  out_.back() = {4094};
  EXPECT_EQ(to_json(compare(out_)).count("only_value"), 0U);
}

}  // namespace stage_effect_test
}  // namespace parallax
