// SPDX-License-Identifier: Apache-2.0
// A machine that a user's block or memory holds up says who does.
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "platform/results/deadlock_report.hpp"
#include "tests/example/hanging_blocks.hpp"
#include "tests/example/machine_run.hpp"

namespace parallax::test {
namespace hang_test {

using Odd = OddMemory::Odd;

// What a run for timing alone ends with: "done", the text of a report, or who waits for whom.
std::string end_of(const MachineConfig& config, const std::function<void(MachineInput& input)>& change) {
  return in_child([&] {
    const EncodedMap map = encode(lens_map(kWidth, kHeight, config.rectification.range));
    MachineInput input;
    input.width = kWidth;
    input.height = kHeight;
    input.map = &map;
    input.frames = kFrames;
    input.timing_only = true;
    change(input);
    const Machine machine("machine", config, input);
    try {
      sc_core::sc_start();
    } catch (const sc_core::sc_report& report) {
      return std::string(report.get_msg_type()) + ": " + report.get_msg();
    }
    return machine.finished() ? "done" : message(find_deadlock(machine));
  });
}

std::string end_of_clocked(ClockedHalf::Work work, std::optional<std::uint64_t> hang_cycles,
                           const MachineConfig& config = small_machine(), std::int64_t frames = kFrames) {
  return end_of(config, [=](MachineInput& input) {
    input.frames = frames;
    input.hang_cycles = hang_cycles;
    input.replacements["census"] = [=](const std::string& name, const StageContext& context) {
      SlotModule slot;
      slot.module = std::make_unique<ClockedHalf>(name.c_str(), context.clock, work);
      slot.latency = 1;
      return slot;
    };
  });
}

constexpr ClockedHalf::Work kAll{~std::uint64_t{0}, ~std::uint64_t{0}};

constexpr const char* kHangs =
    "/parallax/machine/hang: machine: the machine hangs: nothing has moved since cycle ";
constexpr const char* kCensus = "  machine.core.pipeline.census (in kernel time) does not ";

std::string cycle(int since, int patience) {
  return std::to_string(since) + " of the core's clock, for more than " + std::to_string(patience) +
         " cycles (MachineInput::hang_cycles)\n";
}

std::string undone(const std::string& what, const std::string& stream, int since, const std::string& waiter) {
  return kCensus + what + " of stream machine.core.pipeline." + stream + ", since cycle " +
         std::to_string(since) + " of clock core; machine.core.pipeline." + waiter + " waits for it\n";
}

// The block's clock would keep the simulation going for ever.
TEST(Hang, ABlockThatReadsNoMoreIsNamed) {
  const std::string read = "read token 100 (frame 0, row 1)", write = "write token 100 (frame 0, row 1)";
  EXPECT_EQ(end_of_clocked({100, 100}, 5000),
            kHangs + cycle(937, 5000) + undone(read, "left_rectified", 588, "rectification") +
                undone(read, "right_rectified", 588, "rectification") +
                undone(write, "left_codes", 824, "matching") + undone(write, "right_codes", 824, "matching"));
}

TEST(Hang, ABlockThatWritesNoMoreIsNamed) {
  const std::string write = "write token 4705 (frame 1, row 1)";
  EXPECT_EQ(end_of_clocked({~std::uint64_t{0}, 4608 + 97}, 5000),
            kHangs + cycle(20782, 5000) + undone(write, "left_codes", 19363, "matching") +
                undone(write, "right_codes", 19363, "matching"));
}

// Nothing else goes on, and the simulation ends; the machine says the same to who asks it.
TEST(Hang, AThreadThatEndsIsNamed) {
  const std::string text = end_of(small_machine(), [](MachineInput& input) {
    input.replacements["census"] = [](const std::string& name, const StageContext&) {
      SlotModule slot;
      slot.module = std::make_unique<ThreadHalf>(name.c_str(), 10);
      return slot;
    };
    input.hang_cycles = 0;
  });
  EXPECT_EQ(text.rfind("the machine stopped before all frames were done; these wait:\n", 0), 0u) << text;
  const std::string last = undone("read token 10 (frame 0, row 0)", "right_rectified", 498, "rectification");
  EXPECT_NE(text.find(last), std::string::npos) << text;
}

// It would end by itself, unless other modules keep its time going.
TEST(Hang, ACircleOfStagesIsNamedWhereItIsAskedFor) {
  const std::string text = end_of(small_machine({"streams.left_texture.depth=64"}),
                                  [](MachineInput& input) { input.hang_cycles = 5000; });
  const std::string begin = kHangs;
  EXPECT_EQ(text.rfind(begin, 0), 0u) << text;
  EXPECT_NE(
      text.find("cycles (MachineInput::hang_cycles)\n  nobody in this circle can go on:\n"
                "  machine.core.pipeline.rectification waits on stream "
                "machine.core.pipeline.left_texture (full, depth 64) for machine.core.pipeline.texture\n"),
      std::string::npos)
      << text;
}

TEST(Hang, TheDefaultIsPatient) {
  const std::string text = end_of_clocked({100, 100}, std::nullopt);
  EXPECT_NE(text.find("for more than 1000000 cycles"), std::string::npos) << text;
}

// Between two frames of these cameras lie some million cycles.
TEST(Hang, AFrameThatIsDueLaterIsNone) {
  MachineConfig config = small_machine();
  config.camera.frame_rate = 200;
  EXPECT_EQ(end_of_clocked(kAll, 20'000, config), "done");
  config.camera.frame_rate = 0;
  config.camera.exposure_ns = 5'000'000;
  EXPECT_EQ(end_of_clocked(kAll, 20'000, config), "done");
}

// More than a million cycles lie between two bursts of this camera.
TEST(Hang, AMachineThatIsSlowIsNone) {
  MachineConfig config = small_machine();
  config.clocks.camera_hz = 100'000;
  EXPECT_EQ(end_of_clocked(kAll, std::nullopt, config, 1), "done");
}

TEST(Hang, WithoutAWatchdogTheSimulationEndsWhenNobodyElseIsThere) {
  const std::string text = end_of(small_machine({"streams.left_texture.depth=64"}), [](MachineInput&) {});
  EXPECT_EQ(text.rfind("the machine is deadlocked", 0), 0u) << text;
}

std::string end_with_memory(Odd odd, const std::string& port, std::uint64_t good) {
  const auto memory = std::make_shared<std::unique_ptr<OddMemory>>();
  return end_of(small_machine(), [&](MachineInput& input) {
    *memory = std::make_unique<OddMemory>("memory", odd, port, good);
    input.bind_memory = [memory](::tlm::tlm_initiator_socket<>& socket, const std::string& name) {
      (*memory)->bind(socket, name);
    };
  });
}

TEST(Hang, AMemoryThatAnswersEveryRequestIsInOrder) {
  EXPECT_EQ(end_with_memory(Odd::kAnswersNone, "nobody", 0), "done");
}

TEST(Hang, AMemoryThatDoesNotAnswerIsNamed) {
  EXPECT_EQ(end_with_memory(Odd::kAnswersNone, "left", 7),
            kHangs + cycle(2022, 1'000'000) +
                "  the memory has not answered the read of 128 bytes at 0x380 at port left, sent 579.787 ns "
                "after the start, in cycle 109 of the core's clock\n");
  EXPECT_EQ(end_with_memory(Odd::kTakesNone, "output", 0),
            kHangs + cycle(10314, 1'000'000) +
                "  the memory has not taken the write of 128 bytes at 0x22000 at port output, sent 42898.936 "
                "ns after the start, in cycle 8065 of the core's clock\n");
}

TEST(Hang, AnAnswerToNoRequestIsReported) {
  EXPECT_EQ(end_with_memory(Odd::kAnswersTwice, "left", 7),
            "/parallax/dma/phase: machine.core.dma_left.master: the target answers the read of 128 bytes at "
            "0x380, which is not under way: it was answered before");
}

TEST(Hang, AnAnswerOutOfOrderIsReported) {
  EXPECT_EQ(end_with_memory(Odd::kAnswersBackwards, "map", 3),
            "/parallax/dma/phase: machine.core.dma_map.master: the target answers the read of 128 bytes at "
            "0x20200 before the read of 128 bytes at 0x20180, which was sent first; a port's requests are to "
            "be answered in their order");
}

}  // namespace hang_test
}  // namespace parallax::test
