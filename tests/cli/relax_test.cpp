// SPDX-License-Identifier: Apache-2.0
// `parallax run --timing-only --relax` names the part that was made slow.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"
#include "tests/platform/temporary_folder.hpp"

namespace parallax::test {
namespace relax_test {

class Relax : public testing::Test {
 protected:
  nlohmann::json run(const std::string& arguments) {
    const Outcome outcome =
        program_("run --timing-only --relax --json " + arguments +
                 (arguments.find("--size") == std::string::npos ? " --size 64x48 -d 32" : ""));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out, nullptr, false);
  }
  std::string limit(const std::string& arguments) { return run(arguments)["limit"]; }

  Program program_;
};

TEST_F(Relax, NamesWhatWasMadeSlow) {
  // Without the software's time, so that small images show the other parts.
  const std::string alone =
      " --set software.response_ns=0 --set software.queue_frames=true --set link.host_pixel_rate=0 --set "
      "link.line_rate=1000000000000 ";
  EXPECT_EQ(limit("--set link.host_pixel_rate=1e6"), "host");
  EXPECT_EQ(limit("--set link.line_rate=1e6"), "link");
  EXPECT_EQ(limit("--set camera.frame_rate=30"), "camera");
  EXPECT_EQ(limit("--set camera.bytes_per_second=1e6"), "camera");
  EXPECT_EQ(limit("--set software.response_ns=100000000"), "software");
  EXPECT_EQ(limit(alone + "--set matching.interval=64"), "matching_interval");
  EXPECT_EQ(limit(alone + "--set matching.recurrence_latency=64"), "matching_interval");
  EXPECT_EQ(limit(alone + "--set clocks.core_hz=1e6"), "core_clock");
  EXPECT_EQ(
      limit(alone + "--set memory.model=bus --set memory.bytes_per_cycle=1 --set clocks.memory_hz=10e6"),
      "memory");
  EXPECT_EQ(limit("--size 320x240 -d 64 --set streams.left_texture.depth=64"), "fifo_left_texture");
}

TEST_F(Relax, ASecondBufferGainsWhatSendingTakes) {
  const nlohmann::json tree =
      run("--set software.response_ns=0 --set link.host_pixel_rate=0 --set link.line_rate=260e6 "
          "--set link.output_buffers=1 --set clocks.core_hz=20e6");
  for (const auto& entry : tree["relaxations"]) {
    if (entry["name"] == "buffers") {
      EXPECT_GT(entry["gain"]["value"], 10) << entry;
    }
  }
}

TEST_F(Relax, GainsAreSortedAndThoseOfRunsWithTheKeysSet) {
  const nlohmann::json tree = run("--set link.host_pixel_rate=1e6");
  double before = 1e9;
  for (const auto& entry : tree["relaxations"]) {
    const double gain = entry["gain"]["value"];
    EXPECT_LE(gain, before);
    before = gain;
    std::string sets;
    for (const std::string set : entry["set"]) sets += " --set " + set;
    if (entry["name"] != "host" && entry["name"] != "memory") continue;
    const Outcome again =
        program_("run --timing-only --json --size 64x48 -d 32 --set link.host_pixel_rate=1e6" + sets);
    EXPECT_EQ(nlohmann::json::parse(again.out)["performance"]["frame_rate"]["value"],
              entry["frame_rate"]["value"]);
  }
}

// The memory is taken away whatever was said of its devices.
TEST_F(Relax, TakesAMemoryAwayWhoseDevicesWereSet) {
  for (const char* devices : {"--set memory.device=ddr4-2400-x64", "--set dram.bus_bytes=2"}) {
    const nlohmann::json tree = run(devices);
    const auto memory = std::find_if(tree["relaxations"].begin(), tree["relaxations"].end(),
                                     [](const nlohmann::json& entry) { return entry["name"] == "memory"; });
    ASSERT_NE(memory, tree["relaxations"].end()) << devices;
    EXPECT_TRUE(memory->contains("gain")) << devices << ": " << memory->dump();
  }
}

TEST_F(Relax, TextAndFile) {
  const TemporaryFolder folder;
  const Outcome outcome =
      program_("run --timing-only --relax --size 64x48 -d 32 --set link.host_pixel_rate=1e6 --out " +
               (folder / "out"));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("limit               host\n"), std::string::npos) << outcome.out;
  EXPECT_EQ(nlohmann::json::parse(folder.read("out/relaxations.json"))["limit"], "host");
  EXPECT_EQ(program_("run -q --timing-only --relax --size 64x48 -d 32").out, "");
}

TEST_F(Relax, AMachineThatGetsStuckHasNoLimits) {
  const Outcome outcome =
      program_("run --timing-only --relax --size 64x48 -d 32 --set streams.left_texture.depth=8");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("streams.left_texture.depth = "), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.out, "");
}

TEST_F(Relax, OptionsThatDoNotGoTogether) {
  EXPECT_EQ(program_("run --relax").err, "parallax: error: --relax needs --timing-only\n");
  EXPECT_EQ(program_("run --timing-only --relax --set matching.p3=1").code, 2);
}

// The sentence of an ordinary run, and its numbers.
class Verdict : public testing::Test {
 protected:
  nlohmann::json limit(const std::string& arguments) const {
    const Outcome outcome = program_("run --timing-only --json --size 64x48 -d 32 " + arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return nlohmann::json::parse(outcome.out)["limit"];
  }
  Program program_;
};

TEST_F(Verdict, SaysWhatTakingTheLimitAwayGives) {
  const nlohmann::json host = limit("--set link.host_pixel_rate=1e6");
  EXPECT_EQ(host["relaxation"]["value"], "host");
  const Outcome freed =
      program_("run --timing-only --json --no-verdict --size 64x48 -d 32 --set link.host_pixel_rate=0");
  const nlohmann::json tree = nlohmann::json::parse(freed.out);
  EXPECT_EQ(host["relaxed_frame_rate"]["value"], tree["performance"]["frame_rate"]["value"]);
  EXPECT_EQ(host["relaxed_part"]["value"], tree["limit"]["part"]["value"]);
  EXPECT_FALSE(tree["limit"].contains("verdict"));
  const double rate = tree["performance"]["frame_rate"]["value"];
  EXPECT_EQ(
      host["verdict"]["value"],
      fmt::format("host limits at 100.0 %; a host of any rate gives {:.2f} fps, then core limits", rate));
}

TEST_F(Verdict, LooksOnWhereTheBusiestPartGainsNothing) {
  // One buffer each: nothing is busy all the time, and the software's time counts.
  const nlohmann::json none = limit("--set camera.frame_buffers=1 --set link.output_buffers=1");
  EXPECT_EQ(none["part"]["value"], "none");
  EXPECT_EQ(none["relaxation"]["value"], "software");
  EXPECT_EQ(none["verdict"]["value"].get<std::string>().rfind(
                "software limits; software that takes no time and queues frames gives ", 0),
            0u);
}

TEST_F(Verdict, ASingleFrameHasNone) { EXPECT_EQ(limit("--timing-frames 1"), nullptr); }

TEST_F(Verdict, AndTheSummaryFitsAScreen) {
  const Outcome outcome = program_("run --size 96x64 -d 32");
  const std::vector<std::string> all = lines(outcome.out);
  EXPECT_LE(all.size(), 40u);
  for (const std::string& line : all) EXPECT_LE(line.size(), 120u) << line;
  EXPECT_NE(outcome.out.find("\nverdict             "), std::string::npos) << outcome.out;
}

}  // namespace relax_test
}  // namespace parallax::test
