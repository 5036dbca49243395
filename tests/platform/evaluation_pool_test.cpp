// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/evaluation_pool.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

#include "platform/config/preset.hpp"
#include "tests/timing/machine_bench.hpp"
#include "tlm/error.hpp"

namespace parallax::test {
namespace evaluation_pool_test {

using Status = EvaluationResult::Status;

const auto kNever = [] { return false; };

// The limit of what is evaluated here: 64 x 48 pixels.
double rate_of(double pixels_per_second) { return pixels_per_second / (64 * 48); }

class Pool : public testing::Test {
 protected:
  ~Pool() override {
    EXPECT_TRUE(::waitpid(-1, nullptr, WNOHANG) == -1 && errno == ECHILD) << "a process is left";
  }

  EvaluationCase prepare(const Variant& variant) const {
    ConfigurationRequest request;
    request.assignments = {"rectification.window=9", "matching.iterations=1"};
    request.assignments.insert(request.assignments.end(), variant.assignments.begin(),
                               variant.assignments.end());
    EvaluationInput input;
    input.width = 64;
    input.height = 48;
    input.map = &map_;
    return {load_configuration(request, preset_folders()), input};
  }
  EvaluationPool::Preparation preparation() const {
    return [this](const Variant& variant, const NoticeSink&) { return prepare(variant); };
  }

  static Variant host(int pixels_per_second) {
    return {{fmt::format("link.host_pixel_rate={}", pixels_per_second)}};
  }
  static std::vector<EvaluationResult> evaluate_all(EvaluationPool& pool,
                                                    const std::vector<Variant>& variants) {
    std::vector<EvaluationResult> results;
    pool.evaluate(variants, kNever, [&](std::size_t index, EvaluationResult result) {
      EXPECT_EQ(index, results.size());
      results.push_back(std::move(result));
    });
    return results;
  }

  const EncodedMap map_ = encode(identity_map(64, 48, {9, 5}));
};

TEST_F(Pool, ResultsAreInTheOrderOfTheVariantsAndThoseOfAnyNumberOfProcesses) {
  const std::vector<Variant> variants{
      host(1'000'000), host(-1), host(2'000'000), {{"streams.left_texture.depth=8"}}, host(3'000'000)};
  std::vector<std::string> alone;
  for (const unsigned processes : {1U, 2U, 5U}) {
    EvaluationPool pool(preparation(), processes);
    const std::vector<EvaluationResult> results = evaluate_all(pool, variants);
    ASSERT_EQ(results.size(), variants.size());
    EXPECT_NEAR(results[0].rate, rate_of(1e6), 0.5) << results[0].message;
    EXPECT_EQ(results[0].limit.part, "host");
    EXPECT_EQ(timing_json(results[0])["configuration"]["link"]["host_pixel_rate"], 1'000'000);
    EXPECT_EQ(results[1].status, Status::kInvalid);
    EXPECT_NEAR(results[2].rate, rate_of(2e6), 1);
    EXPECT_EQ(results[3].status, Status::kStuck);
    EXPECT_NEAR(results[4].rate, rate_of(3e6), 2);
    std::vector<std::string> texts;
    for (EvaluationResult result : results) {
      result.metrics.group("run") = {};  // of this computer, as the next two
      result.wall_seconds = 0;
      result.processor_seconds = 0;
      texts.push_back(to_bytes(result));
    }
    if (alone.empty()) alone = texts;
    EXPECT_EQ(texts, alone) << processes;
  }
}

TEST_F(Pool, ServesSeveralRoundsAndBases) {
  EvaluationPool pool(
      [this](const Variant& variant, const NoticeSink& notice) {
        notice(fmt::format("base {}", variant.base));
        Variant whole = variant;
        whole.assignments.push_back(fmt::format("link.host_pixel_rate={}", 1'000'000 * (1 + variant.base)));
        return prepare(whole);
      },
      2);
  for (int round = 0; round < 2; ++round) {
    const std::vector<EvaluationResult> results = evaluate_all(pool, {{{}, 1}, {{}, 0}});
    ASSERT_EQ(results.size(), 2U);
    EXPECT_NEAR(results[0].rate, rate_of(2e6), 1);
    EXPECT_NEAR(results[1].rate, rate_of(1e6), 1);
    EXPECT_EQ(results[0].notes, std::vector<std::string>{"base 1"});
  }
  EXPECT_TRUE(evaluate_all(pool, {}).empty());
}

TEST_F(Pool, AProcessThatDiesIsAFailureOfItsVariantAlone) {
  EvaluationPool pool(
      [this](const Variant& variant, const NoticeSink&) {
        if (variant.base == 1) ::raise(SIGKILL);
        return prepare(variant);
      },
      2);
  std::vector<EvaluationResult> results = evaluate_all(pool, {{}, {{}, 1}, {}, {}});
  ASSERT_EQ(results.size(), 4U);
  EXPECT_EQ(results[1].status, Status::kFailed);
  EXPECT_EQ(results[1].message, "the simulation was ended by signal 9 (Killed)");
  for (const std::size_t i : {0U, 2U, 3U}) EXPECT_TRUE(results[i].done()) << results[i].message;
  results = evaluate_all(pool, {{{}, 1}, {}});
  ASSERT_EQ(results.size(), 2U);
  EXPECT_EQ(results[0].message, "the simulation was ended by signal 9 (Killed)");
  EXPECT_EQ(results[1].status, Status::kFailed);
  EXPECT_EQ(results[1].message, "no process is left");
}

TEST_F(Pool, AFaultOfThePreparationIsOfItsVariantAlone) {
  EvaluationPool pool(
      [this](const Variant& variant, const NoticeSink&) {
        if (variant.base == 1) throw UserError("not this one");
        if (variant.base == 2) throw std::runtime_error("a fault");
        return prepare(variant);
      },
      1);
  const std::vector<EvaluationResult> results = evaluate_all(pool, {{{}, 1}, {{}, 2}, {}});
  ASSERT_EQ(results.size(), 3U);
  EXPECT_EQ(results[0].status, Status::kInvalid);
  EXPECT_EQ(results[0].message, "not this one");
  EXPECT_EQ(results[1].status, Status::kFailed);
  EXPECT_EQ(results[1].message, "a fault");
  EXPECT_TRUE(results[2].done());
}

TEST_F(Pool, IsGivenUpOn) {
  EvaluationPool pool(
      [this](const Variant& variant, const NoticeSink&) {
        if (variant.base == 1) ::pause();
        return prepare(variant);
      },
      1);
  int taken = 0;
  EXPECT_EQ(pool.evaluate(
                {{}, {{}, 1}, {}}, [&taken] { return taken == 1; },
                [&taken](std::size_t, const EvaluationResult&) { ++taken; }),
            1U);
  EXPECT_EQ(taken, 1);
}

TEST_F(Pool, ServesAProcessThatHasSimulated) {
  EvaluationPool pool(preparation(), 1);
  sc_core::sc_start(1, sc_core::SC_NS);
  EXPECT_TRUE(evaluate_all(pool, {{}}).front().done());
}

}  // namespace evaluation_pool_test
}  // namespace parallax::test
