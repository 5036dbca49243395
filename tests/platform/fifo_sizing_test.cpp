// SPDX-License-Identifier: Apache-2.0
// Sizes of a machine's FIFOs, and the runs that they are found by.
#include "platform/evaluation/fifo_sizing.hpp"

#include <gtest/gtest.h>

#include "platform/config/preset.hpp"
#include "platform/evaluation/evaluation_pool.hpp"
#include "platform/machine/steady_state.hpp"
#include "tests/timing/machine_bench.hpp"
#include "tlm/error.hpp"

namespace parallax::test {
namespace fifo_sizing_test {

const auto kNever = [] { return false; };

class Sizing : public testing::Test {
 protected:
  Sizing() {
    input_.width = 64;
    input_.height = 32;
    input_.map = &map_;
    input_.timing_frames = run_length(configuration({}).machine, 1, std::nullopt).least;
  }

  static Configuration configuration(const std::vector<std::string>& changes) {
    ConfigurationRequest request;
    request.assignments = {"rectification.window=9", "matching.iterations=2", "link.host_pixel_rate=0"};
    request.changes = changes;
    return load_configuration(request, preset_folders());
  }
  std::vector<MachineFifo> fifos() const {
    return machine_fifos(configuration({}).machine, input_, kNever).value();
  }
  std::vector<EvaluationResult> evaluate(const std::vector<std::vector<std::string>>& all,
                                         std::int64_t longest_frame_ps) const {
    EvaluationInput input = input_;
    input.longest_frame_ps = longest_frame_ps;
    EvaluationPool pool([&](const Variant& variant, const NoticeSink&) {
      return EvaluationCase{configuration(variant.assignments), input};
    });
    std::vector<Variant> variants;
    for (const std::vector<std::string>& assignments : all) variants.push_back({assignments});
    std::vector<EvaluationResult> results;
    pool.evaluate(variants, kNever, [&](std::size_t, EvaluationResult result) { results.push_back(result); });
    return results;
  }
  FifoSizing size(const std::vector<MachineFifo>& fifos, const FifoGoal& goal) const {
    return FifoSizer(fifos, [this](const auto& all, std::int64_t longest) { return evaluate(all, longest); })
        .size(goal);
  }

  const EncodedMap map_ = encode(identity_map(64, 32, {9, 5}));
  EvaluationInput input_;
};

TEST_F(Sizing, KnowsTheFifosOfTheMachine) {
  const std::vector<MachineFifo> all = fifos();
  ASSERT_EQ(all.size(), 20U);
  EXPECT_EQ(all.front().stream, "left_pixels");
  EXPECT_EQ(all.front().key(), "streams.left_pixels.depth");
  EXPECT_EQ(all.front().kind, "registered");
  EXPECT_EQ(all.front().width, 8);
  EXPECT_EQ(all.front().depth, 16);
  EXPECT_EQ(all.front().write_to_read + all.front().read_to_write, 2);
  EXPECT_EQ(all.back().stream, "smoothed");
}

TEST_F(Sizing, DepthsWithoutDeadlockAreThoseOfTheModel) {
  FifoGoal goal;
  goal.kind = FifoGoal::Kind::kDeadlockFree;
  const std::vector<MachineFifo> all = fifos();
  const FifoSizing sizing = size(all, goal);
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_EQ(sizing.found.depths[i], all[i].deadlock_free) << all[i].stream;
  EXPECT_EQ(sizing.proof.size(), 2U);
  for (const SizedRun& run : sizing.proof) {
    EXPECT_FALSE(run.done || run.too_slow);
    EXPECT_NE(run.message.find("would free it"), std::string::npos) << run.message;
  }
}

TEST_F(Sizing, ARunThatIsTooSlowEndsEarlyAndOnlyThen) {
  const std::vector<std::string> now{"streams.left_pixels.depth=16"};
  const std::vector<std::string> slow{"streams.costs_uniqueness.depth=2"};
  const std::vector<EvaluationResult> whole = evaluate({now, slow}, 0);
  ASSERT_TRUE(whole[0].done() && whole[1].done());
  const FramePeriod fast = frame_period(whole[0]);
  ASSERT_FALSE(frame_period(whole[1]).keeps(fast, 0.001));
  const std::vector<EvaluationResult> results = evaluate({now, slow}, fast.picoseconds / fast.frames + 1);
  EXPECT_TRUE(results[0].done());
  EXPECT_EQ(results[0].rate, whole[0].rate);
  EXPECT_EQ(results[1].status, EvaluationResult::Status::kTooSlow);
  EXPECT_STREQ(name(results[1].status), "too slow");
}

TEST(FramePeriod, ComparesPicosecondsOfDifferentNumbersOfFrames) {
  const FramePeriod two{20'000'000'000'002, 2}, one{10'000'000'000'001, 1}, longer{10'000'000'000'002, 1};
  EXPECT_TRUE(two.keeps(one, 0));
  EXPECT_TRUE(one.keeps(two, 0));
  EXPECT_FALSE(longer.keeps(two, 0));
  EXPECT_TRUE(two.keeps(longer, 0));
  EXPECT_TRUE(longer.keeps(two, 1e-12));
  EXPECT_EQ(FramePeriod({9'974'000'000, 1}).milliseconds(), 9.974);
}

TEST_F(Sizing, ARateGivesBackItsPicoseconds) {
  for (const std::int64_t picoseconds : {27'544'248'001LL, 13'093'830'009LL, 345'693'144'000'001LL}) {
    for (const std::int64_t frames : {2, 3, 97}) {
      MetricGroup metrics;
      metrics.group("steady").metrics.push_back({"frames", std::int64_t{frames + 1}, "", "", ""});
      EvaluationResult result;
      result.rate = 1.0 / (static_cast<double>(picoseconds) * 1e-12 / static_cast<double>(frames));
      result.metrics = metrics;
      EXPECT_EQ(frame_period(result).picoseconds, picoseconds);
    }
  }
}

}  // namespace fifo_sizing_test
}  // namespace parallax::test
