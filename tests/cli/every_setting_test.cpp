// SPDX-License-Identifier: Apache-2.0
// Every setting that is allowed ends: with results, or with one line that says why it has none.
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <random>

#include "platform/config/configuration.hpp"
#include "platform/config/schema.hpp"
#include "tests/cli/program.hpp"

namespace parallax {
namespace every_setting_test {

class EverySetting : public ::testing::Test {
 protected:
  // Of a run of the time alone, which may take half a minute of the processor's.
  test::Outcome run(const std::string& settings) const {
    return program_("run --timing-only --no-verdict -q --size 64x48 " + settings, [] {
      const rlimit limit{30, 30};
      ::setrlimit(RLIMIT_CPU, &limit);
    });
  }
  void expect_end(const std::string& settings) const {
    const test::Outcome outcome = run(settings);
    EXPECT_TRUE(outcome.code == 0 || outcome.code == 1 || outcome.code == 2)
        << settings << ": " << outcome.code;
    if (outcome.code == 2) {
      EXPECT_EQ(test::lines(outcome.err).size(), 1U) << settings << outcome.err;
    }
  }
  std::string error(const std::string& settings) const {
    const test::Outcome outcome = run(settings);
    EXPECT_EQ(outcome.code, 2) << settings;
    return outcome.err;
  }

  test::Program program_;
};

struct Ends {
  std::string key;
  std::vector<std::string> values;
};

std::vector<Ends> keys_with_ranges() {
  MachineConfig machine;
  Schema schema;
  describe(schema, machine);
  std::vector<Ends> keys;
  for (const Key& key : schema.keys()) {
    if (key.type == KeyType::kInteger)
      keys.push_back({key.path, {std::to_string(key.integers.least), std::to_string(key.integers.most)}});
    if (key.type == KeyType::kReal)
      keys.push_back({key.path, {std::to_string(key.reals.least), std::to_string(key.reals.most)}});
  }
  return keys;
}

std::string setting(const std::string& key, const std::string& value) {
  return " --set " + key + "=" + value + (key.rfind("dram.", 0) == 0 ? " --set memory.model=dram" : "");
}

TEST_F(EverySetting, AtBothEndsOfItsRangeEnds) {
  const std::vector<Ends> keys = keys_with_ranges();
  EXPECT_GT(keys.size(), 100U);
  // The sanitizer makes a run ten times as long, and looks at the program's memory, not at its end.
  const std::size_t step = test::sanitized() ? 10 : 1;
  for (std::size_t i = 0; i < keys.size(); i += step) {
    for (const std::string& value : keys[i].values)
      expect_end("--timing-frames 2" + setting(keys[i].key, value));
  }
}

TEST_F(EverySetting, SeveralAtTheEndsOfTheirRangesEnd) {
  const std::vector<Ends> keys = keys_with_ranges();
  std::minstd_rand random(7);
  for (int i = 0; i < (test::sanitized() ? 10 : 60); ++i) {
    std::string settings = "--timing-frames 2";
    for (int k = 0; k < 3; ++k) {
      const Ends& key = keys[random() % keys.size()];
      settings += setting(key.key, key.values[random() % key.values.size()]);
    }
    expect_end(settings);
  }
}

TEST_F(EverySetting, WhatHappensAnHourLaterIsReached) {
  for (const char* blanking : {"1047", "1048", "1049", "1000000"}) {
    const test::Outcome outcome =
        run("--timing-frames 2 --json --set clocks.camera_hz=1 --set camera.frame_blanking=" +
            std::string(blanking));
    EXPECT_EQ(outcome.code, 0) << blanking << outcome.err;
  }
}

TEST_F(EverySetting, WhatTakesLongerThanTimeHoldsIsOneLine) {
  EXPECT_EQ(error("--timing-frames 900 --set clocks.core_hz=1"),
            "parallax: error: after 53.4 days simulated time is over, 53.4 is the most that it holds; "
            "simulate fewer "
            "frames (--frames, --timing-frames), or make the machine faster (clocks.*)\n");
  EXPECT_EQ(error("--set clocks.camera_hz=1 --set camera.frame_blanking=1000000000"),
            "parallax: error: camera would take 11574.1 days for a frame, 26.7 are the most that simulated "
            "time holds "
            "(clocks.camera_hz, camera.row_blanking, camera.frame_blanking, camera.bytes_per_second)\n");
  EXPECT_NE(
      error("--set link.line_rate=1 --set link.packet_payload_bytes=1 --set link.packet_wire_bytes=65536")
          .find("link would take 46603.4 days for a frame"),
      std::string::npos);
  const test::Outcome swept =
      program_("run --timing-only --size 64x48 -d 32 --timing-frames 900 --vary clocks.core_hz=1,1e8");
  EXPECT_EQ(swept.code, 1);
  EXPECT_NE(swept.out.find("simulated time is over"), std::string::npos) << swept.out;
}

TEST_F(EverySetting, DevicesThatNeverReadARowAreRefused) {
  for (const char* key : {"rcd", "rfc", "rp", "ras", "rc", "faw", "rrd", "wr"}) {
    const std::string line = error(setting("dram." + std::string(key), "4160"));
    EXPECT_EQ(line.rfind("parallax: error: dram.refi = 4160: must be 0 or more than ", 0), 0U) << key << line;
    expect_end(setting("dram." + std::string(key), "4160") + " --set dram.refi=0");
    expect_end(setting("dram." + std::string(key), "3800"));
  }
}

TEST_F(EverySetting, WhatWillTakeLongSaysHowLong) {
  if (test::sanitized()) GTEST_SKIP() << "how long is another matter there";
  const pid_t child =
      program_.start("run --timing-only --no-verdict --size 64x48 -d 32 --timing-frames 100000000");
  ::sleep(7);
  ::kill(child, SIGTERM);
  const test::Outcome outcome = program_.wait(child);
  EXPECT_EQ(outcome.code, 143);
  EXPECT_EQ(outcome.err.rfind("parallax: note: about ", 0), 0U) << outcome.err;
  EXPECT_NE(outcome.err.find(" minutes to go, "), std::string::npos) << outcome.err;
}

}  // namespace every_setting_test
}  // namespace parallax
