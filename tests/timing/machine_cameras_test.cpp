// SPDX-License-Identifier: Apache-2.0
// Cameras that expose, that are out of step, and that lose rows; a core and a link that begin early.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

#include "platform/registers/core_driver.hpp"
#include "tests/cli/program.hpp"
#include "tests/platform/error_of.hpp"
#include "tests/timing/in_child.hpp"
#include "tests/timing/machine_bench.hpp"

namespace parallax::test {
namespace machine_cameras_test {

constexpr int kWidth = 160;
constexpr int kHeight = 64;
constexpr std::int64_t kFrames = 12;

struct Outcome {
  std::vector<double> exposed, first_byte, startable, in_memory, first_disparity, results_in_memory,
      at_host;  // s
  std::int64_t taken = 0, faulty = 0, dropped = 0;
  std::uint32_t errors = 0;  // the register
  std::string error;
};

Outcome run(const std::vector<std::string>& assignments) {
  std::istringstream in(in_child([&] {
    std::ostringstream out;
    out.precision(15);
    const std::string error = error_of([&] {
      const MachineConfig config = preset(assignments);
      const EncodedMap map = encode(lens_map(kWidth, kHeight, config.rectification.range));
      MachineInput input;
      input.width = kWidth;
      input.height = kHeight;
      input.map = &map;
      input.frames = kFrames;
      input.timing_only = true;
      Machine machine("machine", config, input);
      CoreDriver driver("driver");
      driver.socket.bind(machine.registers().socket);
      sc_core::sc_start();
      for (std::size_t i = 0; i < kFrames; ++i) {
        const FrameTimes& t = machine.times()[i];
        for (const sc_core::sc_time& time : {t.exposed, t.first_byte, t.startable, t.in_memory,
                                             t.first_disparity, t.results_in_memory, t.at_host}) {
          out << time.to_seconds() << " ";
        }
      }
      const CameraCounts& counts = machine.snapshots().back().cameras;
      out << counts.taken << " " << counts.faulty << " " << counts.dropped << " "
          << machine.registers().get("dma", "input_errors", "short_frame") +
                 2 * machine.registers().get("dma", "input_errors", "missing_row") +
                 4 * machine.registers().get("dma", "input_errors", "out_of_step") +
                 (machine.registers().get("dma", "input_errors", "frames") << 16);
    });
    return error == "(no error)" ? out.str() : "! " + error;
  }));
  Outcome o;
  if (in.peek() == '!') {
    in.ignore(2);
    std::getline(in, o.error);
    return o;
  }
  for (std::int64_t i = 0; i < kFrames; ++i) {
    for (std::vector<double>* dates : {&o.exposed, &o.first_byte, &o.startable, &o.in_memory,
                                       &o.first_disparity, &o.results_in_memory, &o.at_host}) {
      double date = -1;
      in >> date;
      dates->push_back(date);
    }
  }
  in >> o.taken >> o.faulty >> o.dropped >> o.errors;
  return o;
}

double least_period(const std::vector<double>& dates) {
  double least = 1e9;
  for (std::size_t i = 1; i < dates.size(); ++i) least = std::min(least, dates[i] - dates[i - 1]);
  return least;
}

constexpr double kCycle = 20e-9;

TEST(MachineCameras, AFaultyFrameIsFlaggedAndTheNextOneIsProcessed) {
  const std::vector<std::pair<std::string, std::uint32_t>> faults{
      {"short_frame", 1}, {"missing_row", 2}, {"out_of_step", 4}};
  for (const auto& [fault, bit] : faults) {
    for (const char* rate : {"camera.frame_rate=0", "camera.frame_rate=500"}) {
      const Outcome o = run({"camera.fault=" + fault, "camera.fault_every=3", rate});
      EXPECT_EQ(o.error, "");
      EXPECT_GT(o.at_host.back(), 0) << fault;
      // Two good frames, then a faulty one; the last exposures may be under way.
      EXPECT_GE(o.faulty, (kFrames - 1) / 2) << fault;
      EXPECT_NEAR(static_cast<double>(o.faulty), static_cast<double>(o.taken) / 2, 1.0);
      EXPECT_EQ(o.errors & 0xFFFFu, bit);
      EXPECT_EQ(o.errors >> 16, static_cast<std::uint32_t>(o.faulty));
    }
  }
}

TEST(MachineCameras, AFaultIsFoundWhateverItsExtent) {
  EXPECT_EQ(run({"camera.fault=short_frame", "camera.fault_rows=63"}).errors & 0xFFFFu, 1u);
  EXPECT_EQ(run({"camera.fault=missing_row", "camera.fault_rows=62"}).errors & 0xFFFFu, 2u);
  EXPECT_EQ(run({"camera.fault=short_frame", "camera.format=rgb8"}).errors & 0xFFFFu, 1u);
  EXPECT_EQ(run({"camera.fault=out_of_step", "camera.skew_limit_ns=0"}).errors & 0xFFFFu, 4u);
  // Within the limit, the images are in step, and the fault is another one.
  EXPECT_EQ(run({"camera.fault=missing_row", "camera.skew_ns=900000"}).errors & 0xFFFFu, 2u);
}

TEST(MachineCameras, FaultsTakeTheirTriggers) {
  const Outcome good = run({"camera.frame_rate=300"});
  const Outcome faulty = run({"camera.frame_rate=300", "camera.fault=missing_row", "camera.fault_every=2"});
  EXPECT_EQ(good.faulty, 0);
  EXPECT_NEAR(good.exposed[5] - good.exposed[4], 1 / 300.0, kCycle);
  EXPECT_NEAR(faulty.exposed[5] - faulty.exposed[4], 2 / 300.0, kCycle);
}

TEST(MachineCameras, TheLaterImageCompletesTheFrame) {
  const Outcome together = run({"camera.frame_rate=300"});
  const Outcome apart = run({"camera.frame_rate=300", "camera.skew_ns=50000"});
  for (std::size_t i = 0; i < kFrames; ++i) {
    EXPECT_NEAR(apart.in_memory[i] - together.in_memory[i], 50e-6, 200e-9);
    EXPECT_NEAR(apart.first_byte[i], together.first_byte[i], 200e-9);
  }
}

TEST(MachineCameras, ExposureLimitsTheRateOfCamerasOnDemand) {
  const double read_out = least_period(run({"link.enabled=false"}).exposed);
  ASSERT_LT(read_out, 0.5e-3);
  EXPECT_NEAR(least_period(run({"camera.exposure_ns=1000000"}).exposed), 1e-3, kCycle);
  EXPECT_NEAR(least_period(run({"camera.exposure_ns=1000000", "camera.overlap=false"}).exposed),
              1e-3 + read_out, 2e-6);
}

TEST(MachineCameras, ExposureMustFitIntoThePeriod) {
  EXPECT_EQ(run({"camera.exposure_ns=3000000", "camera.frame_rate=300"}).error, "");
  EXPECT_EQ(
      run({"camera.exposure_ns=3400000", "camera.frame_rate=300"}).error,
      "camera.frame_rate = 300: reading out 160x64 px takes 14336 pixel clocks, with 3400000 ns of exposure "
      "beside it 272000, which allows at most 294.12 frames/s");
  EXPECT_EQ(
      run({"camera.exposure_ns=3200000", "camera.frame_rate=300", "camera.overlap=false"}).error,
      "camera.frame_rate = 300: reading out 160x64 px takes 14336 pixel clocks, with 3200000 ns of exposure "
      "before it 270336, which allows at most 295.93 frames/s");
}

// A row of 160 bytes is through a cable of 20 MB/s after 8 us, though its pixels took the sensor 2 us; half a
// row after half of that.
TEST(MachineCameras, ASlowCableBringsARowsBytesOverTheWholeRow) {
  const std::vector<std::string> slow{"camera.bytes_per_second=20000000", "camera.early_start_rows=1",
                                      "dma.camera.burst_bytes=80", "dma.camera.data_bits=64"};
  const Outcome o = run(slow);
  ASSERT_EQ(o.error, "");
  EXPECT_NEAR(o.startable[0] - o.exposed[0], 8e-6, 400e-9);
  EXPECT_NEAR(o.first_byte[0] - o.exposed[0], 4e-6, 400e-9);
  std::vector<std::string> fast = slow;
  fast[0] = "camera.bytes_per_second=1000000000";
  const Outcome quick = run(fast);
  EXPECT_NEAR(quick.startable[0] - quick.exposed[0], 2e-6, 400e-9);
  EXPECT_NEAR(quick.first_byte[0] - quick.exposed[0], 1e-6, 400e-9);
}

TEST(MachineCameras, TheCoreBeginsEarly) {
  const Outcome whole = run({});
  const Outcome early = run({"camera.early_start_rows=8"});
  const double read_out = whole.in_memory[0] - whole.exposed[0];
  EXPECT_EQ(whole.startable[0], whole.in_memory[0]);
  EXPECT_NEAR(early.startable[0] - early.exposed[0], read_out * 8 / kHeight, read_out / 10);
  EXPECT_NEAR(early.in_memory[0], whole.in_memory[0], 1e-6);  // the core reads beside the cameras by then
  EXPECT_LT(early.first_disparity[0], whole.first_disparity[0]);
  EXPECT_LT(early.results_in_memory[0], whole.results_in_memory[0]);
  // It cannot be done before the last row is there.
  const Outcome at_once = run({"camera.early_start_rows=1", "software.response_ns=0"});
  EXPECT_GT(at_once.results_in_memory[0], whole.in_memory[0]);
  // All rows, or more, is the whole frame.
  EXPECT_EQ(run({"camera.early_start_rows=64"}).at_host, whole.at_host);
  EXPECT_EQ(run({"camera.early_start_rows=9999"}).at_host, whole.at_host);
}

TEST(MachineCameras, TheLinkBeginsEarly) {
  for (const char* tiles : {"tiles.limit=1024", "tiles.limit=128"}) {
    const std::vector<std::string> common{"tiles.disparities_in_margin=false", tiles,
                                          "link.host_pixel_rate=0"};
    std::vector<std::string> rows = common;
    rows.emplace_back("link.early_start_rows=4");
    const Outcome whole = run(common);
    const Outcome early = run(rows);
    EXPECT_LT(early.at_host[0], whole.at_host[0]);
    EXPECT_GT(early.at_host[0], early.results_in_memory[0]);
    EXPECT_DOUBLE_EQ(early.first_disparity[0], whole.first_disparity[0]);
    std::vector<std::string> all = common;
    all.emplace_back("link.early_start_rows=64");
    EXPECT_EQ(run(all).at_host, whole.at_host);
  }
}

// An exposure before the model's time begins keeps no trigger from the sensors.
TEST(MachineCameras, TheFirstExposureMayBeginBeforeTheRun) {
  const test::Outcome outcome = test::Program()(
      "run --timing-only --json --size 64x48 --set camera.frame_rate=60 --set camera.exposure_ns=1000 "
      "--set camera.overlap=false");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["camera"]["missed_triggers"]["value"], 0);
}

}  // namespace machine_cameras_test
}  // namespace parallax::test
