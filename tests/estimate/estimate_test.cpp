// SPDX-License-Identifier: Apache-2.0
#include "platform/estimate/estimate.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "platform/config/configuration.hpp"
#include "platform/config/filter_of.hpp"
#include "platform/estimate/device_fit.hpp"
#include "platform/estimate/estimate_metrics.hpp"
#include "tests/cli/markdown.hpp"
#include "tests/example/fill_from_left.hpp"
#include "tests/example/fill_from_left_keys.hpp"
#include "tests/paths.hpp"
#include "tests/platform/error_of.hpp"

namespace parallax::test {
namespace estimate_test {

MachineConfig machine(const std::vector<std::string>& assignments = {},
                      const std::string& name = "scenescan-pro") {
  ConfigurationRequest request;
  request.preset = name;
  request.assignments = assignments;
  return load_configuration(request, {source_path("platform/presets")}).machine;
}

DeviceFile zynq() { return load_device("zynq-7020", {source_path("platform/presets")}); }

const PartEstimate* part(const ResourceEstimate& all, const std::string& name) {
  for (const PartEstimate& each : all.parts) {
    if (each.name == name) return &each;
  }
  return nullptr;
}

Resources total(const std::vector<std::string>& assignments, const EstimateSize& size = {}) {
  return estimate(machine(assignments), zynq(), size).total;
}

TEST(Estimate, TheTotalIsTheSumOfTheParts) {
  const ResourceEstimate all = estimate(machine(), zynq());
  Resources sum;
  for (const PartEstimate& each : all.parts) sum += each.resources;
  EXPECT_EQ(sum.luts(), all.total.luts());
  EXPECT_EQ(sum.registers, all.total.registers);
  EXPECT_EQ(sum.block_rams, all.total.block_rams);
  EXPECT_EQ(sum.dsps, all.total.dsps);
  MetricGroup tree;
  add_resources(tree, all, zynq());
  EXPECT_EQ(tree.count("resources/block_ram"), all.total.block_rams);
  EXPECT_EQ(tree.count("resources/stage/matching/lut"), part(all, "matching")->resources.luts());
  EXPECT_EQ(tree.count("resources/fifo/left_output/lut_ram"), part(all, "left_output")->resources.ram_luts);
}

TEST(Estimate, MoreOfAThingTakesMore) {
  const Resources usual = total({});
  EXPECT_GT(total({"matching.parallelism=64", "matching.iterations=2"}).luts(), usual.luts());
  EXPECT_GT(total({"matching.iterations=8"}).block_rams, usual.block_rams);
  EXPECT_GT(total({"tiles.limit=2048"}).block_rams, usual.block_rams);
  EXPECT_GT(total({"rectification.window=127"}).block_rams, usual.block_rams);
  EXPECT_GT(total({"streams.default_depth=64"}).ram_luts, usual.ram_luts);
  EXPECT_GT(total({"dma.left.fifo_bytes=65536"}).block_rams, usual.block_rams);
  EXPECT_GT(total({"matching.parallel_rows=4", "pipeline.pixels_per_token=4"}).luts(), usual.luts());
  EXPECT_GT(total({"matching.paths=\"w,nw,n,ne,e,sw,s,se\""}).block_rams, usual.block_rams);
  EXPECT_LT(total({"matching.paths=\"w,n\""}).block_rams, usual.block_rams);
  EXPECT_LT(total({"matching.path_bits=7"}).block_rams, usual.block_rams);
  EXPECT_LT(total({"matching.path_storage=memory"}).block_rams, usual.block_rams);
  EXPECT_LT(total({}, {320, 240}).block_rams, usual.block_rams);
  EXPECT_LT(total({"noise_reduction.kind=median_3x3"}).dsps, usual.dsps);
}

TEST(Estimate, WhatIsOffIsNotThere) {
  const ResourceEstimate all =
      estimate(machine({"speckle.iterations=0", "texture.enabled=false", "consistency.enabled=false",
                        "gap_interpolation.enabled=false", "noise_reduction.enabled=false",
                        "uniqueness.enabled=false", "rectification.window=1", "link.enabled=false"}),
               zynq());
  for (const char* name : {"speckle", "texture", "consistency", "gap_interpolation", "noise_reduction",
                           "uniqueness", "rectification", "map_decoder", "map_entries", "map", "link"})
    EXPECT_EQ(part(all, name), nullptr) << name;
  EXPECT_NE(part(all, "matching"), nullptr);
}

TEST(Estimate, OnlyTheReferenceCircuitsAreCalibrated) {
  const ResourceEstimate all = estimate(machine(), zynq());
  for (const char* name :
       {"rectification", "census", "matching", "subpixel", "uniqueness", "noise_reduction", "winners"})
    EXPECT_TRUE(part(all, name)->calibrated) << name;
  for (const char* name :
       {"consistency", "texture", "speckle", "gap_interpolation", "map_decoder", "unpack_left", "left"})
    EXPECT_FALSE(part(all, name)->calibrated) << name;
  EXPECT_FALSE(part(estimate(machine({"matching.paths=\"w,nw,n,ne,e\""}), zynq()), "matching")->calibrated);
  EXPECT_FALSE(part(estimate(machine({"pipeline.pixels_per_token=2"}), zynq()), "census")->calibrated);
}

TEST(Estimate, NothingIsCalibratedInAFamilyWithTheCostsOfAnother) {
  const DeviceFile device = load_device("cyclone-v-a6", {source_path("platform/presets")});
  const ResourceEstimate all = estimate(machine(), device);
  MetricGroup tree;
  add_resources(tree, all, device);
  EXPECT_EQ(tree.number("resources/calibrated"), 0);
}

TEST(Estimate, AFilterOfTheUsersOwnCountsItsStorage) {
  MachineConfig config = machine();
  config.add(filter<FillFromLeft, FillFromLeftConfig>("fill_from_left"));
  const ResourceEstimate all = estimate(config, zynq());
  ASSERT_NE(part(all, "fill_from_left"), nullptr);
  EXPECT_FALSE(part(all, "fill_from_left")->calibrated);
  EXPECT_NE(part(all, "fill_from_left_out"), nullptr);
}

TEST(Estimate, AFifoOfDepthZeroIsAWire) {
  EXPECT_EQ(fifo_circuit({FifoKind::kRegistered, 0, 8}, zynq()).all().luts(), 0);
}

TEST(Estimate, AnImageThatTheTilesDoNotHoldIsRefused) {
  const std::string line = error_of([] { estimate(machine(), zynq(), {5000, 480}); });
  EXPECT_NE(line.find("tiles.limit"), std::string::npos) << line;
}

TEST(Estimate, SharesAreOfWhatTheDeviceStates) {
  DeviceFile device = zynq();
  device.totals.dsps = 0;
  Resources design;
  design.block_rams = 281;
  const std::vector<DeviceShare> shares = device_shares(design, device);
  EXPECT_EQ(shares.size(), 4U);
  EXPECT_FALSE(fits(shares));
  design.block_rams = 280;
  EXPECT_TRUE(fits(device_shares(design, device)));
}

// A published design of the same kind, beside whose totals the page sets this estimate: census, four paths of
// 32 disparities at once in two iterations, and the winner, at 1920x1080.
TEST(Estimate, ThePageHasThePublishedDesign) {
  const ResourceEstimate all = estimate(machine({}, "xfopencv-sgbm"), zynq(), {1920, 1080});
  Resources sum;
  for (const PartEstimate& each : all.parts) {
    for (const char* stage : {"census", "matching", "subpixel"}) {
      if (each.name == stage || each.owner == stage) sum += each.resources;
    }
  }
  const std::string page = read_text(source_path("platform/doc/estimates.md"));
  const std::string row =
      fmt::format("| RAMB18 | 205 | {} |\n| DSP | 141 | {} |\n| FF | 11,856 | {} |\n| LUT | 19,102 | {} |\n",
                  sum.block_rams, sum.dsps, sum.registers, sum.luts());
  EXPECT_NE(page.find(row), std::string::npos) << row;
}

}  // namespace estimate_test
}  // namespace parallax::test
