// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/trial_pool.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <sstream>

#include "platform/commands/command_context.hpp"
#include "platform/commands/interruption.hpp"
#include "platform/config/preset.hpp"

namespace parallax::test {
namespace trial_pool_test {

TEST(TrialPool, GivesUpAtItsEnd) {
  std::ostringstream out, err;
  CommandContext context{out, err, CommandLine(0, nullptr)};
  const Interruption interruption;
  const ConfigurationRequest request;
  const MachineConfig config = load_configuration(request, preset_folders()).machine;
  const EncodedMap map = encode(identity_map(64, 48, config.rectification.range));
  EvaluationInput input;
  input.width = map.width;
  input.height = map.height;
  input.map = &map;
  TrialPool pool(request, input, context, interruption);
  EXPECT_EQ(pool.evaluate({{}, {}}).size(), 2U);
  const auto now = std::chrono::steady_clock::now();
  pool.end_at(now + std::chrono::hours(1));
  EXPECT_EQ(pool.evaluate({{}}).size(), 1U);
  pool.end_at(now);
  EXPECT_TRUE(pool.evaluate({{}, {}}).empty());
}

}  // namespace trial_pool_test
}  // namespace parallax::test
