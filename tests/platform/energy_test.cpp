// SPDX-License-Identifier: Apache-2.0
// The energy estimate: activity times its price, by hand, and the activity of a run, by its own report.
#include "platform/results/energy.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"

namespace parallax {
namespace energy_test {

double joules(const EnergyEstimate& estimate, const std::string& name) {
  const auto found = std::find_if(estimate.parts.begin(), estimate.parts.end(),
                                  [&](const EnergyEstimate::Part& part) { return part.name == name; });
  EXPECT_NE(found, estimate.parts.end()) << name;
  return found == estimate.parts.end() ? 0 : found->joules;
}

// Two frames in half a second.
EnergyActivity some_activity() {
  EnergyActivity activity;
  activity.seconds = 0.5;
  activity.frames = 2;
  activity.census_bits = 3e9;
  activity.path_updates = 5e9;
  activity.stage_bits = 7e9;
  activity.core_cycles = 1e8;
  activity.on_chip_bytes = 4e9;
  activity.memory_bytes = 64e6;
  activity.link_bits = 2e8;
  activity.camera_bytes = 3e7;
  return activity;
}

EnergyConfig round_prices() {
  EnergyConfig config;
  config.census_bit_pj = 2;
  config.path_update_pj = 10;
  config.stage_bit_pj = 1;
  config.core_cycle_pj = 500;
  config.on_chip_byte_pj = 5;
  config.dram_bit_pj = 25;
  config.dram_activate_nj = 4;
  config.dram_access_bytes = 32;
  config.dram_row_hits = 75;
  config.dram_background_w = 0.2;
  config.link_bit_pj = 50;
  config.link_w = 0.6;
  config.camera_byte_pj = 200;
  config.camera_interface_w = 0.8;
  config.static_w = 0.4;
  config.processor_w = 1.6;
  config.supply_efficiency = 80;
  return config;
}

// Only what moves costs something.
EnergyConfig no_background() {
  EnergyConfig config;
  for (double* power : {&config.dram_background_w, &config.link_w, &config.camera_interface_w,
                        &config.static_w, &config.processor_w}) {
    *power = 0;
  }
  return config;
}

TEST(Energy, EveryPartByHand) {
  const EnergyEstimate estimate = estimate_energy(round_prices(), some_activity());
  EXPECT_NEAR(joules(estimate, "matcher"), 0.006 + 0.05, 1e-12);
  EXPECT_NEAR(joules(estimate, "stages"), 0.007, 1e-12);
  EXPECT_NEAR(joules(estimate, "clock"), 0.05, 1e-12);
  EXPECT_NEAR(joules(estimate, "on_chip_memory"), 0.02, 1e-12);
  // Half a second of 0.2 W; 2 million accesses, of which a quarter opens a row; 512 Mbit.
  EXPECT_NEAR(joules(estimate, "memory"), 0.1 + 0.002 + 0.0128, 1e-12);
  EXPECT_NEAR(joules(estimate, "link"), 0.3 + 0.01, 1e-12);
  EXPECT_NEAR(joules(estimate, "cameras"), 0.4 + 0.006, 1e-12);
  EXPECT_NEAR(joules(estimate, "static"), 0.2, 1e-12);
  EXPECT_NEAR(joules(estimate, "processor"), 0.8, 1e-12);
  // A quarter of the 1.9638 J that the other parts take.
  EXPECT_NEAR(joules(estimate, "supply"), 0.49095, 1e-12);
  EXPECT_NEAR(estimate.joules(), 2.45475, 1e-12);
  EXPECT_NEAR(estimate.watts(estimate.joules()), 4.9095, 1e-12);
  EXPECT_NEAR(estimate.millijoules_per_frame(estimate.joules()), 1227.375, 1e-9);
}

TEST(Energy, WithoutALinkItTakesNone) {
  EnergyActivity activity = some_activity();
  activity.link = false;
  EXPECT_EQ(joules(estimate_energy(round_prices(), activity), "link"), 0);
}

TEST(Energy, RowHitsSaveActivatesAlone) {
  EnergyConfig config = no_background();
  config.dram_bit_pj = 0;
  config.dram_row_hits = 0;
  const double none = joules(estimate_energy(config, some_activity()), "memory");
  EXPECT_NEAR(none, 2e6 * 5e-9, 1e-12);
  config.dram_row_hits = 90;
  EXPECT_NEAR(joules(estimate_energy(config, some_activity()), "memory"), none / 10, 1e-12);
  config.dram_row_hits = 100;
  EXPECT_EQ(joules(estimate_energy(config, some_activity()), "memory"), 0);
}

// Each kind of activity costs its part in proportion, and no other part but the converters.
RC_GTEST_PROP(Energy, IsLinearInEachActivity, ()) {
  struct Kind {
    double EnergyActivity::*field;
    const char* part;
  };
  const std::vector<Kind> kinds{{&EnergyActivity::census_bits, "matcher"},
                                {&EnergyActivity::path_updates, "matcher"},
                                {&EnergyActivity::stage_bits, "stages"},
                                {&EnergyActivity::core_cycles, "clock"},
                                {&EnergyActivity::on_chip_bytes, "on_chip_memory"},
                                {&EnergyActivity::memory_bytes, "memory"},
                                {&EnergyActivity::link_bits, "link"},
                                {&EnergyActivity::camera_bytes, "cameras"}};
  const Kind kind = *rc::gen::elementOf(kinds);
  const double factor = *rc::gen::inRange(2, 1000);
  EnergyActivity activity;
  activity.seconds = 1;
  activity.frames = 1;
  activity.*kind.field = *rc::gen::inRange(1, 1'000'000'000);
  const EnergyEstimate once = estimate_energy(no_background(), activity);
  activity.*kind.field *= factor;
  const EnergyEstimate more = estimate_energy(no_background(), activity);
  for (std::size_t i = 0; i < once.parts.size(); ++i) {
    const double before = once.parts[i].joules;
    const double after = more.parts[i].joules;
    const bool concerned = once.parts[i].name == kind.part || once.parts[i].name == "supply";
    RC_ASSERT(concerned == (before > 0));
    RC_ASSERT(std::abs(after - factor * before) <= 1e-9 * after);
  }
}

class EnergyReport : public ::testing::Test {
 protected:
  static constexpr double kPixels = 64 * 48;

  nlohmann::json run(const std::string& arguments = "", const std::string& disparities = "32") const {
    const test::Outcome outcome =
        program_("run --timing-only -q --json --size 64x48 -d " + disparities + " " + arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out, nullptr, false);
  }
  static double value(const nlohmann::json& tree, const std::string& path) {
    return tree.at(nlohmann::json::json_pointer("/" + path + "/value")).get<double>();
  }
  // What a constant power costs, in mJ a frame.
  static double per_frame(const nlohmann::json& tree, double watts) {
    return 1e3 * watts / value(tree, "performance/frame_rate");
  }

  test::Program program_;
};

TEST_F(EnergyReport, HasEveryPartWithUnitAndDescriptionAndTheirSum) {
  for (const char* arguments : {"", "--timing-frames 1", "--set link.enabled=false"}) {
    SCOPED_TRACE(arguments);
    const nlohmann::json energy = run(arguments)["energy"];
    for (const std::string kind : {"power_", "frame_"}) {
      double sum = 0;
      for (const char* part : {"matcher", "stages", "clock", "on_chip_memory", "memory", "link", "cameras",
                               "static", "processor", "supply"}) {
        const nlohmann::json& metric = energy.at(kind + part);
        sum += metric["value"].get<double>();
        EXPECT_EQ(metric["unit"], kind == "power_" ? "W" : "mJ");
        EXPECT_EQ(metric["description"].get<std::string>().rfind("Estimate of ", 0), 0U) << metric;
        EXPECT_FALSE(metric["window"].get<std::string>().empty());
      }
      const double total = energy.at(kind + "total")["value"];
      EXPECT_GT(total, 0);
      EXPECT_NEAR(sum, total, 1e-9 * total);
    }
    EXPECT_EQ(energy.size(), 22U);
  }
}

TEST_F(EnergyReport, TheMatcherByHand) {
  const double census = kPixels * 24 * 0.1e-9;  // mJ a disparity
  const double path = kPixels * 3.4e-9;         // mJ a disparity and path
  EXPECT_NEAR(value(run(), "energy/frame_matcher"), 32 * (census + 4 * path), 1e-9);
  EXPECT_NEAR(value(run("", "128"), "energy/frame_matcher"), 128 * (census + 4 * path), 1e-9);
  EXPECT_NEAR(value(run("--set matching.paths=n"), "energy/frame_matcher"), 32 * (census + path), 1e-9);
  // A second pass compares the codes again.
  EXPECT_NEAR(value(run("--set matching.paths=n,s"), "energy/frame_matcher"), 32 * (2 * census + 2 * path),
              1e-9);
}

TEST_F(EnergyReport, TilesCountWhatTheyShare) {
  // Two tiles of 48 columns, the left margin of which holds the disparities.
  const nlohmann::json tree =
      run("--set tiles.limit=48 --set tiles.left_margin=0 --set tiles.right_margin=0 "
          "--set tiles.disparities_in_margin=false --set tiles.largest_number=2");
  const nlohmann::json margins =
      run("--set tiles.limit=48 --set tiles.left_margin=16 --set tiles.right_margin=16 "
          "--set tiles.disparities_in_margin=false --set tiles.largest_number=2");
  EXPECT_NEAR(value(margins, "energy/frame_matcher"), value(tree, "energy/frame_matcher") * 96 / 64, 1e-9);
}

TEST_F(EnergyReport, MemoryLinkAndCamerasByTheBytesReported) {
  const nlohmann::json tree = run();
  double bytes = 0;
  for (const char* port : {"camera_left", "camera_right", "left", "right", "map", "output", "link"}) {
    bytes += value(tree, std::string("memory/") + port + "/bytes_per_frame");
  }
  EXPECT_NEAR(value(tree, "energy/frame_memory"),
              per_frame(tree, 0.15) + bytes * 8 * 20e-9 + value(tree, "memory/activates") * 5e-6, 1e-9);
  const nlohmann::json bus = run("--set memory.model=bus");
  EXPECT_NEAR(value(bus, "energy/frame_memory"),
              per_frame(bus, 0.15) + bytes * 8 * 20e-9 + bytes / 32 / 4 * 5e-6, 1e-9);
  const double cameras =
      value(tree, "memory/camera_left/bytes_per_frame") + value(tree, "memory/camera_right/bytes_per_frame");
  EXPECT_NEAR(value(tree, "energy/frame_cameras"), per_frame(tree, 1.0) + cameras * 100e-9, 1e-9);
  // 2.5 bytes a pixel in packets of 1468 with 70 bytes around each.
  const double wire = 8 * (2.5 * kPixels + 6 * 70);
  EXPECT_NEAR(value(tree, "energy/frame_link"), per_frame(tree, 0.6) + wire * 20e-9, 1e-7);
  EXPECT_NEAR(value(tree, "energy/power_clock"), 0.188, 1e-9);
  EXPECT_NEAR(value(tree, "energy/power_static"), 0.3, 1e-9);
  EXPECT_NEAR(value(tree, "energy/power_processor"), 1.5, 1e-9);
  EXPECT_NEAR(value(tree, "energy/power_supply"), 0.15 * value(tree, "energy/power_total"), 1e-9);
}

TEST_F(EnergyReport, OnChipMemoryAndStagesByTheWidthsReported) {
  const nlohmann::json tree = run("", "64");
  const double map_words = std::ceil(value(tree, "memory/map/bytes_per_frame") / 8);
  double fifo_bits = 0;
  for (const auto& [name, stream] : tree["streams"].items()) {
    if (name.find("bursts") != std::string::npos) continue;  // at a memory port
    const double tokens = name == "map_words"            ? map_words
                          : name.rfind("costs_", 0) == 0 ? 2 * kPixels
                                                         : kPixels;
    fifo_bits += tokens * stream["width"]["value"].get<double>();
  }
  double storage = 0;
  for (const auto& [name, stage] : tree["stages"].items()) storage += stage["storage"]["value"].get<double>();
  double memory_bytes = 0;
  for (const auto& [name, port] : tree["memory"].items()) {
    if (port.contains("bytes_per_frame")) memory_bytes += port["bytes_per_frame"]["value"].get<double>();
  }
  const double bytes = 2 * (fifo_bits / 8 + storage / 8 * 48 + memory_bytes);
  EXPECT_NEAR(value(tree, "energy/frame_on_chip_memory"), bytes * 2.5e-9, 1e-9);
  const double codes = 2 * 24 * kPixels;  // what the matcher reads
  EXPECT_NEAR(value(tree, "energy/frame_stages"), (fifo_bits - codes) * 0.2e-9, 1e-9);
}

TEST_F(EnergyReport, OneFrameTakesTheTimeUntilTheHostHasIt) {
  const nlohmann::json tree = run("--timing-frames 1");
  const double milliseconds = 1e3 * value(tree, "run/simulated_time");
  EXPECT_NEAR(value(tree, "energy/frame_processor"), 1.5 * milliseconds, 1e-9);
  EXPECT_NEAR(value(tree, "energy/frame_matcher"), value(run(), "energy/frame_matcher"), 1e-12);
}

TEST_F(EnergyReport, PricesChangeNoDate) {
  nlohmann::json dear = run("--set energy.processor_w=3 --set energy.path_update_pj=7");
  nlohmann::json tree = run();
  EXPECT_NE(dear["energy"], tree["energy"]);
  for (const char* group : {"performance", "latency", "stages", "streams", "memory"}) {
    EXPECT_EQ(dear[group], tree[group]) << group;
  }
}

TEST_F(EnergyReport, TheSummarySaysThatItIsAnEstimate) {
  const test::Outcome outcome = program_("run --timing-only --size 64x48 -d 32 -v");
  EXPECT_NE(outcome.out.find(" W estimated, "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("energy on_chip_memory "), std::string::npos) << outcome.out;
}

TEST_F(EnergyReport, PricesOutOfRangeAreRefused) {
  const auto error = [&](const std::string& assignment) {
    const test::Outcome outcome = program_("run --timing-only --set " + assignment);
    EXPECT_EQ(outcome.code, 2);
    return outcome.err;
  };
  EXPECT_NE(error("energy.supply_efficiency=0").find("energy.supply_efficiency"), std::string::npos);
  EXPECT_NE(error("energy.dram_row_hits=101").find("energy.dram_row_hits"), std::string::npos);
  EXPECT_NE(error("energy.link_w=-1").find("energy.link_w"), std::string::npos);
}

}  // namespace energy_test
}  // namespace parallax
