// SPDX-License-Identifier: Apache-2.0
// Every number that `parallax run` prints is one of timing.json, rounded as all are: by name, not any that
// fits.
#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/cli/printed_numbers.hpp"
#include "tests/cli/program.hpp"

namespace parallax::test {
namespace printed_numbers_test {

double number(const Json& tree, const std::string& path) { return entry_at(tree, path)->at("value"); }

// What is said of several metrics at once, or of a metric's window.
const Derived& derived() {
  static const Derived all{
      {"last_disparity",
       [](const Json& tree) {
         return fmt::format(
             "{}", number(tree, "input/disparity_offset") + number(tree, "input/disparity_range") - 1);
       }},
      {"window",
       [](const Json& tree) {
         return entry_at(tree, "performance/frame_rate")->at("window").get<std::string>();
       }},
      {"end",
       [](const Json& tree) {
         const bool link = tree.at("configuration").at("link").at("enabled");
         return std::string(link ? "the host" : "results in memory");
       }},
      {"fall",
       [](const Json& tree) {
         return naive_number_text(-number(tree, "steady/latency_trend"), "ms") + " ms";
       }},
  };
  return all;
}

#define LATENCIES                                                                                        \
  "{latency/first_pixel_first_frame} to the first pixel, {latency/last_pixel_first_frame} to the last, " \
  "from "
#define PORT(name)                                                                                       \
  "{memory/" name "/bandwidth#MB/s} {memory/" name "/share} {memory/" name                               \
  "/bytes_per_frame#B} {memory/" name "/latency_mean#ns} {memory/" name "/latency_p95#ns} {memory/" name \
  "/latency_largest#ns}"
#define STAGE_SHARES                                                           \
  "{stages/<stage>/busy_share} busy, {stages/<stage>/starved_share} starved, " \
  "{stages/<stage>/blocked_share} "                                            \
  "blocked, {stages/<stage>/memory_share} memory, "

// The lines of the summary and of -v. The first that a line is of counts.
const std::vector<PrintedLine>& lines_of_a_run() {
  static const std::vector<PrintedLine> all = [] {
    std::vector<PrintedLine> patterns;
    for (
        const char* pattern :
        {"image {input/width#px} x {input/height#px} px, processed as {input/processed_width#px} x "
         "{input/processed_height#px}, disparities {input/disparity_offset#px} to {=last_disparity} px",
         "image {input/width#px} x {input/height#px} px, disparities {input/disparity_offset#px} to "
         "{=last_disparity} px",
         "frame rate {performance/frame_rate} steady state ({=window})",
         "evaluations {performance/evaluations_per_second#1/s} a second, "
         "{performance/disparities_per_second#1/s} disparities a second",
         "latency " LATENCIES "frame in memory (first frame)",
         "latency " LATENCIES "{input/startable_rows} of it in memory (first frame)",
         "{latency/exposure_to_host_mean} from exposure to {=end} (mean), first frame "
         "{latency/exposure_to_host_first_frame}",
         "it is not steady, but grows by {steady/latency_trend} a frame until all buffers are full, to some "
         "{steady/latency_when_full} in about {steady/frames_until_full} (--timing-frames); then at "
         "least {steady/drops_when_full} are dropped",
         "it is not steady, but grows by {steady/latency_trend} a frame until all buffers are full, to some "
         "{steady/latency_when_full} in about {steady/frames_until_full} (--timing-frames)",
         "it is not steady, but grows by {steady/latency_trend} a frame",
         "it may not be steady: a longer run shows (--timing-frames)",
         "it is not steady, but falls by {=fall} a frame",
         "cameras {camera/dropped_frames} dropped (no buffer free), {camera/faulty_frames} faulty, "
         "{camera/missed_triggers} missed (reading out)",
         "time # busy, e upstream empty, f downstream full, m memory, s synchroniser, . blanking; %: at work",
         "verdict {limit/verdict}",
         "limit no part is at work all the time; the busiest, {limit/next_part}, is at {limit/utilisation}; "
         "look "
         "at {limit/key}, and at the look-ahead that each frame fills anew",
         "limit {limit/part} at {limit/utilisation} of the time ({limit/key}); next {limit/next_part} at "
         "{limit/next_frame_rate}",
         "memory {memory/bandwidth#MB/s} of {memory/usable_bandwidth} usable, bus taken {memory/share} of "
         "the "
         "time, {memory/row_hits} row hits",
         "memory {memory/bandwidth#MB/s} of {memory/usable_bandwidth} usable, bus taken {memory/share} of "
         "the "
         "time",
         "port MB/s bus B a frame latency, ns mean p95 largest (whole run)",
         "rectification map " PORT("map"),
         "energy {energy/power_total} estimated, {energy/frame_total} a frame",
         "energy <part> {energy/power_<part>} estimated",
         "valid pixels {quality/valid_share} of the image",
         "ground truth coverage {quality/coverage}, bad-1 {quality/bad_1}, bad-2 {quality/bad_2}, bad-3 "
         "{quality/bad_3}, mean error {quality/mean_error}",
         "results out",
         "latency {latency/first_pixel_mean} to the first pixel, {latency/last_pixel_mean} to the last, with "
         "frames before it under way",
         "map {memory/map/bytes_per_pixel_and_image} per pixel and image",
         "stage <stage> " STAGE_SHARES
         "{stages/<stage>/synchroniser_share} synchroniser, {stages/<stage>/blanking_share} blanking of "
         "{stages/<stage>/window}",
         "stage <stage> " STAGE_SHARES "{stages/<stage>/blanking_share} blanking of {stages/<stage>/window}",
         "stream <stream> depth {streams/<stream>/depth#tokens} of {streams/<stream>/width}, held "
         "{streams/<stream>/mean_occupancy#tokens} mean, {streams/<stream>/high_water#tokens} largest; full "
         "{streams/<stream>/full}, empty {streams/<stream>/empty} of the time",
         "<port> " PORT("<port>")})
      patterns.emplace_back(pattern);
    return patterns;
  }();
  return all;
}

// Of the time table: at work, of the time; a single frame has no period, so its stages' busy cycles.
const PrintedLine kAtWork("<part> | {limit/utilisation_by_part/<part>}");
const PrintedLine kLimits("{limit/part} | {limit/utilisation} limits");
const PrintedLine kBusy("<stage> | {stages/<stage>/busy_share}");

// The sentence of limit/verdict. What a remedy sets is of the run without the limit, of which timing.json has
// the rate alone: its own numbers stand here.
const std::vector<PrintedLine>& verdicts() {
  static const std::vector<PrintedLine> all = [] {
    std::vector<PrintedLine> patterns;
    const std::string fifos = "; all FIFOs deeper give {limit/all_fifos_frame_rate}";
    const std::string clock =
        "; doubling the core's clock gives {limit/faster_clock_frame_rate}, as it shortens these waits too";
    // What says most comes first: "<remedy...>" could be anything.
    for (const std::string& more : {fifos + clock, clock, fifos, std::string()}) {
      for (const char* remedy :
           {"a depth of <tokens..>", "depths of <tokens...>", "a default depth of <tokens..>",
            "8 times as many bursts under way", "a link of 1 Tbit/s", "<remedy...>"}) {
        const std::string end =
            fmt::format("; {} give<s...> {{limit/relaxed_frame_rate}}, <then...>", remedy) + more;
        const std::string though =
            " limit<s...>, though <part...> is at work for {limit/utilisation} of the time" + end;
        patterns.emplace_back("<part...> limits at {limit/utilisation}" + end);
        patterns.emplace_back("<parts...> limit together" + end);
        patterns.emplace_back("FIFO <fifo> with its depth of {streams/<fifo>/depth#tokens}" + though);
        patterns.emplace_back("FIFO <fifo> with its depth of {streams/<fifo>/depth#tokens} limits" + end);
        patterns.emplace_back("<part...>" + though);
        patterns.emplace_back("<part...> limit<s...>" + end);
      }
    }
    patterns.emplace_back("nothing limits alone, and nothing that was tried gains anything together");
    return patterns;
  }();
  return all;
}

bool is_explained(const std::vector<PrintedLine>& patterns, const std::string& line, const Json& tree) {
  for (const PrintedLine& pattern : patterns) {
    if (pattern.explains(line, tree, derived())) return true;
  }
  return false;
}

struct Machine {
  const char* name;
  const char* options;
  const char* line;  ///< that it is to print, so that it is the case that it is here for
};

void PrintTo(const Machine& machine, std::ostream* out) { *out << machine.options; }

class PrintedNumbers : public ::testing::TestWithParam<Machine> {};

TEST_P(PrintedNumbers, OfARunAreThoseOfTiming) {
  const Program program;
  const Outcome outcome = program(std::string("run -v --out out ") + GetParam().options);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(with_single_blanks(outcome.out).find(GetParam().line), std::string::npos) << outcome.out;
  const Json tree = Json::parse(program.read("out/timing.json"));
  const Json* const limit = entry_at(tree, "limit/part");
  int limits = 0;
  for (const std::string& line : lines(outcome.out)) {
    if (is_explained(lines_of_a_run(), line, tree)) continue;
    if (kLimits.explains(line, tree)) {
      ++limits;
    } else {
      EXPECT_TRUE((limit == nullptr ? kBusy : kAtWork).explains(line, tree))
          << "where is this from? " << line;
    }
  }
  EXPECT_EQ(limits, limit == nullptr || limit->at("value") == "none" ? 0 : 1);
  if (const Json* const verdict = entry_at(tree, "limit/verdict")) {
    EXPECT_TRUE(is_explained(verdicts(), verdict->at("value"), tree)) << verdict->at("value");
  }
}

INSTANTIATE_TEST_SUITE_P(
    Machines, PrintedNumbers,
    ::testing::Values(
        Machine{"Preset", "--size 160x128 -d 64", "bad-3"},
        Machine{"TimingOnly", "--timing-only --size 640x480", "host limits at 100.0 %"},
        Machine{"OddSize", "--timing-only --size 75x50", "processed as 96 x 64"},
        Machine{"CoreAlone", "--timing-only --rectified --preset core-alone --size 320x240",
                "from exposure to results in memory"},
        Machine{"LinkOff", "--timing-only --size 160x128 --set link.enabled=false",
                "from exposure to results in memory"},
        Machine{
            "AFifoThatAFasterClockHides",
            "--timing-only --preset core-alone --rectified --size 64x48 --set matching.iterations=1 --set "
            "streams.left_texture.depth=64",
            "as it shortens these waits too"},
        Machine{
            "AFifoThatDoesMostOfIt",
            "--timing-only --preset core-alone --rectified --size 64x48 --set matching.iterations=1 --set "
            "pipeline.pixels_per_token=2 --set streams.left_texture.depth=20",
            "all FIFOs deeper give"},
        Machine{"SmallRates", "--timing-only --size 64x48 --set clocks.core_hz=10000",
                "frame rate 0.614 fps"},
        Machine{"SlowerStill",
                "--timing-only --size 64x48 --timing-frames 2 --set clocks.core_hz=10 --no-verdict",
                "frame rate 0.00061"},
        Machine{"LargeRates",
                "--timing-only --rectified --preset core-alone --size 64x48 -d 32 --set "
                "clocks.core_hz=10000000000",
                "billion a second"},
        Machine{"PathCostsInMemory",
                "--timing-only --rectified --size 192x96 -d 32 --set matching.path_storage=memory",
                "stream returned_rows_bursts depth"},
        Machine{"CamerasWithTriggers", "--timing-only --size 160x128 --set camera.frame_rate=60",
                "limit camera_frame_rate at "},
        Machine{"CamerasThatJitter",
                "--timing-only --size 160x128 --set camera.frame_rate=60 --set camera.jitter_ns=5000000",
                "frame rate 60.00 fps"},
        Machine{
            "CamerasThatFail",
            "--timing-only --size 160x128 --set camera.frame_rate=60 --set camera.fault=missing_row --set "
            "camera.fault_every=3",
            "cameras 0 frames dropped"},
        Machine{"CamerasThatAreTooFast",
                "--timing-only --size 64x48 --timing-frames 200 --set link.host_pixel_rate=1e6 --set "
                "camera.frame_rate=400",
                "frames dropped (no buffer free)"},
        Machine{"CamerasALittleTooFast",
                "--timing-only --size 64x48 --timing-frames 103 --set link.host_pixel_rate=1e6 --set "
                "camera.frame_rate=326",
                "are dropped"},
        Machine{"ALatencyThatGrows",
                "--timing-only --size 320x240 --timing-frames 11 --set link.host_pixel_rate=0 --set "
                "link.line_rate=10e9 --set clocks.camera_hz=39e6",
                "it is not steady, but grows by"},
        Machine{"ARateHardlyKeptUpWith",
                "--timing-only --size 64x48 --set link.host_pixel_rate=1e6 --set camera.frame_rate=324 --set "
                "camera.jitter_ns=300000",
                "it may not be steady"},
        Machine{"OneFrame", "--timing-only --size 160x128 --timing-frames 1", "first frame"},
        Machine{"EarlyStarts",
                "--timing-only --size 320x240 -d 64 --set camera.early_start_rows=64 --set "
                "link.early_start_rows=64",
                "64 rows of it in memory"},
        Machine{"SimpleBus",
                "--timing-only --size 160x128 --set memory.model=bus --set memory.bytes_per_cycle=1",
                "usable"},
        Machine{"Overheads",
                "--timing-only --rectified --preset core-alone --size 160x128 --set matching.row_overhead=17",
                "matching limits"},
        Machine{"AsynchronousFifos",
                "--timing-only --size 160x128 --set streams.default_kind=asynchronous --set "
                "streams.default_depth=4",
                "synchroniser"},
        Machine{"AFifoThatLimits", "--timing-only --size 320x240 --set streams.costs_uniqueness.depth=2",
                "verdict FIFO costs_uniqueness with its depth of 2"},
        Machine{"NothingAtWorkAllTheTime",
                "--timing-only --size 64x48 --set camera.frame_buffers=1 --set link.output_buffers=1",
                "no part is at work all the time"}),
    [](const auto& machine) { return machine.param.name; });

// Numbers of a pattern's own words are names, or listed here with what they are of.
TEST(PrintedLine, HasNoNumbersOfItsOwnButTheseNames) {
  const std::set<std::string> names{"p95", "bad-1", "bad-2", "bad-3",  // names of columns
                                    "8",   "1"};  // of remedies: "8 times as many bursts", "1 Tbit/s"
  std::vector<PrintedLine> all = lines_of_a_run();
  all.insert(all.end(), verdicts().begin(), verdicts().end());
  for (const PrintedLine& pattern : all) {
    const std::string own = std::regex_replace(pattern.pattern(), std::regex("\\{[^}]*\\}|<[^>]*>"), "");
    static const std::regex with_digit("[A-Za-z-]*[0-9]+");
    for (std::sregex_iterator it(own.begin(), own.end(), with_digit), none; it != none; ++it)
      EXPECT_EQ(names.count(it->str()), 1U) << it->str() << " in " << pattern.pattern();
  }
}

// The check itself fails where it should.
TEST(PrintedLine, SeesAnotherNumberAnotherUnitAndAnotherName) {
  const Json tree{
      {"memory",
       {{"left", {{"share", {{"value", 99.97}, {"unit", "%"}}}, {"p95", {{"value", 154.3}, {"unit", "ns"}}}}},
        {"right", {{"share", {{"value", 7.2041}, {"unit", "%"}}}}}}}};
  const PrintedLine line("<port> {memory/<port>/share}");
  EXPECT_TRUE(line.explains("  left   99.97 %", tree));
  EXPECT_TRUE(line.explains("right 7.20 %", tree));
  EXPECT_FALSE(line.explains("7 99.97 %", tree));
  const auto failures = [&](const PrintedLine& of, const std::string& text) {
    ::testing::TestPartResultArray results;
    {
      const ::testing::ScopedFakeTestPartResultReporter reporter(
          ::testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &results);
      of.explains(text, tree);
    }
    return results.size();
  };
  EXPECT_EQ(failures(line, "left 100.0 %"), 1);
  EXPECT_EQ(failures(line, "left 7.20 %"), 1) << "the right one's";
  EXPECT_EQ(failures(line, "left 99.97 ms"), 1);
  EXPECT_EQ(failures(line, "none 99.97 %"), 1);
  EXPECT_EQ(failures(PrintedLine("<port> {memory/<port>/p95#ms}"), "left 154"), 1) << "of another unit";
}

}  // namespace printed_numbers_test
}  // namespace parallax::test
