// SPDX-License-Identifier: Apache-2.0
// The machine with a filter of one's own, added as the guide says: its files and one line.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "platform/config/filter_of.hpp"
#include "platform/registers/parameter_member.hpp"
#include "tests/example/ends.hpp"
#include "tests/example/fill_from_below.hpp"
#include "tests/example/fill_from_left_keys.hpp"
#include "tests/example/machine_run.hpp"

namespace parallax::test {
namespace own_filter_test {

TEST(OwnFilter, RunsInTheMachineAtFullRate) {
  const MachineConfig config = small_machine();
  MachineConfig with_filter = config;
  with_filter.add(filter<FillFromLeft, FillFromLeftConfig>("fill_from_left"));
  const MachineRun without = run_machine(config);
  const MachineRun with = run_machine(with_filter);
  ASSERT_EQ(without.fault, "");
  ASSERT_EQ(with.fault, "");
  const auto expected = filtered<FillFromLeft>(FillFromLeftConfig{}, without.disparities);
  EXPECT_EQ(with.disparities, expected);
  EXPECT_NE(with.disparities, without.disparities);
  EXPECT_EQ(with.period, without.period);
  EXPECT_EQ(with.first, without.first + 1 + 1);  // its latency, and the FIFO before it
  EXPECT_EQ(with.left_output, without.left_output + 1 + 2);
}

TEST(OwnFilter, WithALookAheadOfThreeRowsRunsAtFullRateToo) {
  const MachineConfig config = small_machine();
  MachineConfig with_filter = config;
  with_filter.add(filter<FillFromBelow, FillFromBelowConfig>("fill_from_below"));
  const MachineRun without = run_machine(config);
  const MachineRun with = run_machine(with_filter);
  ASSERT_EQ(without.fault, "");
  ASSERT_EQ(with.fault, "");
  EXPECT_EQ(with.disparities, filtered<FillFromBelow>(FillFromBelowConfig{}, without.disparities));
  EXPECT_EQ(with.period, without.period);
  EXPECT_EQ(with.left_output, without.left_output + 3 * kWidth + 1 + 2);
}

TEST(OwnFilter, HasKeysForItsFunctionItsTimeAndItsStream) {
  MachineConfig config;
  config.add(filter<FillFromLeft, FillFromLeftConfig>("fill_from_left", {7}, {1, 5, 0, 0}));
  Schema schema;
  describe(schema, config);
  const auto value = [&](const char* key) { return std::get<std::int64_t>(schema.find(key)->get()); };
  EXPECT_EQ(value("fill_from_left.reach"), 7);
  EXPECT_EQ(value("fill_from_left.latency"), 5);
  EXPECT_EQ(value("streams.fill_from_left_out.depth"), 0);
}

TEST(OwnFilter, IsCopiedWithTheConfigurationThatItIsAPartOf) {
  MachineConfig config;
  config.add(filter<FillFromLeft, FillFromLeftConfig>("fill_from_left"));
  MachineConfig copy = config;
  copy.filters.all().back()->timing(copy).latency = 9;
  EXPECT_EQ(config.filters.all().back()->timing(config).latency, 1u);
}

TEST(OwnFilter, CanHaveARunTimeParameter) {
  constexpr ParameterMember kReach = filter_member<FillFromLeftConfig, &FillFromLeftConfig::reach>();
  MachineConfig config;
  EXPECT_THROW(kReach.get(config), std::logic_error);
  config.add(filter<FillFromLeft, FillFromLeftConfig>("fill_from_left"));
  MachineConfig next = config;
  kReach.set(next, 1);
  EXPECT_EQ(kReach.get(next), 1);
  EXPECT_EQ(kReach.get(config), 4);

  // Four frames of one row: as built, changed, as before, and back.
  const ClockDomain clock("clock", Hertz(100'000'000));
  Dataflow dataflow("dataflow");
  const DisparityFilter::Made made =
      config.filters.all().back()->make("fill", config, {clock, dataflow, kWidth, 1});
  const std::vector<const MachineConfig*> changes{&config, &next, nullptr, &config};
  for (const MachineConfig* change : changes) made.follow(change);
  std::vector<Disparity> row(kWidth);
  row[0] = {100, Cause::kMatched};
  Source source("source", row, Sending::kRows, 4);
  Sink sink("sink", clock);
  const FifoConfig fifo{2, Bits(kDisparityBits)};
  Stream<Disparity> in("in", dataflow, clock, clock, fifo), out("out", dataflow, clock, clock, fifo);
  source.out(in);
  made.stage->in_disparity(in);
  made.stage->out_disparity(out);
  sink.in(out);
  sc_core::sc_start();
  ASSERT_EQ(sink.values.size(), 4 * row.size());
  const auto filled = [&](int frame) {
    const auto begin = sink.values.begin() + frame * kWidth;
    return std::count(begin, begin + kWidth, Disparity{100, Cause::kInterpolated});
  };
  EXPECT_EQ(filled(0), 4);
  EXPECT_EQ(filled(1), 1);
  EXPECT_EQ(filled(2), 1);
  EXPECT_EQ(filled(3), 4);
}

}  // namespace own_filter_test
}  // namespace parallax::test
