// SPDX-License-Identifier: Apache-2.0
// Tokens and values that a block in the place of a stage loses, or has too many of: each is reported.
#include <gtest/gtest.h>

#include <cstdint>
#include <regex>
#include <string>

#include "modules/matching_stage.hpp"
#include "tests/example/faulty_census.hpp"
#include "tests/example/machine_run.hpp"

namespace parallax::test {
namespace lost_tokens_test {

constexpr const char* kReport = "/parallax/machine/tokens";

// Codes are grey values.
MachineConfig without_census() {
  return small_machine({"census.enabled=false", "matching.cost=absolute_difference"});
}

std::string fault_of(const StageFactory& census) {
  return run_machine(without_census(), {{"census", census}}).fault;
}

// The text of a report without type, file and line.
std::string report_of(const StageFactory& census) {
  const std::string fault = fault_of(census);
  const std::string begin = std::string("Error: ") + kReport + ": ";
  if (fault.rfind(begin, 0) != 0) return fault;
  return fault.substr(begin.size(), fault.find('\n') - begin.size());
}

TEST(LostTokens, BlocksThatLoseNoneAreNotReported) {
  const MachineRun usual = run_machine(without_census());
  for (const StageFactory& census : {faulty_stage(0, 0, {}), faulty_thread({}), faulty_thread({}, 3, 3)}) {
    const MachineRun run = run_machine(without_census(), {{"census", census}});
    EXPECT_EQ(run.fault, "");
    EXPECT_EQ(run.disparities, usual.disparities);
  }
}

// What the report saves from: with it switched off, a lost token moves every pixel behind it, and the run
// ends as if all were well.
TEST(LostTokens, NothingElseWouldShowThem) {
  const MachineRun usual = run_machine(without_census());
  const StageFactory losing = faulty_thread({1, 100, false});
  const StageFactory silent = [losing](const std::string& name, const StageContext& context) {
    sc_core::sc_report_handler::set_actions(kReport, sc_core::SC_DO_NOTHING);
    return losing(name, context);
  };
  const MachineRun run = run_machine(without_census(), {{"census", silent}});
  EXPECT_EQ(run.fault, "");
  EXPECT_NE(run.disparities, usual.disparities);
}

TEST(LostTokens, AScheduleOfATokenTooFewOrTooManyIsRefused) {
  const std::string slot = "what stands in the slot census: its schedule ";
  EXPECT_EQ(fault_of(faulty_stage(0, -1, {})),
            slot + "writes 4607 tokens of a frame to left_codes, which has 4608: row 47 has 95 of 96 tokens");
  EXPECT_EQ(fault_of(faulty_stage(0, 1, {})),
            slot + "writes 4609 tokens of a frame to left_codes, which has 4608");
  EXPECT_EQ(
      fault_of(faulty_stage(-97, 0, {})),
      slot + "reads 4511 tokens of a frame from left_rectified, which has 4608: row 46 has 95 of 96 tokens");
}

TEST(LostTokens, ValuesOfAStageAreCounted) {
  EXPECT_EQ(
      report_of(faulty_stage(0, 0, {2, 4607, false})),
      "what stands in the slot census has handed over 4607 of the 4608 values of frame 2: row 47 has 95 "
      "of 96 tokens, at stream left_codes");
  EXPECT_EQ(
      report_of(faulty_stage(0, 0, {0, 17, false})),
      "what stands in the slot census has handed over 4607 of the 4608 values of frame 0: row 47 has 95 "
      "of 96 tokens, at stream left_codes");
  EXPECT_EQ(report_of(faulty_stage(0, 0, {1, 4607, true})),
            "what stands in the slot census hands over more than the 4608 values of frame 1, at stream "
            "left_codes");
}

TEST(LostTokens, TokensOfABlockInKernelTimeAreCounted) {
  EXPECT_EQ(report_of(faulty_thread({1, 100, false})),
            "what stands in the slot census has written 4607 of the 4608 tokens of frame 1 when it reads one "
            "of frame 2: row 47 has 95 of 96 tokens; 0 may be on their way (SlotModule::latency), at stream "
            "left_codes");
  EXPECT_EQ(report_of(faulty_thread({1, 100, true})),
            "what stands in the slot census writes more than the 4608 tokens of frame 1, before it reads one "
            "of frame 2, at stream left_codes");
}

TEST(LostTokens, NothingComesBeforeWhatItIsMadeOf) {
  EXPECT_EQ(report_of(faulty_thread({}, 0, 0, true)),
            "what stands in the slot census writes a token before it has read one, at stream left_codes");
  const StageFactory early = [](const std::string& name, const StageContext& context) {
    return slot_module(std::make_unique<FaultyCensusStage>(name.c_str(), context, context.tokens(),
                                                           context.tokens(), CensusFault{}, true));
  };
  EXPECT_EQ(report_of(early),
            "what stands in the slot census hands over values before it has got any, at stream left_codes");
}

// What is held over is in order if the block's latency says so.
TEST(LostTokens, WhatIsOnItsWayFollowsFromTheLatency) {
  EXPECT_EQ(report_of(faulty_thread({}, 3, 2)),
            "what stands in the slot census has written 4605 of the 4608 tokens of frame 0 when it reads one "
            "of frame 1: row 47 has 93 of 96 tokens; 2 may be on their way (SlotModule::latency), at stream "
            "left_codes");
}

// A matcher whose tokens carry groups of another size than those of the machine.
std::string fault_of_groups(std::uint32_t parallelism) {
  const MachineConfig config = small_machine();
  MatchingConfig matching = config.matching;
  matching.parallelism = parallelism;
  const StageFactory factory = [&](const std::string& name, const StageContext& context) {
    return slot_module(std::make_unique<MatchingStage>(name.c_str(), matching, config.census.code_bits(),
                                                       config.timing.matching, context));
  };
  const std::string fault = run_machine(config, {{"matching", factory}}).fault;
  return fault.substr(0, fault.find('\n'));
}

TEST(LostTokens, GroupsOfAnotherSizeAreReported) {
  const std::string begin = std::string("Error: ") + kReport + ": what stands in the slot matching ";
  // When it is noticed depends on how far dates run ahead of values, not what is said then.
  const std::string few = fault_of_groups(8);
  const std::regex text(
      "(.*)has handed over (\\d+) values for the first (\\d+) tokens of frame 0, which have 32 each: row "
      "(\\d+) has (\\d+) of 384 tokens, at stream costs_subpixel");
  std::smatch found;
  ASSERT_TRUE(std::regex_match(few, found, text)) << few;
  EXPECT_EQ(found[1], begin);
  const int values = std::stoi(found[2]);
  EXPECT_EQ(values % (8 * 384), 0) << "whole rows, of groups of 8";
  EXPECT_EQ(std::stoi(found[3]), values / 32 + 1) << "the first that it has too few values for";
  EXPECT_EQ(std::stoi(found[4]) * 384 + std::stoi(found[5]), values / 32);
  EXPECT_EQ(fault_of_groups(32), "");
  EXPECT_EQ(fault_of_groups(64), begin +
                                     "hands over more than the 589824 values of frame 0, 32 a token, at "
                                     "stream costs_subpixel");
}

}  // namespace lost_tokens_test
}  // namespace parallax::test
