// SPDX-License-Identifier: Apache-2.0
// What a run of the usual length calls steady is what a long run finds.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "platform/evaluation/evaluation_pool.hpp"
#include "tests/timing/random_machine.hpp"

namespace parallax::test {
namespace steady_state_test {

constexpr std::int64_t kLong = 600;  // frames

/// A random machine, and variants of it whose cameras or host keep nearly its pace.
class Subject {
 public:
  explicit Subject(std::uint32_t seed) : case_(random_machine(seed, Contention::kAny)), random_(1000 + seed) {
    const bool dram = seed % 2 == 0;
    for (const std::string& assignment : case_.assignments()) {
      const bool of_bus = assignment.rfind("memory.model", 0) == 0 ||
                          assignment.rfind("clocks.memory_hz", 0) == 0 ||
                          assignment.rfind("memory.bytes_per_cycle", 0) == 0;
      if (!dram || !of_bus) assignments_.push_back(assignment);
    }
    assignments_.insert(assignments_.end(), {"image.width_granularity=1", "image.height_granularity=1",
                                             fmt::format("camera.frame_buffers={}", number(1, 12)),
                                             fmt::format("link.output_buffers={}", number(1, 8))});
    map_ = encode(lens_map(case_.width, case_.height, preset(assignments_).rectification.range));
  }

  /// Each variant in a run of the usual length and in a long one, one after the other.
  std::vector<EvaluationResult> run() {
    EvaluationPool pool([this](const Variant& variant, const NoticeSink&) {
      ConfigurationRequest request;
      request.assignments = assignments_;
      request.changes = variant.assignments;
      EvaluationCase one{load_configuration(request, {source_path("platform/presets")}), {}};
      one.input.width = case_.width;
      one.input.height = case_.height;
      one.input.map = &map_;
      if (variant.base == 1) one.input.timing_frames = kLong;
      return one;
    });
    const auto evaluate = [&pool](const std::vector<Variant>& variants) {
      std::vector<EvaluationResult> results;
      pool.evaluate(
          variants, [] { return false; },
          [&](std::size_t, EvaluationResult result) { results.push_back(std::move(result)); });
      return results;
    };
    const EvaluationResult base = evaluate({{{}, 0}}).front();
    if (!base.done()) return {};
    constexpr double kOff[] = {-0.03, -0.005, -0.001, -0.0002, 0.0002, 0.001, 0.005, 0.03};
    const double rate = base.rate * (1 + kOff[number(0, 7)]);
    const std::string cameras = fmt::format("camera.frame_rate={}", rate);
    const std::string jitter =
        fmt::format("camera.jitter_ns={}", number(1, std::max(2, static_cast<int>(2e7 / rate))));
    const std::string host =
        fmt::format("link.host_pixel_rate={:.0f}", std::ceil(rate * case_.width * case_.height));
    variants_ = {{}, {cameras}, {cameras, jitter}, {host}};
    std::vector<Variant> all;
    for (const std::vector<std::string>& changes : variants_) {
      all.push_back({changes, 0});
      all.push_back({changes, 1});
    }
    return evaluate(all);
  }

  std::string text(std::size_t variant) const {
    return fmt::format("{}with {}\n", case_.text(), fmt::join(variants_[variant], " "));
  }

 private:
  int number(int low, int high) {
    return low + static_cast<int>(random_() % static_cast<unsigned>(high - low + 1));
  }

  MachineCase case_;
  std::mt19937 random_;
  std::vector<std::string> assignments_;
  EncodedMap map_;
  std::vector<std::vector<std::string>> variants_;
};

double off(double value, double truth) { return 100 * std::abs(value / truth - 1); }

TEST(SteadyState, IsThatOfALongRunOrSaidNotToBe) {
  int compared = 0, steady = 0, alarms = 0;
  for (std::uint32_t seed = 1; seed <= (sanitized() ? 2U : 5U); ++seed) {
    Subject subject(seed);
    const std::vector<EvaluationResult> results = subject.run();
    for (std::size_t i = 0; i + 1 < results.size(); i += 2) {
      const EvaluationResult& usual = results[i];
      const EvaluationResult& longer = results[i + 1];
      if (!usual.done() || !longer.done()) continue;
      ++compared;
      const std::string& said = usual.metrics.word("steady/established");
      const double rate = off(usual.rate, longer.rate);
      const double latency = off(usual.latency.exposure_to_host, longer.latency.exposure_to_host);
      if (said == "yes") {
        ++steady;
        EXPECT_LE(rate, 1) << "seed " << seed << ": " << subject.text(i / 2);
        EXPECT_LE(latency, 1) << "seed " << seed << ": " << subject.text(i / 2);
      }
      if (said == "no" && rate < 0.3 && latency < 0.3) ++alarms;
    }
  }
  if (sanitized()) return;
  EXPECT_GE(compared, 16);
  EXPECT_GE(steady, compared / 3);
  EXPECT_LE(alarms, compared / 20);
}

}  // namespace steady_state_test
}  // namespace parallax::test
