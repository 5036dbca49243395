// SPDX-License-Identifier: Apache-2.0
#include "platform/config/configuration.hpp"

#include <gtest/gtest.h>

#include <set>

#include "platform/config/preset.hpp"
#include "platform/config/preset_file.hpp"
#include "platform/config/schema.hpp"
#include "tests/paths.hpp"
#include "tests/platform/error_of.hpp"
#include "tests/platform/temporary_folder.hpp"

namespace parallax {
namespace configuration_test {

const std::filesystem::path kShipped = test::source_path("platform/presets");

Configuration load(const std::vector<std::string>& assignments) {
  return load_configuration({"scenescan-pro", assignments, {}}, {kShipped});
}

std::string error(const std::vector<std::string>& assignments) {
  return error_of([&] { load(assignments); });
}

TEST(MachineConfig, DefaultsAreInRangeAndFitTogether) {
  MachineConfig config;
  Schema schema;
  describe(schema, config);
  EXPECT_NO_THROW(schema.check());
  EXPECT_NO_THROW(config.validate());
}

TEST(MachineConfig, EveryKeyIsDocumented) {
  MachineConfig config;
  Schema schema;
  describe(schema, config);
  for (const Key& key : schema.keys()) {
    EXPECT_FALSE(key.documentation.empty()) << key.path;
    EXPECT_EQ(key.documentation.back(), '.') << key.path;
    EXPECT_FALSE(key.provenance.source.empty()) << key.path;
    const bool is_number = key.type == KeyType::kInteger || key.type == KeyType::kReal;
    EXPECT_EQ(is_number, !key.unit.empty()) << key.path;
  }
}

TEST(MachineConfig, EveryKeyTakesBothEndsOfItsRange) {
  MachineConfig config;
  Schema schema;
  describe(schema, config);
  for (const Key& key : schema.keys()) {
    if (key.type != KeyType::kInteger) continue;
    for (const std::int64_t end : {key.integers.least, key.integers.most}) {
      schema.apply({{key.path, RawValue{ConfigValue(end), {}, {}, "test"}}});
      EXPECT_EQ(key.get(), ConfigValue(end)) << key.path;
    }
  }
}

TEST(ShippedPresets, EveryValueCarriesTagAndSource) {
  const auto check = [](const std::filesystem::path& folder) {
    const std::vector<PresetSummary> presets = list_presets({folder});
    EXPECT_FALSE(presets.empty()) << folder;
    for (const PresetSummary& preset : presets) {
      const PresetFile file = read_preset_file(folder / (preset.name + ".toml"));
      EXPECT_FALSE(file.description.empty()) << preset.name;
      for (const auto& [key, value] : file.values) {
        EXPECT_TRUE(value.tag) << value.origin << " " << key;
        EXPECT_TRUE(value.source && !value.source->empty()) << value.origin << " " << key;
      }
    }
  };
  check(kShipped);
  check(kShipped / "memory");
  for (const PresetSummary& preset : list_presets({kShipped})) {
    EXPECT_NO_THROW(load_configuration({preset.name, {}, {}}, {kShipped})) << preset.name;
  }
}

TEST(Configuration, HasThePublishedMachineByDefault) {
  const MachineConfig machine = load({}).machine;
  EXPECT_EQ(machine.clocks.core_hz, 188'000'000);
  EXPECT_EQ(machine.matching.range().count, 128);
  EXPECT_EQ(machine.matching.p2, 42);
  EXPECT_EQ(machine.link.host_pixel_rate, 30'800'000);
  EXPECT_EQ(machine.timing.matching.interval, 1U);
}

TEST(Configuration, AssignmentsApplyInOrder) {
  const MachineConfig machine =
      load({"matching.p1=10", "matching.p2=90", "matching.p1=20", "clocks.core_hz=150e6",
            "memory.arbitration=fixed_priority", "streams.unique.depth=99", "dma.map.burst_bytes=256",
            "gap_interpolation.enabled=false", "census.latency=5"})
          .machine;
  EXPECT_EQ(machine.matching.p1, 20);
  EXPECT_EQ(machine.matching.p2, 90);
  EXPECT_EQ(machine.clocks.core_hz, 150'000'000);
  EXPECT_EQ(machine.memory.arbitration, MemoryArbitration::kFixedPriority);
  EXPECT_EQ(machine.streams.resolve("unique", 5000), 99U);
  EXPECT_EQ(machine.dma.map.burst_bytes, 256U);
  EXPECT_FALSE(machine.gap_interpolation.enabled);
  EXPECT_EQ(machine.timing.census.latency, 5U);
}

TEST(Configuration, EveryStreamHasAKindOfFifo) {
  const StreamConfig streams =
      load({"streams.default_kind=block_ram", "streams.unique.kind=first_word_fall_through",
            "streams.winners.kind=asynchronous", "streams.synchroniser_stages=4"})
          .machine.streams;
  EXPECT_EQ(streams.kind("smoothed"), FifoKind::kBlockRam);
  EXPECT_EQ(streams.kind("unique"), FifoKind::kFirstWordFallThrough);
  EXPECT_EQ(streams.offsets("winners").write_to_read, 5U);
  for (const std::string& name : pipeline_stream_names()) {
    EXPECT_EQ(load({}).machine.streams.kind(name), FifoKind::kRegistered) << name;
  }
  EXPECT_EQ(load({"streams.default_kind=block_ram", "streams.unique.kind=registered",
                  "streams.unique.kind=default"})
                .machine.streams.kind("unique"),
            FifoKind::kBlockRam);
}

TEST(Configuration, RefusesAKindOfFifoThatThereIsNot) {
  EXPECT_EQ(error({"streams.default_kind=sram"}),
            "--set streams.default_kind=sram: streams.default_kind = \"sram\": must be one of registered, "
            "first_word_fall_through, block_ram, asynchronous, free");
  EXPECT_EQ(
      error({"streams.unique.kind=fwft"}),
      "--set streams.unique.kind=fwft: streams.unique.kind = \"fwft\": must be one of default, registered, "
      "first_word_fall_through, block_ram, asynchronous, free");
  EXPECT_EQ(
      error({"streams.synchroniser_stages=0"}),
      "--set streams.synchroniser_stages=0: streams.synchroniser_stages = 0: must be an integer from 1 to 8");
}

FifoConfig fifo_of(const std::string& stream, const std::vector<std::string>& assignments) {
  FifoConfig fifo;
  load(assignments).machine.streams.set_kind(stream, fifo);
  return fifo;
}

TEST(Configuration, DelaysOfAFreeFifo) {
  FifoConfig fifo = fifo_of("unique", {"streams.unique.kind=free", "streams.unique.write_to_read=5"});
  EXPECT_EQ(fifo.kind, FifoKind::kFree);
  EXPECT_EQ(fifo.write_to_read, 5U);
  EXPECT_EQ(fifo.read_to_write, 1U);
  fifo = fifo_of("unique", {"streams.default_kind=free", "streams.unique.write_to_read=0",
                            "streams.unique.read_to_write=0", "streams.unique.not_ready_cycles=7"});
  EXPECT_EQ(fifo.write_to_read, 0U);
  EXPECT_EQ(fifo.read_to_write, 0U);
  EXPECT_EQ(fifo.not_ready_cycles, 7U);
  fifo = fifo_of("winners", {"streams.default_kind=free", "streams.unique.write_to_read=0"});
  EXPECT_EQ(fifo.write_to_read, 1U);
  EXPECT_EQ(fifo.read_to_write, 1U);
  EXPECT_EQ(fifo.not_ready_cycles, 0U);
}

TEST(Configuration, SynchroniserStagesOfEachWay) {
  FifoConfig fifo = fifo_of("unique", {"streams.unique.kind=asynchronous", "streams.unique.write_to_read=5"});
  EXPECT_EQ(fifo.kind, FifoKind::kAsynchronous);
  EXPECT_EQ(fifo.synchroniser_stages.to_reader, 4U);
  EXPECT_EQ(fifo.synchroniser_stages.to_writer, 2U);
  fifo = fifo_of("unique", {"streams.default_kind=asynchronous", "streams.synchroniser_stages=3",
                            "streams.unique.read_to_write=2"});
  EXPECT_EQ(fifo.synchroniser_stages.to_reader, 3U);
  EXPECT_EQ(fifo.synchroniser_stages.to_writer, 1U);
}

TEST(Configuration, RefusesDelaysThatAKindOfFifoDoesNotTake) {
  EXPECT_EQ(error({"streams.unique.write_to_read=1"}),
            "streams.unique.write_to_read = 1: a FIFO of kind registered has delays of its own; "
            "streams.unique.kind = free takes them (streams.unique.write_to_read: --set "
            "streams.unique.write_to_read=1)");
  EXPECT_EQ(
      error({"streams.default_kind=free", "streams.unique.kind=block_ram", "streams.unique.read_to_write=0"}),
      "streams.unique.read_to_write = 0: a FIFO of kind block_ram has delays of its own; "
      "streams.unique.kind = free takes them (streams.unique.kind: --set "
      "streams.unique.kind=block_ram, streams.unique.read_to_write: --set "
      "streams.unique.read_to_write=0)");
  EXPECT_EQ(
      error({"streams.unique.kind=asynchronous", "streams.unique.read_to_write=1"}),
      "streams.unique.read_to_write = 1: an asynchronous FIFO has at least 2, the edge that captures the "
      "pointer and a synchroniser register; streams.unique.kind = free takes less "
      "(streams.unique.kind: --set streams.unique.kind=asynchronous, streams.unique.read_to_write: --set "
      "streams.unique.read_to_write=1)");
  EXPECT_EQ(
      error({"streams.unique.write_to_read=65"}),
      "--set streams.unique.write_to_read=65: streams.unique.write_to_read = 65: must be an integer from "
      "-1 to 64");
  EXPECT_EQ(
      error({"streams.unique.not_ready_cycles=-1"}),
      "--set streams.unique.not_ready_cycles=-1: streams.unique.not_ready_cycles = -1: must be an integer "
      "from 0 to 65536");
}

TEST(Configuration, RefusesAssignmentsByName) {
  EXPECT_EQ(error({"matching.p3=1"}),
            "--set matching.p3=1: unknown key matching.p3; the nearest is matching.p1");
  EXPECT_EQ(error({"matching.p1=256"}),
            "--set matching.p1=256: matching.p1 = 256: must be an integer from 0 to 255");
  EXPECT_EQ(error({"matching.p1"}), "--set matching.p1: must have the form key=value");
}

TEST(Configuration, SaysWhoSetTheValuesThatDoNotFitTogether) {
  EXPECT_EQ(error({"matching.p1=42", "matching.p2=42"}),
            "matching.p1 = 42: must be below matching.p2 = 42 (matching.p1: --set matching.p1=42, "
            "matching.p2: --set "
            "matching.p2=42)");
  const std::string line = error({"matching.iterations=8", "matching.disparity_offset=1"});
  const std::string expected =
      "matching.disparity_offset + matching.iterations x matching.parallelism = 1 + 8 x 32 = 257: must be at "
      "most "
      "256 (matching.disparity_offset: --set matching.disparity_offset=1, matching.iterations: --set "
      "matching.iterations=8, matching.parallelism: " +
      (kShipped / "scenescan-pro.toml").string() + ":";
  EXPECT_EQ(line.substr(0, expected.size()), expected);
}

TEST(Configuration, ChecksWhatMustFitTogether) {
  const auto starts = [](const std::vector<std::string>& assignments, const std::string& begin) {
    EXPECT_EQ(error(assignments).substr(0, begin.size()), begin);
  };
  starts({"dma.left.data_bits=12"}, "dma.left.data_bits = 12: must be a multiple of 8 (");
  starts({"dma.map.burst_bytes=100"},
         "dma.map.burst_bytes = 100: must be a multiple of the 8 bytes of dma.map.data_bits (");
  starts({"dma.link.fifo_bytes=64"},
         "dma.link.fifo_bytes = 64: must hold a burst: at least dma.link.burst_bytes = 128 (");
  starts({"link.packet_payload_bytes=1600"},
         "link.packet_payload_bytes = 1600: must be at most link.packet_wire_bytes = 1538 (");
  starts({"image.width=1888", "image.max_width=1856"},
         "image.width = 1888: must be at most image.max_width = 1856 (");
  starts({"image.height=1872"}, "image.height = 1872: must be at most image.max_height = 1856 (");
  starts({"census.window_width=4"}, "census.window_width = 4");
  starts({"census.window_width=9", "census.window_height=9"}, "census.window_width x census.window_height");
  starts({"rectification.window=80"}, "rectification.window: 80");
  starts({"texture.window=4"}, "texture.window = 4");
  starts({"speckle.window=4"}, "speckle.window = 4");
  starts({"noise_reduction.window=4"}, "noise_reduction.window = 4");
}

TEST(Configuration, TakesTheDisparityRange) {
  const auto with_range = [](std::int64_t range, std::vector<std::string> assignments) {
    return load_configuration({"scenescan-pro", std::move(assignments), range}, {kShipped});
  };
  EXPECT_EQ(with_range(256, {}).machine.matching.iterations, 8);
  EXPECT_EQ(with_range(192, {"matching.parallelism=64"}).machine.matching.iterations, 3);
  EXPECT_EQ(error_of([&] { with_range(100, {}); }),
            "--disparities 100: must be a positive multiple of matching.parallelism = 32; the nearest are 96 "
            "and 128");
  EXPECT_EQ(error_of([&] { with_range(0, {}); }),
            "--disparities 0: must be a positive multiple of matching.parallelism = 32; the nearest is 32");
  EXPECT_EQ(error_of([&] { with_range(288, {}); }).substr(0, 40), "matching.disparity_offset + matching.ite");
  EXPECT_EQ(error_of([&] { with_range(32 * 257, {}); }),
            "--disparities 8224: matching.iterations = 257: must be an integer from 1 to 256");
}

TEST(Configuration, AFaultInAPresetNamesFileAndLine) {
  TemporaryFolder folder;
  const std::string path = folder.write("a.toml", "inherits = \"scenescan-pro\"\n[matching]\np1 = 300\n");
  EXPECT_EQ(error_of([&] {
              load_configuration({path, {}, {}}, {kShipped});
            }),
            path + ":3: matching.p1 = 300: must be an integer from 0 to 255");
}

TEST(StreamConfig, AutomaticDepthsFollowWhatIsNeeded) {
  StreamConfig streams({"a", "b"});
  streams.depths[1].tokens = 4;
  EXPECT_EQ(streams.resolve("a", 0), 16U);
  EXPECT_EQ(streams.resolve("a", 1000), 1000U);
  EXPECT_EQ(streams.resolve("b", 1000), 4U);
  EXPECT_THROW(streams.resolve("c", 0), std::logic_error);
}

TEST(StreamConfig, AKindOfItsOwnWinsOverTheDefault) {
  StreamConfig streams({"a", "b"});
  EXPECT_EQ(streams.kind("a"), FifoKind::kRegistered);
  streams.default_kind = FifoKind::kAsynchronous;
  streams.synchroniser_stages = 3;
  streams.kinds[1].kind = FifoKind::kBlockRam;
  EXPECT_EQ(streams.kind("a"), FifoKind::kAsynchronous);
  EXPECT_EQ(streams.offsets("a").read_to_write, 4U);
  EXPECT_EQ(streams.kind("b"), FifoKind::kBlockRam);
  EXPECT_EQ(streams.offsets("b").write_to_read, 2U);
  EXPECT_THROW(streams.kind("c"), std::logic_error);
}

}  // namespace configuration_test
}  // namespace parallax
