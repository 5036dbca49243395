// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/verdict.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "platform/evaluation/evaluation_pool.hpp"
#include "platform/evaluation/own_work.hpp"
#include "platform/input/image_padding.hpp"
#include "tests/timing/random_machine.hpp"

namespace parallax::test {
namespace verdict_test {

/// A machine that can be evaluated with relaxations.
class Subject {
 public:
  Subject(int width, int height, const std::vector<std::string>& assignments)
      : config_(preset(assignments)),
        size_(padded_size({width, height}, config_.image.granularity())),
        map_(encode(lens_map(size_.width, size_.height, config_.rectification.range))),
        pool_([=](const Variant& variant, const NoticeSink&) {
          ConfigurationRequest request;
          request.assignments = assignments;
          request.changes = variant.assignments;
          EvaluationCase one{load_configuration(request, {source_path("platform/presets")}), {}};
          one.input.width = width;
          one.input.height = height;
          one.input.map = &map_;
          return one;
        }),
        base_(try_out({{}}).front()) {}

  const EvaluationResult& base() const { return base_; }
  /// After `most` evaluations there are no more.
  Verdict verdict(Thoroughness thoroughness, std::size_t most = 1000) {
    evaluations_ = 0;
    return find_verdict(config_, base_, thoroughness, [this, most](const std::vector<Relaxation>& some) {
      std::vector<Variant> variants;
      for (const Relaxation& relaxation : some) {
        if (evaluations_ == most) break;
        ++evaluations_;
        variants.push_back({relaxation.assignments});
      }
      return try_out(variants);
    });
  }
  /// Of the last verdict.
  std::size_t evaluations() const { return evaluations_; }

 private:
  std::vector<EvaluationResult> try_out(const std::vector<Variant>& variants) {
    std::vector<EvaluationResult> results;
    pool_.evaluate(
        variants, [] { return false; },
        [&](std::size_t, EvaluationResult result) { results.push_back(std::move(result)); });
    return results;
  }

  const MachineConfig config_;
  const cv::Size size_;
  const EncodedMap map_;
  EvaluationPool pool_;
  const EvaluationResult base_;
  std::size_t evaluations_ = 0;
};

std::vector<std::string> exactly(std::vector<std::string> assignments) {
  assignments.insert(assignments.end(), {"image.width_granularity=1", "image.height_granularity=1"});
  return assignments;
}

// The largest gain of those that the sentence says nothing of, %.
const RelaxedLimit& most_unexplained(const Verdict& all) {
  const std::vector<RelaxedLimit>& alone = all.limits.alone;
  return *std::find_if(alone.begin(), alone.end(), [&](const RelaxedLimit& limit) {
    return !(all.faster_clock && limit.relaxation.is(Relief::kCoreClock)) &&
           !(all.all_fifos && limit.relaxation.name == name_of(Relief::kFifos));
  });
}

TEST(Verdict, NothingGainsMoreThanWhatItNames) {
  int measured = 0;
  for (std::uint32_t seed = 1; seed <= (sanitized() ? 3U : 20U); ++seed) {
    const MachineCase c = random_machine(seed, Contention::kAny);
    Subject subject(c.width, c.height, exactly(c.assignments()));
    if (!subject.base().done()) continue;
    ++measured;
    const Verdict quick = subject.verdict(Thoroughness::kUntilCertain);
    const Verdict all = subject.verdict(Thoroughness::kAll);
    const RelaxedLimit& most = most_unexplained(all);  // each limit alone is tried there
    for (const RelaxedLimit& limit : all.limits.alone) {
      if (!limit.measured) continue;
      EXPECT_LE(limit.gain, most_gain(limit.relaxation, subject.base().metrics) + RelaxedLimit::kNoise)
          << "seed " << seed << ": " << limit.relaxation.name << '\n'
          << c.text();
    }
    for (const Verdict& verdict : {quick, all}) {
      const double named = verdict.limits.limit ? verdict.limits.limit->gain : 0;
      EXPECT_LE(most.gain, named + RelaxedLimit::kNoise)
          << "seed " << seed << ": " << most.relaxation.name << " gains more\n"
          << verdict.sentence << '\n'
          << c.text();
    }
    EXPECT_EQ(quick.limits.limit_name(), all.limits.limit_name()) << "seed " << seed << '\n'
                                                                  << quick.sentence << '\n'
                                                                  << all.sentence;
  }
  EXPECT_GE(measured, sanitized() ? 1 : 12);
}

const std::vector<std::string> kSmall{"rectification.window=9", "software.response_ns=0",
                                      "software.queue_frames=true", "link.host_pixel_rate=0",
                                      "link.line_rate=10000000000"};

std::vector<std::string> small(const std::vector<std::string>& more) {
  std::vector<std::string> all = kSmall;
  all.insert(all.end(), more.begin(), more.end());
  return exactly(all);
}

TEST(Verdict, NamesTheFifoAndADepthThatIsEnough) {
  Subject subject(64, 48, small({"streams.costs_uniqueness.depth=2"}));
  for (const Thoroughness thoroughness : {Thoroughness::kUntilCertain, Thoroughness::kAll}) {
    const Verdict verdict = subject.verdict(thoroughness);
    ASSERT_TRUE(verdict.limits.limit);
    EXPECT_EQ(verdict.limits.limit_name(), "fifo_costs_uniqueness");
    EXPECT_EQ(verdict.sentence.rfind("FIFO costs_uniqueness with its depth of 2 limits", 0), 0U)
        << verdict.sentence;
    EXPECT_NE(verdict.sentence.find("; a depth of 16 gives "), std::string::npos) << verdict.sentence;
    EXPECT_EQ(verdict.limits.limit->relaxation.assignments,
              std::vector<std::string>{"streams.costs_uniqueness.depth=16"});
    EXPECT_LE(subject.evaluations(), thoroughness == Thoroughness::kAll ? 40U : 20U);
  }
}

// Of the fifteen limits of this machine few have to be tried.
TEST(Verdict, FindsPathCostsInMemoryWithFewRuns) {
  Subject subject(64, 48, small({"matching.path_storage=memory"}));
  const Verdict quick = subject.verdict(Thoroughness::kUntilCertain);
  EXPECT_EQ(quick.limits.limit_name(), "path_storage") << quick.sentence;
  EXPECT_LE(subject.evaluations(), 10U);
  const Verdict all = subject.verdict(Thoroughness::kAll);
  EXPECT_EQ(all.limits.limit_name(), "path_storage") << all.sentence;
  EXPECT_EQ(quick.sentence, all.sentence);
}

// Where host or cameras are at work all the time, nothing else is tried.
TEST(Verdict, TriesNothingThatThePartAtWorkLeavesNoTimeFor) {
  Subject host(64, 48, small({"link.host_pixel_rate=1000000"}));
  EXPECT_EQ(host.verdict(Thoroughness::kUntilCertain).limits.limit_name(), "host");
  EXPECT_EQ(host.evaluations(), 1U);
  Subject cameras(64, 48, small({"camera.frame_rate=500"}));
  EXPECT_EQ(cameras.verdict(Thoroughness::kUntilCertain).limits.limit_name(), "camera");
  EXPECT_LE(cameras.evaluations(), 2U);
}

// However few trials there may be, the sentence names the best of them, and says that there were no more.
TEST(Verdict, SaysThatNotAllCouldBeTried) {
  Subject subject(64, 48, small({"streams.costs_uniqueness.depth=2"}));
  const Verdict whole = subject.verdict(Thoroughness::kUntilCertain);
  const std::size_t needed = subject.evaluations();
  EXPECT_TRUE(whole.complete);
  EXPECT_EQ(whole.sentence.find("--relax"), std::string::npos) << whole.sentence;
  double before = 0;
  for (std::size_t most = 0; most < needed; ++most) {
    const Verdict verdict = subject.verdict(Thoroughness::kUntilCertain, most);
    EXPECT_FALSE(verdict.complete) << most;
    if (verdict.limits.limit) {
      EXPECT_NE(
          verdict.sentence.find("; the time for trials was over before all others were tried, --relax "),
          std::string::npos)
          << verdict.sentence;
      EXPECT_GE(verdict.limits.limit->gain, before - 1) << verdict.sentence;
      before = verdict.limits.limit->gain;
    } else {
      EXPECT_EQ(
          verdict.sentence,
          "the time for trials was over before a limit was found; --relax takes the time that it needs");
      EXPECT_EQ(before, 0) << most;
    }
  }
  EXPECT_NEAR(before, whole.limits.limit->gain, 1);
}

// All stages have one clock, so that a faster one shortens what they wait for each other, too.
TEST(Verdict, NamesTheFifoThatAFasterClockHides) {
  Subject subject(
      64, 48, small({"clocks.core_hz=10000000", "matching.iterations=1", "streams.left_texture.depth=64"}));
  for (const Thoroughness thoroughness : {Thoroughness::kUntilCertain, Thoroughness::kAll}) {
    const Verdict verdict = subject.verdict(thoroughness);
    EXPECT_EQ(verdict.limits.limit_name(), "fifo_left_texture") << verdict.sentence;
    ASSERT_TRUE(verdict.faster_clock) << verdict.sentence;
    EXPECT_GT(verdict.faster_clock->gain, verdict.limits.limit->gain);
    EXPECT_NE(verdict.sentence.find(", as it shortens these waits too"), std::string::npos)
        << verdict.sentence;
  }
  // What takes time beside the core's is not hidden by its clock.
  const Verdict software = Subject(64, 48, small({"clocks.core_hz=10000000", "software.response_ns=200000"}))
                               .verdict(Thoroughness::kAll);
  EXPECT_EQ(software.limits.limit_name(), "core_clock") << software.sentence;
  EXPECT_FALSE(software.faster_clock) << software.sentence;
}

TEST(Verdict, NamesTheFifoThatDoesMostOfIt) {
  Subject subject(64, 48,
                  small({"clocks.core_hz=1000000", "matching.iterations=1", "pipeline.pixels_per_token=2",
                         "streams.left_texture.depth=20"}));
  const Verdict verdict = subject.verdict(Thoroughness::kAll);
  EXPECT_EQ(verdict.limits.limit_name(), "fifo_left_texture") << verdict.sentence;
  ASSERT_TRUE(verdict.all_fifos) << verdict.sentence;
  EXPECT_GT(verdict.all_fifos->gain, verdict.limits.limit->gain);
  EXPECT_NE(verdict.sentence.find("; all FIFOs deeper give "), std::string::npos) << verdict.sentence;
}

TEST(Verdict, NamesTheDefaultDepthWhereManyFifosHaveIt) {
  Subject subject(
      64, 48,
      small({"clocks.core_hz=1000000", "matching.iterations=1", "pipeline.overlap_frames=true",
             "pipeline.pixels_per_token=4", "matching.parallel_rows=4", "streams.default_depth=1"}));
  const Verdict verdict = subject.verdict(Thoroughness::kAll);
  EXPECT_EQ(verdict.limits.limit_name(), "fifos_default_depth") << verdict.sentence;
  EXPECT_EQ(verdict.sentence.rfind("FIFOs with their default depth of 1 limit", 0), 0U) << verdict.sentence;
  ASSERT_TRUE(verdict.limits.limit);
  EXPECT_EQ(verdict.limits.limit->relaxation.assignments,
            std::vector<std::string>{"streams.default_depth=2"});
  EXPECT_NE(to_text(verdict.limits).find("\nfifos_default_depth "), std::string::npos)
      << to_text(verdict.limits);
}

TEST(Verdict, NamesSoftwareWhereTheCoreWaitsForIt) {
  Subject subject(64, 48, small({"software.response_ns=1000000", "software.queue_frames=false"}));
  const Verdict verdict = subject.verdict(Thoroughness::kAll);
  EXPECT_EQ(
      verdict.sentence.rfind("software limits; software that takes no time and queues frames gives ", 0), 0U)
      << verdict.sentence;
}

TEST(Verdict, NamesTwoFifosThatHoldTogether) {
  Subject subject(64, 48, small({"streams.costs_uniqueness.depth=2", "streams.costs_consistency.depth=2"}));
  const Verdict verdict = subject.verdict(Thoroughness::kUntilCertain);
  ASSERT_TRUE(verdict.limits.limit);
  const std::string name = verdict.limits.limit_name();
  EXPECT_TRUE(name == "fifo_costs_consistency+fifo_costs_uniqueness" ||
              name == "fifo_costs_uniqueness+fifo_costs_consistency")
      << name << '\n'
      << verdict.sentence;
  EXPECT_NE(verdict.sentence.find(" limit together; depths of "), std::string::npos) << verdict.sentence;
  // Neither could have half of its tokens.
  ASSERT_EQ(verdict.limits.limit->relaxation.assignments.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    std::vector<std::string> fewer{"streams.costs_uniqueness.depth=2", "streams.costs_consistency.depth=2"};
    const std::vector<std::string>& named = verdict.limits.limit->relaxation.assignments;
    const std::string key = named[i].substr(0, named[i].find('=') + 1);
    fewer.push_back(key + std::to_string(std::stoi(named[i].substr(key.size())) / 2));
    fewer.push_back(named[1 - i]);
    EXPECT_LT(Subject(64, 48, small(fewer)).base().rate, 0.999 * verdict.limits.limit->frame_rate) << key;
  }
}

// Where software has no time of its own, the queue of frames is what it lacks.
TEST(Verdict, NamesTheQueueThatSoftwareLacks) {
  Subject subject(
      64, 48,
      exactly({"software.response_ns=0", "software.register_ns=0", "link.host_pixel_rate=0",
               "link.line_rate=10000000000", "matching.iterations=1", "clocks.core_hz=20000000"}));
  const Verdict verdict = subject.verdict(Thoroughness::kAll);
  EXPECT_EQ(verdict.sentence.find("takes no time"), std::string::npos) << verdict.sentence;
  const std::vector<RelaxedLimit>& alone = verdict.limits.alone;
  const auto software = std::find_if(alone.begin(), alone.end(), [](const RelaxedLimit& limit) {
    return limit.relaxation.is(Relief::kSoftware);
  });
  ASSERT_NE(software, alone.end());
  EXPECT_TRUE(software->gains());
  EXPECT_EQ(software->relaxation.remedy, "software that queues frames");
}

// At the core's pace, which software's time is a part of: with other cameras a faster core gains some
// percent, and software that takes none several times as much.
TEST(Verdict, NamesTheTwoThatGainMostTogether) {
  const double alone = Subject(64, 48, exactly({})).base().rate;
  Subject subject(64, 48, exactly({fmt::format("camera.frame_rate={:.2f}", alone)}));
  const Verdict verdict = subject.verdict(Thoroughness::kUntilCertain);
  EXPECT_EQ(verdict.limits.limit_name(), "camera+software") << verdict.sentence;
  ASSERT_TRUE(verdict.limits.limit);
  EXPECT_GT(verdict.limits.limit->gain, 100) << verdict.sentence;
}

TEST(Verdict, NamesTwoLimitsThatAreEqual) {
  // The host takes 1e6 / (64 * 48) = 325.52 frames/s.
  Subject subject(64, 48, small({"link.host_pixel_rate=1000000", "camera.frame_rate=325.5"}));
  for (const Thoroughness thoroughness : {Thoroughness::kUntilCertain, Thoroughness::kAll}) {
    const Verdict verdict = subject.verdict(thoroughness);
    EXPECT_EQ(verdict.limits.limit_name(), "camera+host") << verdict.sentence;
    EXPECT_EQ(verdict.sentence.rfind(
                  "camera and host limit together; cameras without limits and a host of any rate "
                  "give ",
                  0),
              0U)
        << verdict.sentence;
    ASSERT_TRUE(verdict.limits.limit);
    EXPECT_GT(verdict.limits.limit->gain, 10);
  }
}

}  // namespace verdict_test
}  // namespace parallax::test
