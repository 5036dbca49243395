// SPDX-License-Identifier: Apache-2.0
// A Verilated SystemC module at pins in the machine: the values and every date are the stage's.
#include "tests/cosim/verilated_census.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "modules/census_stage.hpp"
#include "tests/example/machine_run.hpp"

namespace parallax::test {
namespace verilated_census_rtl_test {

constexpr std::uint64_t kLatency = 6;  // of PinCensus, too
constexpr std::uint64_t kLookAhead = 2 * kWidth + 2;

TEST(VerilatedCensus, HasTheStagesValuesAndDates) {
  for (const char* kind : {"registered", "first_word_fall_through", "block_ram"}) {
    std::vector<std::string> assignments{fmt::format("census.latency={}", kLatency),
                                         "census.border=\"replicate\""};
    for (const char* name : {"left_rectified", "right_rectified", "left_codes", "right_codes"})
      assignments.push_back(fmt::format("streams.{}.kind=\"{}\"", name, kind));
    const MachineConfig config = small_machine(assignments);
    MachineInput input;
    input.bind_stage("census", [](const std::string& name, const StageContext& context) {
      return slot_module(std::make_unique<VerilatedCensus>(name.c_str(), context, kLatency, kLookAhead));
    });
    const MachineRun stage = run_machine(config);
    const MachineRun circuit = run_machine(config, input.replacements);
    ASSERT_EQ(stage.fault, "");
    ASSERT_EQ(circuit.fault, "");
    EXPECT_EQ(circuit.disparities, stage.disparities);
    EXPECT_NE(circuit.census_dates, 0u);
    EXPECT_EQ(circuit.census_dates, stage.census_dates) << kind;
    EXPECT_EQ(circuit.period, stage.period);
    EXPECT_EQ(circuit.first, stage.first);
    EXPECT_EQ(circuit.left_texture, stage.left_texture);
    EXPECT_EQ(circuit.left_output, stage.left_output);
  }
}

}  // namespace verilated_census_rtl_test
}  // namespace parallax::test
