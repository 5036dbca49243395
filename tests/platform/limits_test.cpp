// SPDX-License-Identifier: Apache-2.0
// What limits the machine, and that the steady state is one: by the program, on small frames.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

#include "platform/results/limits.hpp"
#include "tests/cli/program.hpp"

namespace parallax {
namespace limits_test {

class Limits : public ::testing::Test {
 protected:
  nlohmann::json run(const std::string& arguments) const {
    const test::Outcome outcome = program_("run --json --no-verdict --disparities 32 " + arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const nlohmann::json tree = nlohmann::json::parse(outcome.out);
    if (!tree.contains("limit")) return tree;
    for (const auto& [part, metric] : tree["limit"]["utilisation_by_part"].items()) {
      EXPECT_GE(metric["value"].get<double>(), 0.0) << part << ' ' << arguments;
      EXPECT_LE(metric["value"].get<double>(), 100.0) << part << ' ' << arguments;
    }
    EXPECT_LE(tree["memory"]["share"]["value"].get<double>(), 100.0) << arguments;
    return tree;
  }
  static std::string limit(const nlohmann::json& tree) { return tree["limit"]["part"]["value"]; }
  static double rate(const nlohmann::json& tree) { return tree["performance"]["frame_rate"]["value"]; }

  test::Program program_;
};

TEST_F(Limits, CamerasThatAreTooFastLimitNothing) {
  // The machine alone reaches 2,700 frames/s and more.
  const std::string size = "--size 64x48 --timing-only ";
  const double alone = rate(run(size));
  for (const double faster : {1.002, 1.05, 1.5}) {
    const nlohmann::json tree = run(size + fmt::format("--set camera.frame_rate={}", alone * faster));
    EXPECT_NEAR(rate(tree), alone, alone * 1e-3);
    EXPECT_EQ(limit(tree).rfind("camera", 0), std::string::npos) << faster;
  }
  EXPECT_EQ(limit(run(size + fmt::format("--set camera.frame_rate={}", alone * 0.9))), "camera_frame_rate");
}

// Each frame that the cameras send comes through, so their rate is the machine's, wherever jitter has moved
// the first arrival and the last.
TEST_F(Limits, JitterDoesNotMoveTheRateOfCamerasThatLoseNothing) {
  for (const char* jitter : {"3000000", "9000000"}) {
    const nlohmann::json tree = run(fmt::format(
        "--size 64x48 --timing-only --set camera.frame_rate=100 --set camera.jitter_ns={}", jitter));
    EXPECT_EQ(tree["camera"]["dropped_frames"]["value"], 0);
    EXPECT_EQ(tree["camera"]["missed_triggers"]["value"], 0);
    EXPECT_NEAR(rate(tree), 100, 1e-5) << jitter;
    EXPECT_EQ(limit(tree), "camera_frame_rate");
    EXPECT_NEAR(tree["limit"]["utilisation"]["value"].get<double>(), 100, 1e-5);
  }
}

TEST_F(Limits, FramesThatFailAreMeasuredOverMany) {
  const std::string size = "--size 64x48 --timing-only --set camera.frame_rate=100 ";
  EXPECT_NEAR(rate(run(size + "--set camera.fault=missing_row")), 90, 0.01);
  EXPECT_NEAR(rate(run(size + "--set camera.fault=out_of_step --set camera.fault_every=4")), 75, 0.01);
}

TEST_F(Limits, ASingleFramesBytesAreItsOwn) {
  const nlohmann::json tree = run("--size 64x48 --timing-only --timing-frames 1");
  EXPECT_EQ(tree["memory"]["camera_left"]["bytes_per_frame"]["value"], 64 * 48);
  EXPECT_EQ(tree["memory"]["left"]["bytes_per_frame"]["value"], 64 * 48);
  EXPECT_EQ(tree["memory"]["output"]["bytes_per_frame"]["value"], 64 * 48 * 5 / 2);
}

TEST_F(Limits, TheLimitingPartIsNamed) {
  EXPECT_EQ(limit(run("--size 64x48 --set link.host_pixel_rate=1e6")), "host");
  EXPECT_EQ(limit(run("--size 64x48 --set link.line_rate=1e6")), "link");
  EXPECT_EQ(limit(run("--size 64x48 --set clocks.camera_hz=1e6")), "camera");
  EXPECT_EQ(limit(run("--size 64x48 --set camera.frame_rate=30")), "camera_frame_rate");
  EXPECT_EQ(
      limit(run(
          "--size 64x48 --set memory.model=bus --set memory.bytes_per_cycle=1 --set clocks.memory_hz=20e6 "
          "--set software.queue_frames=true")),
      "memory");
  EXPECT_EQ(limit(run("--size 256x192 --disparities 256 --set link.host_pixel_rate=0")), "core");
  EXPECT_EQ(
      limit(run(
          "--size 256x192 --disparities 256 --set link.host_pixel_rate=0 --set software.queue_frames=true")),
      "matching");
  EXPECT_EQ(
      limit(run(
          "--size 64x48 --set dma.left.burst_bytes=8 --set dma.left.outstanding=1 "
          "--set memory.latency_cycles=2000 --set link.host_pixel_rate=0 --set software.queue_frames=true")),
      "dma_left");
  // The core counts as at work while it waits for the memory, or for the rows of a frame that comes.
  EXPECT_EQ(limit(run("--size 160x128 --timing-only --set memory.model=bus --set memory.bytes_per_cycle=1 "
                      "--set clocks.memory_hz=100e6")),
            "memory");
  EXPECT_EQ(limit(run("--size 160x128 --timing-only --set camera.bytes_per_second=5000000 "
                      "--set camera.early_start_rows=1 --set camera.skew_ns=300000")),
            "camera");
  EXPECT_EQ(
      limit(run(
          "--size 64x48 --timing-only --set software.response_ns=20000000 --set software.queue_frames=true")),
      "software");
  const nlohmann::json buffers = run("--size 64x48 --set camera.frame_buffers=1 --set link.output_buffers=1");
  EXPECT_EQ(limit(buffers), "none");
  EXPECT_NE(buffers["limit"]["key"]["value"].get<std::string>().find("camera.frame_buffers"),
            std::string::npos);
}

TEST_F(Limits, RatesEqualHandCalculation) {
  // 3072 pixels at 1 Mpx/s; 3072 * 2.5 bytes in packets of 1468 with 70 bytes around them at 1 Mbit/s.
  EXPECT_NEAR(rate(run("--size 64x48 --set link.host_pixel_rate=1e6")), 1e6 / 3072, 0.01);
  EXPECT_NEAR(rate(run("--size 64x48 --set link.line_rate=1e6")), 1e6 / (8 * (7680 + 6 * 70)), 1e-3);
  EXPECT_NEAR(rate(run("--size 64x48 --set camera.frame_rate=30")), 30, 1e-3);
  // 48 rows of 64 pixels and 32 of blanking, and 2048 after the frame.
  EXPECT_NEAR(rate(run("--size 64x48 --set clocks.camera_hz=1e6")), 1e6 / (48 * 96 + 2048), 1e-3);
}

// 48 rows of 64 pixels and 32 of blanking a pixel clock each, or as long as the cable needs for a row.
TEST_F(Limits, FormatsTakeTheCableAsLongAsTheirBytes) {
  for (const auto& [format, bytes] :
       {std::pair{"mono8", 64.0}, std::pair{"bayer8", 64.0}, std::pair{"mono12_packed", 96.0},
        std::pair{"mono12", 128.0}, std::pair{"rgb8", 192.0}}) {
    const nlohmann::json tree =
        run(std::string("--size 64x48 --set clocks.camera_hz=1e6 --set camera.bytes_per_second=1e6 "
                        "--set camera.format=") +
            format);
    EXPECT_NEAR(rate(tree), 1e6 / (48 * std::max(96.0, bytes) + 2048), 0.01) << format;
    EXPECT_EQ(tree["memory"]["camera_left"]["bytes_per_frame"]["value"], 48 * bytes) << format;
    EXPECT_EQ(tree["memory"]["right"]["bytes_per_frame"]["value"], 48 * bytes) << format;
  }
}

// 4.5 bytes a pixel: a VGA image with 128 disparities is bound by the network (hardware.md 3), a small one
// here.
TEST_F(Limits, ColourOutputTakesTheLinkLonger) {
  const std::string colour = "--size 64x48 --set link.color_output=true ";
  EXPECT_NEAR(rate(run(colour + "--set link.line_rate=1e6")), 1e6 / (8 * (64 * 48 * 4.5 + 10 * 70)), 1e-3);
  EXPECT_NEAR(rate(run(colour + "--set link.host_pixel_rate=1e6")), 1e6 / 3072, 0.01);
  const nlohmann::json tree = run("--size 640x480 --set link.color_output=true");
  EXPECT_EQ(limit(tree), "link");
  EXPECT_NEAR(rate(tree), 1e9 / (8 * (640 * 480 * 4.5 + 942 * 70)), 0.01);
  EXPECT_EQ(tree["memory"]["output"]["bytes_per_frame"]["value"], 640 * 480 * 4.5);
}

// The matcher alone: 64 * 48 pixels of 3 iterations.
TEST_F(Limits, TheRecurrenceHoldsUpEveryPixel) {
  const std::string matcher = "--size 64x48 -d 96 --set matching.interval=2 ";
  const auto cycles = [&](const std::string& more) {
    return run(matcher + more)["stages"]["matching"]["cycles_per_frame"]["value"].get<double>();
  };
  EXPECT_EQ(cycles(""), 64 * 48 * 6);
  EXPECT_EQ(cycles("--set matching.recurrence_latency=2"), 64 * 48 * 6);
  EXPECT_EQ(cycles("--set matching.recurrence_latency=7"), 64 * 48 * (2 * 2 + 7));
  // With the minimum first, the latency counts from the pixel's first iteration.
  const std::string first =
      "--set matching.recurrence_order=minimum_first --set matching.recurrence_latency=";
  for (const int latency : {1, 5, 6, 7, 11, 40}) {
    EXPECT_EQ(cycles(first + std::to_string(latency)), 64 * 48 * std::max(6, latency)) << latency;
  }
}

// Stages, memory, cameras and link around the core have time to spare.
TEST_F(Limits, OverlappingFramesLoseNothingBetweenThem) {
  const std::string core = "--preset core-alone --rectified --timing-only --set clocks.core_hz=113130000 ";
  const std::string published = core + "--size 1024x768 --set pipeline.overlap_frames=true ";
  EXPECT_NEAR(rate(run(published)), 113.13e6 / (1024 * 768), 1e-4);
  EXPECT_LT(rate(run(core + "--size 1024x768")), 142.0);

  const std::string small = core + "--size 64x48 --set gap_interpolation.enabled=false ";
  const auto period = [&](const std::string& more) { return 113.13e6 / rate(run(small + more)); };
  const double pixels = 64 * 48;
  // Speckle looks 4 rows and 4 px ahead, census and texture 2 and 2; what does not overlap empties itself.
  EXPECT_NEAR(period(""), pixels + 4 * 64 + 4, 0.1);
  EXPECT_NEAR(period("--set speckle.overlap_frames=yes"), pixels + 2 * 64 + 2, 0.1);
  EXPECT_NEAR(period("--set pipeline.overlap_frames=true"), pixels, 0.1);
  EXPECT_NEAR(period("--set pipeline.overlap_frames=true --set speckle.overlap_frames=no"),
              pixels + 4 * 64 + 4, 0.1);
  // A matcher that takes more than a cycle a pixel gives the others the time to empty themselves.
  EXPECT_NEAR(period("-d 64 --set pipeline.overlap_frames=true"), 2 * pixels, 0.1);
  // A second pass uses the circuit of the first one.
  const nlohmann::json passes = run(small + "--set pipeline.overlap_frames=true --set matching.paths=n,s");
  EXPECT_EQ(passes["stages"]["matching"]["cycles_per_frame"]["value"], 2 * pixels);
  EXPECT_FALSE(passes["stages"].contains("matching_writing"));
  EXPECT_TRUE(passes["stages"].contains("census_writing"));
}

TEST_F(Limits, SeveralPixelsPassInACycle) {
  const std::string core =
      "--preset core-alone --rectified --timing-only --set pipeline.overlap_frames=true ";
  // Published: 3840x2160 at 4 px a clock of 74.25 MHz.
  EXPECT_NEAR(
      rate(run(core + "--size 3840x2160 --set clocks.core_hz=74250000 --set pipeline.pixels_per_token=4 "
                      "--set matching.parallel_rows=4")),
      74.25e6 * 4 / (3840 * 2160), 1e-4);
  const std::string small = core + "--size 64x48 --set clocks.core_hz=1e8 ";
  const auto cycles = [&](const std::string& more) {  // of a pixel
    return 1e8 / rate(run(small + more + "--timing-frames 20 ")) / (64 * 48);
  };
  const auto design = [](int pixels, int rows) {
    return fmt::format("--set pipeline.pixels_per_token={} --set matching.parallel_rows={} ", pixels, rows);
  };
  // One row of the matcher takes the pixels of a token one after the other, n_i cycles each.
  EXPECT_NEAR(cycles("-d 128 " + design(4, 1)), 4, 1e-4);
  EXPECT_NEAR(cycles("-d 128 " + design(4, 2)), 2, 1e-4);
  EXPECT_NEAR(cycles("-d 128 " + design(4, 4)), 1, 1e-4);
  EXPECT_NEAR(cycles("-d 128 " + design(4, 16)), 0.25, 1e-4);
  // Rows at once where a pixel is a token.
  EXPECT_NEAR(cycles("-d 128 " + design(1, 4)), 1, 1e-4);
  EXPECT_NEAR(cycles("-d 128 " + design(1, 2)), 2, 1e-4);
  // The recurrence is waited for once a step, of n_i iterations of all rows.
  const std::string recurrence = "-d 128 --set matching.recurrence_latency=5 ";
  EXPECT_NEAR(cycles(recurrence + design(1, 1)), 8, 1e-4);
  EXPECT_NEAR(cycles(recurrence + design(1, 2)), 4, 1e-4);
  EXPECT_NEAR(cycles(recurrence + design(2, 4)), 2, 1e-4);
  EXPECT_NEAR(cycles(recurrence + design(4, 2)), 4, 1e-4);
}

// Windows side by side share their line buffers; FIFOs are wider.
TEST_F(Limits, SeveralPixelsTakeTheirStorage) {
  const std::string size = "--rectified --timing-only --size 64x48 -d 32 ";
  const nlohmann::json one = run(size);
  const nlohmann::json four = run(size + "--set pipeline.pixels_per_token=4");
  const auto storage = [](const nlohmann::json& tree, const char* stage) {
    return tree["stages"][stage]["storage"]["value"].get<std::int64_t>();
  };
  EXPECT_EQ(storage(four, "census") - storage(one, "census"), 2 * 8 * 5 * 3);
  EXPECT_EQ(storage(four, "speckle") - storage(one, "speckle"), 2 * 12 * 5 * 3);
  EXPECT_EQ(storage(four, "noise_reduction") - storage(one, "noise_reduction"), 12 * 3 * 3);
  EXPECT_EQ(storage(four, "texture") - storage(one, "texture"), 3 * 5 * 8 + 3 * 12);
  EXPECT_EQ(storage(four, "rectification"), storage(one, "rectification"));
  EXPECT_EQ(storage(four, "matching"), storage(one, "matching"));
  const auto width = [](const nlohmann::json& tree, const char* stream) {
    return tree["streams"][stream]["width"]["value"].get<std::int64_t>();
  };
  EXPECT_EQ(width(four, "left_pixels"), 4 * 8);
  EXPECT_EQ(width(four, "left_codes"), 4 * 24);
  EXPECT_EQ(width(four, "winners"), 4 * 12);
  EXPECT_EQ(width(four, "costs_subpixel"), 32 * 11);
  // What is moved is the same, in wider tokens.
  EXPECT_NEAR(four["energy"]["frame_on_chip_memory"]["value"].get<double>(),
              one["energy"]["frame_on_chip_memory"]["value"].get<double>(),
              0.05 * one["energy"]["frame_on_chip_memory"]["value"].get<double>());

  const nlohmann::json rows = run(size + "--set pipeline.pixels_per_token=4 --set matching.parallel_rows=4");
  EXPECT_EQ(width(rows, "costs_subpixel"), 4 * 32 * 11);
  EXPECT_EQ(storage(rows, "subpixel"), 4 * storage(one, "subpixel"));
  EXPECT_EQ(storage(rows, "uniqueness"), 4 * storage(one, "uniqueness"));
  EXPECT_EQ(storage(rows, "consistency"), 4 * storage(one, "consistency"));
  // Path W of three rows more; two columns of path costs between two rows; codes and disparities of three
  // rows that wait; three windows of right codes more.
  const std::int64_t pixel = (32 + 1) * 9;
  EXPECT_EQ(storage(rows, "matching") - storage(one, "matching"),
            3 * pixel + 3 * 2 * 3 * pixel + 3 * 64 * (2 * 24 + 12) + 3 * 24 * 31);
}

// An image is as wide as the tiles hold it.
TEST_F(Limits, TilesSayHowWideAnImageMayBe) {
  EXPECT_EQ(
      run("--timing-only --size 2560x64 --set tiles.largest_number=3")["input"]["processed_width"]["value"],
      2560);
  EXPECT_EQ(run("--timing-only --size 1888x64")["input"]["processed_width"]["value"],
            1888);  // 32 disparities
  const test::Outcome outcome = program_("run --timing-only -q --size 1888x64");
  EXPECT_EQ(
      outcome.err,
      "parallax: error: images of 1888 columns do not fit: 2 tiles of 1024 columns (tiles.largest_number, "
      "tiles.limit) that overlap by 32 + 32 + disparity offset 0 + range 128 hold 1856\n");
}

// A host that takes 325.5 frames a second, and cameras at 400.
TEST_F(Limits, CamerasThatCannotWaitDropWhatFindsNoBuffer) {
  const std::string slow = "--size 64x48 --timing-frames 200 --set link.host_pixel_rate=1e6 ";
  const auto count = [](const nlohmann::json& tree, const char* name) {
    return tree["camera"][name]["value"].get<std::int64_t>();
  };
  const nlohmann::json fast = run(slow + "--set camera.frame_rate=400");
  EXPECT_EQ(limit(fast), "host");
  EXPECT_NEAR(rate(fast), 1e6 / 3072, 1);
  EXPECT_NEAR(static_cast<double>(count(fast, "dropped_frames")), 200 * (400 * 3072 / 1e6 - 1), 8);
  EXPECT_EQ(count(fast, "missed_triggers"), 0);
  const nlohmann::json kept = run(slow + "--set camera.frame_rate=300 --set camera.jitter_ns=300000");
  EXPECT_EQ(count(kept, "dropped_frames"), 0);
  EXPECT_NEAR(rate(kept), 300, 2);
}

TEST_F(Limits, TheSteadyStateDoesNotDependOnItsLength) {
  const std::string slow =
      "--size 64x48 --set memory.model=bus --set memory.bytes_per_cycle=1 --set clocks.memory_hz=50e6 "
      "--timing-frames ";
  const double expected = rate(run(slow + "60"));
  for (const char* frames : {"4", "8", "9", "20"})
    EXPECT_NEAR(rate(run(slow + frames)) / expected, 1, 2e-3) << frames;
}

// Cameras a little faster than the core: the frame buffers fill for hundreds of frames. A run goes on until
// they have, unless it is told how long to be.
TEST_F(Limits, ALatencyThatStillGrowsIsSaidToAndWhereItEnds) {
  const std::string machine =
      "--size 64x48 --timing-only --set link.host_pixel_rate=0 --set link.line_rate=10e9 "
      "--set software.response_ns=0 --set software.queue_frames=true --set clocks.core_hz=20e6 ";
  const nlohmann::json fast = run(machine + "--set clocks.camera_hz=100e6");
  const double busy = fast["limit"]["utilisation_by_part"]["camera"]["value"].get<double>() / 100;
  EXPECT_EQ(fast["steady"]["established"]["value"], "yes");
  EXPECT_EQ(fast["steady"]["latency_trend"]["value"], 0);
  // The read-out takes 1 % less than the core's period.
  const std::string near = machine + fmt::format("--set clocks.camera_hz={:.0f} ", 100e6 * busy / 0.99);
  const std::string short_run = near + "--timing-frames 14";
  const nlohmann::json few = run(short_run);
  EXPECT_EQ(few["steady"]["established"]["value"], "no");
  EXPECT_GT(few["steady"]["latency_trend"]["value"].get<double>(), 0);
  EXPECT_NEAR(rate(few) / rate(fast), 1, 1e-3);
  const double full = few["steady"]["latency_when_full"]["value"];
  EXPECT_GT(full, 1.2 * few["latency"]["exposure_to_host_mean"]["value"].get<double>());
  const auto more = few["steady"]["frames_until_full"]["value"].get<int>();
  const nlohmann::json many = run(near + fmt::format("--timing-frames {}", 2 * more));
  EXPECT_EQ(many["steady"]["established"]["value"], "yes");
  EXPECT_NEAR(many["latency"]["exposure_to_host_mean"]["value"].get<double>() / full, 1, 0.01);
  EXPECT_LT(many["steady"]["frames"]["value"].get<int>(), 2 * more - 8);
  const nlohmann::json usual = run(near);
  EXPECT_EQ(usual["steady"]["established"]["value"], "yes");
  EXPECT_NEAR(usual["latency"]["exposure_to_host_mean"]["value"].get<double>() / full, 1, 0.01);
  const std::string text = program_("run --no-verdict --disparities 32 " + short_run).out;
  EXPECT_NE(text.find("it is not steady, but grows by "), std::string::npos) << text;
  EXPECT_NE(text.find(fmt::format(", to some {:.3f} ms in about {} frames", full, more)), std::string::npos)
      << text;
}

// A host that takes 325.5 frames a second, and cameras at 330, whose jitter does not hide that a queue grows.
TEST_F(Limits, WhatWillBeDroppedIsSaidBeforeTheBuffersAreFull) {
  const std::string machine =
      "--size 64x48 --timing-only --set link.host_pixel_rate=1e6 --set camera.frame_rate=330 ";
  for (const char* jitter : {"", "--set camera.jitter_ns=200000 "}) {
    const std::string short_run = machine + jitter + "--timing-frames 103";
    const nlohmann::json few = run(short_run);
    EXPECT_EQ(few["camera"]["dropped_frames"]["value"], 0);
    EXPECT_EQ(few["steady"]["established"]["value"], "no") << jitter;
    EXPECT_NEAR(rate(few), 1e6 / 3072, 0.1);
    const double drops = few["steady"]["drops_when_full"]["value"];
    EXPECT_NEAR(drops, 330 - 1e6 / 3072, 0.1);
    const std::string text = program_("run --no-verdict --disparities 32 " + short_run).out;
    EXPECT_NE(text.find(fmt::format("; then at least {:.2f} fps are dropped", drops)), std::string::npos)
        << text;
    const auto dropped = [&](int frames) {
      return run(machine + jitter +
                 fmt::format("--timing-frames {}", frames))["camera"]["dropped_frames"]["value"]
          .get<double>();
    };
    EXPECT_NEAR(dropped(2000) - dropped(1000), drops * 1000 * 3072 / 1e6, 1.01) << jitter;
  }
}

// A queue that is full within a thousand frames is waited for, one that fills for longer is not.
TEST_F(Limits, ARunGoesOnUntilTheQueueIsFull) {
  const std::string machine = "--size 64x48 --timing-only --set link.host_pixel_rate=1e6 ";
  const nlohmann::json waited = run(machine + "--set camera.frame_rate=330");
  EXPECT_EQ(waited["steady"]["established"]["value"], "yes");
  EXPECT_GT(waited["camera"]["dropped_frames"]["value"], 0);
  EXPECT_GT(waited["input"]["frames"]["value"], 130);
  const nlohmann::json given_up = run(machine + "--set camera.frame_rate=325.6");
  EXPECT_EQ(given_up["steady"]["established"]["value"], "no");
  EXPECT_LT(given_up["input"]["frames"]["value"], 130);
  EXPECT_GT(given_up["steady"]["frames_until_full"]["value"], 1000);
}

TEST_F(Limits, CamerasThatTheMachineKeepsUpWithNeedFewFrames) {
  const std::string size = "--size 64x48 --timing-only --set camera.frame_rate=30 ";
  const nlohmann::json few = run(size);
  EXPECT_LT(few["input"]["frames"]["value"].get<int>(), 20);
  const nlohmann::json many = run(size + "--timing-frames 60");
  EXPECT_NEAR(rate(few) / rate(many), 1, 1e-6);
  const auto latency = [](const nlohmann::json& tree) {
    return tree["latency"]["exposure_to_host_mean"]["value"].get<double>();
  };
  EXPECT_NEAR(latency(few) / latency(many), 1, 1e-3);
}

TEST_F(Limits, OneFrameHasNoSteadyState) {
  const nlohmann::json tree = run("--size 64x48 --timing-frames 1");
  EXPECT_EQ(rate(tree), 0);
  EXPECT_FALSE(tree.contains("limit"));
}

Part stage(const char* name) { return {PartKind::kStage, name, "", {}}; }

TEST(FindLimit, TheFirstOfEqualsThatIsAtWorkAllTheTime) {
  const Part a = stage("a"), b = stage("b"), c = stage("c");
  const Limit limit = find_limit({{&a, 0.5, 5}, {&b, 0.995, 9.9}, {&c, 1.0, 10}});
  EXPECT_TRUE(limit.limited);
  EXPECT_EQ(limit.busiest.part, &b);
  EXPECT_EQ(limit.next.part, &a);
}

TEST(FindLimit, NoneWhenAllHaveTimeToSpare) {
  const Part a = stage("a"), b = stage("b");
  const Limit limit = find_limit({{&a, 0.5, 5}, {&b, 0.94, 9.4}});
  EXPECT_FALSE(limit.limited);
  EXPECT_EQ(limit.busiest.part, &b);
}

}  // namespace limits_test
}  // namespace parallax
