// SPDX-License-Identifier: Apache-2.0
// Software drives the core through its registers, and others may look at them or change them meanwhile.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <sstream>

#include "platform/registers/core_driver.hpp"
#include "platform/registers/register_map.hpp"
#include "platform/registers/run_time_parameters.hpp"
#include "tests/timing/in_child.hpp"
#include "tests/timing/machine_bench.hpp"
#include "tests/tlm/thread.hpp"

namespace parallax::test {
namespace machine_registers_test {

constexpr int kWidth = 96;
constexpr int kHeight = 48;
constexpr std::int64_t kFrames = 4;

std::string text_of(const FrameResult& result) {
  std::ostringstream out;
  for (const Disparity& d : result.disparities) out << d.value << "/" << static_cast<int>(d.cause) << " ";
  return out.str();
}

MachineConfig small(std::vector<std::string> assignments = {}) {
  assignments.insert(assignments.begin(), {"rectification.window=9", "matching.iterations=1"});
  return preset(assignments);
}

/// The frames' results, a line each, and what `look` says after the run.
std::string run(const MachineConfig& config, const std::function<void(MachineInput&)>& change,
                const std::function<std::string(Machine&)>& look = nullptr,
                const std::function<void(Machine&, CoreDriver&)>& other = nullptr) {
  return in_child([&] {
    const EncodedMap map = encode(lens_map(kWidth, kHeight, config.rectification.range));
    std::string text;
    MachineInput input;
    input.width = kWidth;
    input.height = kHeight;
    input.map = &map;
    input.frames = kFrames;
    input.expose = [](std::int64_t) {
      return StereoFrame{shifted_bars(kWidth, kHeight, 12), shifted_bars(kWidth, kHeight, 20)};
    };
    input.deliver = [&](const FrameResult& result) { text += text_of(result) + "\n"; };
    if (change) change(input);
    Machine machine("machine", config, input);
    CoreDriver driver("driver");
    driver.socket.bind(machine.registers().socket);
    std::unique_ptr<Thread> thread;
    if (other) thread = std::make_unique<Thread>("other", [&] { other(machine, driver); });
    sc_core::sc_start();
    if (!machine.finished()) return "stuck:\n" + describe(machine.dataflow().waits());
    if (look) text += look(machine);
    return text;
  });
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

std::string usual(const std::vector<std::string>& assignments = {}) {
  return lines(run(small(assignments), nullptr))[1];
}

TEST(MachineRegisters, ParametersCountFromTheFrameTheyAreWrittenBefore) {
  const std::vector<std::vector<std::string>> sets{
      {"matching.p1=3", "matching.p2=90"}, {"uniqueness.factor=600"},
      {"uniqueness.enabled=false"},        {"consistency.threshold=0"},
      {"consistency.enabled=false"},       {"texture.threshold=63"},
      {"texture.enabled=false"},           {"speckle.iterations=0"},
      {"gap_interpolation.enabled=false"}, {"noise_reduction.enabled=false"},
      {"subpixel.mask_border=false"},      {"speckle.iterations=1", "matching.p2=100"}};
  for (const RunTimeParameter& p : run_time_parameters()) {
    const auto names = [&p](const std::vector<std::string>& set) {
      return std::any_of(set.begin(), set.end(),
                         [&p](const std::string& s) { return s.rfind(std::string(p.key) + "=", 0) == 0; });
    };
    EXPECT_EQ(std::any_of(sets.begin(), sets.end(), names), !run_time_remark(p.key).empty())
        << p.key << ": each parameter that may change is looked at";
  }
  const std::string before = usual();
  int differ = 0;
  for (const std::vector<std::string>& set : sets) {
    const std::string after = usual(set);
    differ += after != before ? 1 : 0;
    const AlgorithmParameters changed = algorithm_parameters(small(set));
    const AlgorithmParameters first = algorithm_parameters(small());
    for (const char* tiles : {"tiles.limit=1024", "tiles.limit=80"}) {
      // The second and third frame alone have them; in two tiles, too.
      const auto with = [&](const std::vector<std::string>& assignments, bool change) {
        std::vector<std::string> all = assignments;
        all.emplace_back(tiles);
        all.insert(all.end(),
                   {"tiles.left_margin=8", "tiles.right_margin=8", "tiles.disparities_in_margin=false"});
        return lines(run(small(all), [&](MachineInput& input) {
          if (!change) return;
          input.parameters = [&](std::int64_t frame) -> std::optional<AlgorithmParameters> {
            if (frame == 1) return changed;
            if (frame == 3) return first;
            return std::nullopt;
          };
        }));
      };
      const std::vector<std::string> have = with({}, true);
      ASSERT_EQ(have.size(), 4u) << set[0];
      const std::string plain = with({}, false)[1];
      const std::string other = with(set, false)[1];
      EXPECT_EQ(have[0], plain) << set[0] << tiles;
      EXPECT_EQ(have[1], other) << set[0] << tiles;
      EXPECT_EQ(have[2], other) << set[0] << tiles;
      EXPECT_EQ(have[3], plain) << set[0] << tiles;
    }
  }
  EXPECT_GE(differ, 9);
}

std::string errors(Machine& machine, const char* block) {
  std::string text;
  for (const RegisterBlock& b : register_blocks()) {
    for (const Register& reg : b.registers) {
      if (std::string(block) != b.name || std::string("errors") != reg.name) continue;
      for (const RegisterField& f : reg.fields) {
        if (machine.registers().get(block, "errors", f.name) != 0) text += std::string(f.name) + " ";
      }
    }
  }
  return text;
}

TEST(MachineRegisters, ImpossibleParametersSetTheirErrorBitAndNothingElse) {
  const std::string expected = usual();
  const auto with = [&](const std::function<void(MachineConfig&)>& spoil) {
    const std::vector<std::string> all = lines(run(
        small({"gap_interpolation.enabled=false"}),
        [&](MachineInput& input) {
          input.parameters = [&](std::int64_t frame) -> std::optional<AlgorithmParameters> {
            if (frame != 1) return std::nullopt;
            MachineConfig bad = small({"gap_interpolation.enabled=false"});
            bad.texture.threshold = 63;  // is not taken either
            spoil(bad);
            return algorithm_parameters(bad);
          };
        },
        [](Machine& machine) { return errors(machine, "stereo") + "|" + errors(machine, "dma"); }));
    EXPECT_EQ(all.size(), 5u);
    const std::string good = lines(run(small({"gap_interpolation.enabled=false"}), nullptr))[1];
    for (std::size_t frame = 0; frame < 4; ++frame) EXPECT_EQ(all[frame], good);
    return all.back();
  };
  EXPECT_EQ(with([](MachineConfig& c) { c.matching.p1 = c.matching.p2; }), "penalties |");
  EXPECT_EQ(with([](MachineConfig& c) { c.matching.iterations = 2; }), "range |");
  EXPECT_EQ(with([](MachineConfig& c) { c.matching.disparity_offset = 1; }), "range |");
  EXPECT_EQ(with([](MachineConfig& c) { c.uniqueness.factor = 4097; }), "uniqueness |");
  EXPECT_EQ(with([](MachineConfig& c) { c.speckle.iterations = 3; }), "speckle |");
  EXPECT_EQ(with([](MachineConfig& c) { c.gap_interpolation.enabled = true; }), "switches |");
}

// Another initiator, as a processor model would be, sees the core at work and stops it for a while.
TEST(MachineRegisters, AnotherInitiatorSeesAndStopsTheCore) {
  const std::string seen = run(
      small({"link.host_pixel_rate=1000000"}), nullptr,
      [](Machine& machine) {
        return errors(machine, "dma") + "rejected " + (machine.rejected_starts() > 0 ? "some" : "none");
      },
      [](Machine&, CoreDriver& driver) {
        EXPECT_EQ(driver.read("dma", "status"), 2u);  // ready
        bool busy = false;
        std::uint32_t most = 0;
        for (int i = 0; i < 20000 && (driver.read("dma", "status") >> 16) < 2; ++i) {
          sc_core::wait(sc_core::sc_time(1, sc_core::SC_US));
          busy |= (driver.read("dma", "status") & 1U) != 0;
          if ((driver.read("dma", "status") & 1U) != 0)
            most = std::max(most, driver.read("dma", "output_bytes_available"));
        }
        EXPECT_TRUE(busy);
        EXPECT_GT(most, 0u);
        EXPECT_LE(most, 5u * kWidth * kHeight / 2);
        EXPECT_EQ(driver.read("dma", "output_fifo_info") >> 16, 4u);
        // A start that nobody waits for, and a stop.
        driver.write("dma", "control", 1);
        EXPECT_EQ(driver.read("dma", "errors") & 4U, 4U);
        const std::uint32_t control = driver.read("stereo", "control");
        driver.write("stereo", "control", control & ~1U);
        sc_core::wait(sc_core::sc_time(40, sc_core::SC_MS));
        const std::uint32_t done = driver.read("dma", "status") >> 16;
        sc_core::wait(sc_core::sc_time(40, sc_core::SC_MS));
        EXPECT_EQ(driver.read("dma", "status") >> 16, done);
        EXPECT_EQ(driver.read("dma", "errors") & 16U, 16U);
        driver.write("stereo", "control", control);
      });
  const std::vector<std::string> all = lines(seen);
  ASSERT_EQ(all.size(), 5u) << seen.substr(0, 500);
  EXPECT_EQ(all.back(), "rejected some");
  EXPECT_EQ(all[3], usual());
}

// A core that is switched off refuses starts; what the run says of a frame's parameters is asked for once all
// the same, and a run that is not stopped at its end has no more frames than it asked for.
TEST(MachineRegisters, ARefusedStartIsTriedAgainWithTheSameParameters) {
  std::string asked;
  int finished = 0;
  const std::string seen = run(
      small(),
      [&](MachineInput& input) {
        input.parameters = [&asked](std::int64_t frame) {
          asked += std::to_string(frame) + " ";
          return std::optional<AlgorithmParameters>();
        };
        input.finished = [&finished] { ++finished; };
      },
      [&](Machine& machine) {
        return asked + "finished " + std::to_string(finished) + " rejected " +
               (machine.rejected_starts() > 1 ? "several" : "one or none");
      },
      [](Machine&, CoreDriver& driver) {
        const std::uint32_t control = driver.read("stereo", "control");
        const auto wait_for_frames = [&driver](std::uint32_t frames) {
          while (driver.read("dma", "status") >> 16 < frames)
            sc_core::wait(sc_core::sc_time(1, sc_core::SC_US));
        };
        wait_for_frames(1);
        driver.write("stereo", "control", control & ~1U);
        sc_core::wait(sc_core::sc_time(100, sc_core::SC_MS));
        driver.write("stereo", "control", control);
        wait_for_frames(kFrames + 2);
        sc_core::sc_stop();
      });
  const std::vector<std::string> all = lines(seen);
  ASSERT_EQ(all.size(), static_cast<std::size_t>(kFrames) + 1) << seen.substr(0, 500);
  EXPECT_EQ(all.back(), "0 1 2 3 finished 1 rejected several");
}

// P2 written at any time, by somebody else, counts from the next frame on.
TEST(MachineRegisters, AParameterWrittenDuringAFrameCountsFromTheNext) {
  const std::string seen = run(small(), nullptr, nullptr, [](Machine&, CoreDriver& driver) {
    while ((driver.read("dma", "status") & 1U) == 0) sc_core::wait(sc_core::sc_time(1, sc_core::SC_US));
    const std::uint32_t word = driver.read("stereo", "algorithm_parameters_1");
    driver.write("stereo", "algorithm_parameters_1", (word & ~0xFFFFU) | 3U | 90U << 8);
  });
  const std::vector<std::string> all = lines(seen);
  ASSERT_EQ(all.size(), 4u) << seen.substr(0, 500);
  EXPECT_EQ(all[0], usual());
  EXPECT_EQ(all[1], usual({"matching.p1=3", "matching.p2=90"}));
  EXPECT_NE(all[1], all[0]);
}

}  // namespace machine_registers_test
}  // namespace parallax::test
