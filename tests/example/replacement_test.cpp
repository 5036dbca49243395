// SPDX-License-Identifier: Apache-2.0
// Other blocks in the place of a stage, between the same streams.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "modules/output_packing_stage.hpp"
#include "tests/example/census_circuit.hpp"
#include "tests/example/late_census.hpp"
#include "tests/example/machine_run.hpp"
#include "tlm/error.hpp"

namespace parallax::test {
namespace replacement_test {

TEST(Replacement, AVariantOfAStageGivesTheSameValuesLater) {
  const MachineConfig config = small_machine();
  const auto latency = config.timing.census.latency + 50;
  const MachineRun usual = run_machine(config);
  const MachineRun other = run_machine(config, {{"census", [&](const std::string& name, const auto& context) {
                                                   return slot_module(std::make_unique<LateCensus>(
                                                       name.c_str(), config.census, latency, context));
                                                 }}});
  ASSERT_EQ(usual.fault, "");
  ASSERT_EQ(other.fault, "");
  EXPECT_EQ(other.disparities, usual.disparities);
  EXPECT_EQ(other.period, usual.period);
  EXPECT_EQ(other.first, usual.first + 50);
  EXPECT_EQ(other.left_texture, usual.left_texture + 50);
  EXPECT_EQ(other.left_output, usual.left_output + 50);
}

StageReplacements census_at_pins(const MachineConfig& config) {
  MachineInput input;
  input.bind_stage("census", [&config](const std::string& name, const StageContext& context) {
    return slot_module(std::make_unique<CensusAtPins>(name.c_str(), config.census, context, kFrames));
  });
  return input.replacements;
}

// A stage with the circuit's look-ahead and its one register: the pins add nothing.
TEST(Replacement, ACircuitAtPinsGivesTheSameValuesAtTheDatesOfSuchAStage) {
  for (const char* kind : {"registered", "first_word_fall_through"}) {
    std::vector<std::string> kinds;
    for (const char* name : {"left_rectified", "right_rectified", "left_codes", "right_codes"})
      kinds.push_back(fmt::format("streams.{}.kind=\"{}\"", name, kind));
    const MachineConfig config = small_machine(kinds);
    const MachineRun usual = run_machine(config);
    const MachineRun stage =
        run_machine(config, {{"census", [&](const std::string& name, const auto& context) {
                                return slot_module(
                                    std::make_unique<LateCensus>(name.c_str(), config.census, 1, context, 1));
                              }}});
    const MachineRun pins = run_machine(config, census_at_pins(config), 0);
    ASSERT_EQ(usual.fault, "");
    ASSERT_EQ(pins.fault, "");
    EXPECT_EQ(pins.disparities, usual.disparities);
    EXPECT_NE(pins.census_dates, 0u);
    EXPECT_NE(pins.census_dates, usual.census_dates);
    EXPECT_EQ(pins.census_dates, stage.census_dates);
    EXPECT_EQ(pins.period, stage.period);
    EXPECT_EQ(pins.first, stage.first);
    EXPECT_EQ(pins.left_texture, stage.left_texture);
    EXPECT_EQ(pins.left_output, stage.left_output);
    // It looks almost a row further ahead, which is refilled once a frame.
    EXPECT_LE(pins.period, usual.period + kWidth);
  }
}

// A row is several bursts: the first ones are due before the stages behind the block, which work on whole
// rows, have their values.
TEST(Replacement, ACircuitAtPinsMayBeBehindWithItsValues) {
  const MachineConfig config = small_machine({"dma.output.burst_bytes=16"});
  const MachineRun usual = run_machine(config);
  const MachineRun other = run_machine(config, census_at_pins(config), 0);
  ASSERT_EQ(other.fault, "");
  EXPECT_EQ(other.disparities, usual.disparities);
}

TEST(Replacement, TheLastStageIsReplacedLikeTheOthers) {
  const MachineConfig config = small_machine();
  const StageFactory packing = [&](const std::string& name, const StageContext& context) {
    const OutputPackingConfig whole_rows{
        Bytes(config.dma.output.burst_bytes), config.link.output_left(), {{0, kWidth}}};
    return slot_module(std::make_unique<OutputPackingStage>(name.c_str(), whole_rows, context));
  };
  const MachineRun usual = run_machine(config);
  const MachineRun other = run_machine(config, {{"output_packing", packing}});
  ASSERT_EQ(other.fault, "");
  EXPECT_EQ(other.disparities, usual.disparities);
  EXPECT_EQ(other.period, usual.period);
}

TEST(Replacement, AStageMayHaveTwoSidesAndTokensOfSeveralPixels) {
  MachineConfig config = small_machine();
  config.timing.overlap_frames = true;
  config.timing.pixels_per_token = 2;
  const MachineRun usual = run_machine(config);
  const MachineRun other = run_machine(
      config, {{"census", [&](const std::string& name, const auto& context) {
                  return slot_module(std::make_unique<LateCensus>(name.c_str(), config.census, 50, context));
                }}});
  ASSERT_EQ(other.fault, "");
  EXPECT_EQ(other.disparities, usual.disparities);
  EXPECT_EQ(other.disparities, run_machine(small_machine()).disparities);
  EXPECT_EQ(run_machine(config, census_at_pins(config), 0).fault,
            "what stands in the slot census works in kernel time, value by value: pipeline.pixels_per_token "
            "must be "
            "1");
}

TEST(Replacement, WhatHasNoSlotOrNotItsPortsIsReported) {
  const MachineConfig config = small_machine();
  const StageFactory census = [&](const std::string& name, const StageContext& context) {
    return slot_module(std::make_unique<LateCensus>(name.c_str(), config.census, 4, context));
  };
  EXPECT_EQ(run_machine(config, {{"censor", census}}).fault, "the pipeline has no slot censor");
  EXPECT_EQ(run_machine(config, {{"subpixel", census}}).fault,
            "what stands in the slot subpixel has no port in_costs for the tokens there");
  EXPECT_EQ(run_machine(config, {{"output_packing", census}}).fault,
            "what stands in the slot output_packing has no port out_bursts for the tokens there");
}

TEST(Replacement, AStageIsBoundOnceAndToSomething) {
  const auto refusal = [](MachineInput& input, StageFactory make) -> std::string {
    try {
      input.bind_stage("census", std::move(make));
    } catch (const UserError& e) {
      return e.what();
    }
    return "";
  };
  MachineInput input;
  const StageFactory census = [](const std::string&, const StageContext&) { return SlotModule(); };
  EXPECT_EQ(refusal(input, {}), "stage 'census': nothing is given to stand in its place");
  EXPECT_EQ(refusal(input, census), "");
  EXPECT_EQ(refusal(input, census), "stage 'census': something stands in its place already");
}

}  // namespace replacement_test
}  // namespace parallax::test
