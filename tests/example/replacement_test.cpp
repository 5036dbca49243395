// SPDX-License-Identifier: Apache-2.0
// Other blocks in the place of a stage, between the same streams.
#include <gtest/gtest.h>

#include "modules/output_packing_stage.hpp"
#include "tests/example/late_census.hpp"
#include "tests/example/machine_run.hpp"

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

StageFactory clocked_census(const MachineConfig& config) {
  return [&config](const std::string& name, const StageContext& context) {
    auto block = std::make_unique<ClockedCensus>(name.c_str(), config.census, context);
    SlotModule slot;
    slot.look_ahead = block->look_ahead();
    slot.module = std::move(block);
    return slot;
  };
}

TEST(Replacement, ABlockInKernelTimeGivesTheSameValues) {
  const MachineConfig config = small_machine();
  const StageFactory clocked = clocked_census(config);
  const MachineRun usual = run_machine(config);
  const MachineRun other = run_machine(config, {{"census", clocked}});
  ASSERT_EQ(usual.fault, "");
  ASSERT_EQ(other.fault, "");
  EXPECT_EQ(other.disparities, usual.disparities);
  // It looks almost a row further ahead, which is refilled once a frame.
  EXPECT_LE(other.period, usual.period + kWidth);
}

// A row is several bursts: the first ones are due before the stages behind the block, which work on whole
// rows, have their values.
TEST(Replacement, ABlockInKernelTimeMayBeBehindWithItsValues) {
  const MachineConfig config = small_machine({"dma.output.burst_bytes=16"});
  const MachineRun usual = run_machine(config);
  const MachineRun other = run_machine(config, {{"census", clocked_census(config)}});
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
  EXPECT_EQ(run_machine(config, {{"census", clocked_census(config)}}).fault,
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

}  // namespace replacement_test
}  // namespace parallax::test
